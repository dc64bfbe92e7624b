// caught by: loops, other-sensors
// shown by: loops
// mistake: takes w as a frequency in Hz.

// <solution responseAt>
const Eigen::Index n = plant.A.rows();
Eigen::MatrixXd M(2 * n, 2 * n), right = Eigen::MatrixXd::Zero(2 * n, 1);
M << -plant.A, Eigen::MatrixXd::Zero(n, n), Eigen::MatrixXd::Zero(n, n), -plant.A;
right.topRows(n) = plant.B;
Eigen::MatrixXd G(2, frequencies.size());
for (Eigen::Index k = 0; k < G.cols(); ++k) {
  const double w = 2 * std::numbers::pi * frequencies[k];
  for (Eigen::Index i = 0; i < n; ++i) M(i, n + i) = -w, M(n + i, i) = w;
  const Eigen::MatrixXd x = solveMatrix(M, right);
  G(0, k) = C.row(0).dot(x.col(0).head(n));
  G(1, k) = C.row(0).dot(x.col(0).tail(n));
}
return G;
// </solution>
