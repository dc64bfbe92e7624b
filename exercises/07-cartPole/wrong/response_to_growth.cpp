// caught by: loops, other-sensors
// mistake: w in the place of i w.

// <solution responseAt>
Eigen::MatrixXd G = Eigen::MatrixXd::Zero(2, frequencies.size());
for (Eigen::Index k = 0; k < G.cols(); ++k) {
  Eigen::MatrixXd M = -plant.A;
  M.diagonal().array() += frequencies[k];
  G(0, k) = C.row(0).dot(solveMatrix(M, plant.B).col(0));
}
return G;
// </solution>
