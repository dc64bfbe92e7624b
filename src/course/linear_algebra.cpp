#include "course/linear_algebra.h"

#include <cmath>
#include <limits>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>
#include <Eigen/SVD>
#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
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

void requireFiniteEntries(const char* what, const Eigen::MatrixXd& A) {
  if (!A.allFinite()) throw Error({.what = what, .found = "nan or infinity", .wanted = "finite numbers"});
}

Eigen::PartialPivLU<Eigen::MatrixXd> factorise(const char* what, const Eigen::MatrixXd& A) {
  requireSquare(what, A);
  requireFiniteEntries(what, A);
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

// The share of its diagonal entry that each pivot must keep for H to count as positive definite: rounding
// leaves about 1e-15.
constexpr double kLeastPivot = 1e-13;

Eigen::SparseMatrix<double> sparse(const std::vector<MatrixEntry>& entries, Eigen::Index size) {
  std::vector<Eigen::Triplet<double>> triplets;
  triplets.reserve(entries.size());
  for (const MatrixEntry& entry : entries) {
    const bool isInside = entry.row >= 0 && entry.row < size && entry.column >= 0 && entry.column < size;
    if (!isInside || !std::isfinite(entry.value))
      throw Error({.what = fmt::format("solveSparse: entry ({}, {})", entry.row, entry.column),
                   .found = fmt::format("{:g}", entry.value),
                   .wanted = fmt::format("a finite number in a {} x {} matrix", size, size)});
    triplets.emplace_back(entry.row, entry.column, entry.value);
  }
  Eigen::SparseMatrix<double> matrix(size, size);
  matrix.setFromTriplets(triplets.begin(), triplets.end());
  const Eigen::SparseMatrix<double> mirrored = matrix.transpose(), difference = matrix - mirrored;
  if (!(difference.blueNorm() <= 1e-9 * matrix.blueNorm()))
    throw Error({.what = "solveSparse",
                 .found = "a matrix that is not symmetric",
                 .wanted = "both halves, above and below the diagonal"});
  return matrix;
}

}  // namespace

Eigen::MatrixXd inverse(const Eigen::MatrixXd& A) { return factorise("inverse", A).inverse(); }

Eigen::MatrixXd solveMatrix(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B) {
  requireRows("solve", B.rows(), A.rows());
  requireFiniteEntries("solve: right side", B);
  return factorise("solve", A).solve(B);
}

Eigen::MatrixXd leastSquares(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B) {
  requireRows("leastSquares", B.rows(), A.rows());
  requireFiniteEntries("leastSquares", A);
  requireFiniteEntries("leastSquares: right side", B);
  const double largest = A.size() > 0 ? A.cwiseAbs().maxCoeff() : 0;
  if (largest == 0) return Eigen::MatrixXd::Zero(A.cols(), B.cols());
  // Squares of its entries would overflow, or vanish; a power of two changes nothing else.
  const int exponent = std::ilogb(largest);
  const auto scaled = [exponent](double a) { return std::scalbn(a, -exponent); };
  const Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> factors(A.unaryExpr(scaled));
  return factors.solve(B).unaryExpr(scaled);
}

Eigen::VectorXd solveSparse(const std::vector<MatrixEntry>& H, const Eigen::VectorXd& b) {
  const Eigen::SparseMatrix<double> matrix = sparse(H, b.size());
  requireFiniteEntries("solveSparse", b);
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor(matrix);
  const bool isFactored = factor.info() == Eigen::Success;
  const Eigen::VectorXd diagonal = matrix.diagonal();
  if (!isFactored ||
      !(factor.vectorD().array() > kLeastPivot * (factor.permutationP() * diagonal).array()).all())
    throw Error({.what = "solveSparse",
                 .found = "a matrix that is singular, or not positive definite",
                 .wanted = "a positive definite one: are all unknowns determined?"});
  return factor.solve(b);
}

Eigen::VectorXcd eigenvalues(const Eigen::MatrixXd& A) {
  requireSquare("eigenvalues", A);
  requireFiniteEntries("eigenvalues", A);
  if (A.size() == 0) return {};
  return Eigen::EigenSolver<Eigen::MatrixXd>(A, false).eigenvalues();
}

SingularValues svd(const Eigen::MatrixXd& A) {
  requireFiniteEntries("svd", A);
  if (A.size() == 0) return {Eigen::MatrixXd(A.rows(), 0), {}, Eigen::MatrixXd(A.cols(), 0)};
  const Eigen::JacobiSVD<Eigen::MatrixXd> decomposition(A, Eigen::ComputeThinU | Eigen::ComputeThinV);
  return {decomposition.matrixU(), decomposition.singularValues(), decomposition.matrixV()};
}

}  // namespace rex
