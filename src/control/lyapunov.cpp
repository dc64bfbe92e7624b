#include <cmath>
#include <complex>

#include <Eigen/Eigenvalues>
#include <fmt/format.h>

#include "base/error.h"
#include "control/require_matrix_internal.h"
#include "control/riccati.h"

// Both equations are solved column by column in the Schur basis A = U T U^*, where they are triangular
// (Bartels and Stewart 1972).
namespace rex {
namespace {

using Complex = std::complex<double>;

constexpr double kRounding = 1e-15;  // of an eigenvalue, per row

void requireInput(const MatrixArg& A, const MatrixArg& Q) {
  if (A.rows() == 0) throw Error({.what = "matrix A", .found = "no rows"});
  requireSize("columns of A", A.cols(), A.rows());
  internal::requireFiniteMatrix("A", A);
  internal::requireSymmetric("Q", Q, A.rows());
}

// Solves (s T^* + t) y = b with a lower triangular T^*; throws if an entry of the diagonal vanishes.
Eigen::VectorXcd solveShifted(const Eigen::MatrixXcd& T, Complex s, Complex t, Eigen::VectorXcd b,
                              const char* condition) {
  for (Eigen::Index i = 0; i < b.size(); ++i) {
    const Complex pivot = s * std::conj(T(i, i)) + t;
    if (std::abs(pivot) <= kRounding * static_cast<double>(b.size()) * (std::abs(s * T(i, i)) + std::abs(t)))
      throw Error({.what = "Lyapunov equation",
                   .found = fmt::format("the eigenvalue {:.6g}{:+.6g}i of A and another with {}",
                                        T(i, i).real(), T(i, i).imag(), condition),
                   .wanted = "no such pair"});
    b[i] = (b[i] - s * T.col(i).head(i).dot(b.head(i))) / pivot;
  }
  return b;
}

// The complex Schur form of a real matrix: the blocks of the real one are made triangular.
Eigen::ComplexSchur<Eigen::MatrixXcd> schurOf(const Eigen::MatrixXd& A) {
  const Eigen::RealSchur<Eigen::MatrixXd> real(A);
  Eigen::ComplexSchur<Eigen::MatrixXcd> schur(A.rows());
  schur.computeFromHessenberg(real.matrixT().cast<Complex>(), real.matrixU().cast<Complex>(), true);
  return schur;
}

// Coefficient by coefficient: the blocked product of complex matrices would take seconds to compile.
Eigen::MatrixXcd product(const Eigen::MatrixXcd& A, const Eigen::MatrixXcd& B) { return A.lazyProduct(B); }

Eigen::MatrixXcd inBasis(const Eigen::MatrixXcd& U, const Eigen::MatrixXd& Q) {
  return product(U.adjoint(), product(Q.cast<Complex>(), U));
}

Eigen::MatrixXd backFrom(const Eigen::MatrixXcd& U, const Eigen::MatrixXcd& Y) {
  const Eigen::MatrixXd X = product(product(U, Y), U.adjoint()).real();
  return 0.5 * (X + X.transpose());
}

}  // namespace

Eigen::MatrixXd solveLyapunov(const MatrixArg& A, const MatrixArg& Q) {
  requireInput(A, Q);
  const Eigen::ComplexSchur<Eigen::MatrixXcd> schur = schurOf(A);
  const Eigen::MatrixXcd &T = schur.matrixT(), &U = schur.matrixU(), C = inBasis(U, Q);
  Eigen::MatrixXcd Y = Eigen::MatrixXcd::Zero(A.rows(), A.rows());
  for (Eigen::Index j = 0; j < A.rows(); ++j)
    Y.col(j) = solveShifted(T, 1, T(j, j), -C.col(j) - Y.leftCols(j) * T.col(j).head(j), "a sum of zero");
  return backFrom(U, Y);
}

Eigen::MatrixXd solveDiscreteLyapunov(const MatrixArg& A, const MatrixArg& Q) {
  requireInput(A, Q);
  const Eigen::ComplexSchur<Eigen::MatrixXcd> schur = schurOf(A);
  const Eigen::MatrixXcd &T = schur.matrixT(), &U = schur.matrixU(), C = inBasis(U, Q);
  Eigen::MatrixXcd Y = Eigen::MatrixXcd::Zero(A.rows(), A.rows());
  for (Eigen::Index j = 0; j < A.rows(); ++j)
    Y.col(j) = solveShifted(T, T(j, j), -1, -C.col(j) - T.adjoint() * (Y.leftCols(j) * T.col(j).head(j)),
                            "a product of one");
  return backFrom(U, Y);
}

}  // namespace rex
