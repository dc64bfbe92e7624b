// caught by: long-band
// mistake: builds the dense matrix of the band, most of it zeros.

// <solution bandCholesky>
const Eigen::Index rows = band.rows(), N = band.cols();
Eigen::MatrixXd A = Eigen::MatrixXd::Zero(N, N);
for (Eigen::Index j = 0; j < N; ++j)
  for (Eigen::Index i = 0; i < rows && j + i < N; ++i) A(j + i, j) = band(i, j);
for (Eigen::Index j = 0; j < N; ++j) {
  if (!(A(j, j) > 0)) return {};
  A.col(j).tail(N - j) /= std::sqrt(A(j, j));
  for (Eigen::Index i = j + 1; i < N; ++i) A.col(i).tail(N - i) -= A(i, j) * A.col(j).tail(N - i);
}
Eigen::MatrixXd L = Eigen::MatrixXd::Zero(rows, N);
for (Eigen::Index j = 0; j < N; ++j)
  for (Eigen::Index i = 0; i < rows && j + i < N; ++i) L(i, j) = A(j + i, j);
return L;
// </solution>
