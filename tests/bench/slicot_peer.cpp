#include "bench/slicot_peer.h"

#include <stdexcept>
#include <vector>

extern "C" void sb02md_(const char* time, const char* inverse, const char* triangle, const char* scaling,
                        const char* sort, const int* n, double* A, const int* lda, double* G, const int* ldg,
                        double* Q, const int* ldq, double* rcond, double* real, double* imaginary, double* S,
                        const int* lds, double* U, const int* ldu, int* integers, double* work,
                        const int* workSize, int* flags, int* info);

namespace rex::bench {

Eigen::MatrixXd careBySlicot(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B, const Eigen::MatrixXd& Q) {
  const int n = static_cast<int>(A.rows()), twice = 2 * n, workSize = 100 * n + 100;
  Eigen::MatrixXd matrix = A, G = B * B.transpose(), X = Q, S(twice, twice), U(twice, twice);
  Eigen::VectorXd real(twice), imaginary(twice), work(workSize);
  std::vector<int> integers(static_cast<std::size_t>(twice)), flags(static_cast<std::size_t>(twice));
  double rcond = 0;
  int info = 0;
  sb02md_("C", "D", "U", "G", "S", &n, matrix.data(), &n, G.data(), &n, X.data(), &n, &rcond, real.data(),
          imaginary.data(), S.data(), &twice, U.data(), &twice, integers.data(), work.data(), &workSize,
          flags.data(), &info);
  if (info != 0) throw std::runtime_error("SLICOT does not solve the Riccati equation");
  return X;
}

}  // namespace rex::bench
