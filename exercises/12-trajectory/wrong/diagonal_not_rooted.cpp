// caught by: factored, long-band
// mistake: the factors of L D L^T, and D forgotten.

// <solution bandCholesky>
Eigen::MatrixXd L = band;
const Eigen::Index rows = L.rows();
for (Eigen::Index j = 0; j < L.cols(); ++j) {
  const double d = L(0, j);
  if (!(d > 0)) return {};
  L.col(j) /= d;
  for (Eigen::Index i = 1; i < rows && j + i < L.cols(); ++i)
    L.col(j + i).head(rows - i) -= d * L(i, j) * L.col(j).tail(rows - i);
}
return L;
// </solution>
