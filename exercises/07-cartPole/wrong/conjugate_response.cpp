// caught by: loops, other-sensors
// shown by: loops
// mistake: the sign of i w is that of -i w.

// <solution responseAt>
const Eigen::Index n = plant.A.rows();
Eigen::MatrixXd M(2 * n, 2 * n), right = Eigen::MatrixXd::Zero(2 * n, 1);
M << -plant.A, Eigen::MatrixXd::Zero(n, n), Eigen::MatrixXd::Zero(n, n), -plant.A;
right.topRows(n) = plant.B;
Eigen::MatrixXd G(2, frequencies.size());
for (Eigen::Index k = 0; k < G.cols(); ++k) {
  for (Eigen::Index i = 0; i < n; ++i) M(i, n + i) = frequencies[k], M(n + i, i) = -frequencies[k];
  const Eigen::MatrixXd x = solveMatrix(M, right);
  G(0, k) = C.row(0).dot(x.col(0).head(n));
  G(1, k) = C.row(0).dot(x.col(0).tail(n));
}
return G;
// </solution>
