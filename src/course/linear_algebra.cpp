#include "course/linear_algebra.h"

#include <limits>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>
#include <Eigen/SVD>
#include <fmt/format.h>

#include "base/error.h"

namespace rex {
namespace {

void requireSquare(const char* what, const Eigen::MatrixXd& A) {
  if (A.rows() == A.cols()) return;
  throw Error({.what = what,
               .found = fmt::format("a {} x {} matrix", A.rows(), A.cols()),
               .wanted = "a square matrix"});
}

void requireFinite(const char* what, const Eigen::MatrixXd& A) {
  if (!A.allFinite()) throw Error({.what = what, .found = "nan or infinity", .wanted = "finite numbers"});
}

Eigen::PartialPivLU<Eigen::MatrixXd> factorise(const char* what, const Eigen::MatrixXd& A) {
  requireSquare(what, A);
  requireFinite(what, A);
  Eigen::PartialPivLU<Eigen::MatrixXd> lu(A);
  const double rcond = A.size() > 0 ? lu.rcond() : 1;
  if (!(rcond > std::numeric_limits<double>::epsilon())) {
    throw Error({.what = what,
                 .found = fmt::format("a singular matrix (reciprocal condition {:.1e})", rcond),
                 .wanted = "an invertible one; leastSquares takes any"});
  }
  return lu;
}

void requireRows(const char* what, Eigen::Index found, Eigen::Index wanted) {
  if (found == wanted) return;
  throw Error({.what = what,
               .found = fmt::format("a right side with {} rows", found),
               .wanted = fmt::format("{}", wanted)});
}

}  // namespace

Eigen::MatrixXd inverse(const Eigen::MatrixXd& A) { return factorise("inverse", A).inverse(); }

Eigen::MatrixXd solveMatrix(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B) {
  requireRows("solve", B.rows(), A.rows());
  return factorise("solve", A).solve(B);
}

Eigen::VectorXd leastSquares(const Eigen::MatrixXd& A, const Eigen::VectorXd& b) {
  requireRows("leastSquares", b.size(), A.rows());
  requireFinite("leastSquares", A);
  return Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd>(A).solve(b);
}

Eigen::VectorXcd eigenvalues(const Eigen::MatrixXd& A) {
  requireSquare("eigenvalues", A);
  requireFinite("eigenvalues", A);
  return Eigen::EigenSolver<Eigen::MatrixXd>(A, false).eigenvalues();
}

SingularValues svd(const Eigen::MatrixXd& A) {
  requireFinite("svd", A);
  const Eigen::BDCSVD<Eigen::MatrixXd> decomposition(A, Eigen::ComputeThinU | Eigen::ComputeThinV);
  return {decomposition.matrixU(), decomposition.singularValues(), decomposition.matrixV()};
}

}  // namespace rex
