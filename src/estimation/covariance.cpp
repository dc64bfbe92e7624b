#include "estimation/covariance.h"

#include <cmath>
#include <string>

#include <Eigen/Eigenvalues>
#include <fmt/format.h>

#include "base/error.h"

namespace rex {
namespace {

constexpr double kAsymmetry = 1e-9;

// The largest value that an entry of a semidefinite matrix can have, and hence the scale of its rounding.
double sizeOf(const MatrixArg& A, Eigen::Index i, Eigen::Index j) {
  return std::sqrt(std::abs(A(i, i))) * std::sqrt(std::abs(A(j, j)));
}

void requireSymmetric(const std::string& what, const MatrixArg& A) {
  for (Eigen::Index j = 0; j < A.cols(); ++j) {
    for (Eigen::Index i = 0; i < j; ++i) {
      if (std::abs(A(i, j) - A(j, i)) <= kAsymmetry * sizeOf(A, i, j)) continue;
      throw Error(
          {.what = what,
           .found = fmt::format("{:g} at ({}, {}) and {:g} at ({}, {})", A(i, j), i, j, A(j, i), j, i),
           .wanted = "a symmetric matrix"});
    }
  }
}

// The least eigenvalue of the matrix scaled to a unit diagonal, so that large variances do not hide small
// ones.
double leastCorrelation(const MatrixArg& A) {
  const Eigen::VectorXd scale = A.diagonal().unaryExpr([](double v) { return v > 0 ? 1 / std::sqrt(v) : 1; });
  const Eigen::MatrixXd scaled = scale.asDiagonal() * A * scale.asDiagonal();
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(scaled, Eigen::EigenvaluesOnly)
      .eigenvalues()
      .minCoeff();
}

Eigen::MatrixXd withoutNegativeEigenvalues(const Eigen::MatrixXd& A) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(A);
  const Eigen::MatrixXd& V = solver.eigenvectors();
  const Eigen::MatrixXd scaled = V * solver.eigenvalues().cwiseMax(0).asDiagonal();
  const Eigen::MatrixXd nearest = scaled * V.transpose();
  return 0.5 * (nearest + nearest.transpose());
}

[[noreturn]] void refuse(const std::string& what, double eigenvalue, Definiteness wanted) {
  throw Error({.what = what,
               .found = fmt::format("the eigenvalue {:g}", eigenvalue),
               .wanted = wanted == Definiteness::kPositive ? "a positive definite matrix"
                                                           : "no negative eigenvalue"});
}

}  // namespace

void requireCovariance(std::string_view what, const MatrixArg& A, Eigen::Index size, Definiteness wanted) {
  const std::string name(what);
  if (A.rows() != size || A.cols() != size) {
    throw Error({.what = name,
                 .found = fmt::format("a {} x {} matrix", A.rows(), A.cols()),
                 .wanted = fmt::format("{} x {}", size, size)});
  }
  if (size == 0) return;
  if (!A.allFinite()) throw Error({.what = name, .found = "entries that are not finite"});
  requireSymmetric(name, A);
  const Eigen::LLT<Eigen::MatrixXd> factor(A);
  // A factorisation decides at a fraction of the cost whether eigenvalues must be computed.
  if (factor.info() == Eigen::Success && isDefinite(factor, A)) return;
  const double least = leastCorrelation(A);
  if (wanted == Definiteness::kPositive || A.diagonal().minCoeff() < 0 || least < -kAsymmetry)
    refuse(name,
           Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(A, Eigen::EigenvaluesOnly).eigenvalues().minCoeff(),
           wanted);
}

bool isDefinite(const Eigen::LLT<Eigen::MatrixXd>& factor, const MatrixArg& A) {
  // A pivot that may be only rounding of its diagonal entry counts as zero.
  const double rounding = 4e-16 * static_cast<double>(A.rows());
  const auto pivots = factor.matrixLLT().diagonal().array().square();
  return factor.info() == Eigen::Success && (pivots > rounding * A.diagonal().array()).all() &&
         pivots.isFinite().all();
}

Eigen::LLT<Eigen::MatrixXd> definiteFactor(std::string_view what, const MatrixArg& A) {
  Eigen::LLT<Eigen::MatrixXd> factor(A);
  // It only reads the lower triangle, hence requireSymmetric().
  if (A.rows() == A.cols() && A.allFinite() && isDefinite(factor, A)) {
    requireSymmetric(std::string(what), A);
    return factor;
  }
  requireCovariance(what, A, A.rows(), Definiteness::kPositive);
  return factor;  // for a compiler that does not see that the line before throws
}

Eigen::MatrixXd symmetrized(const MatrixArg& A) { return 0.5 * (A + A.transpose()); }

Eigen::MatrixXd nearestSemidefinite(const MatrixArg& A) {
  const Eigen::MatrixXd nearest = withoutNegativeEigenvalues(A);
  // Rounding of large entries may leave small ones negative: once more with a unit diagonal.
  const double rounding = 1e-14 * nearest.diagonal().cwiseAbs().maxCoeff();
  const Eigen::VectorXd root =
      nearest.diagonal().unaryExpr([&](double v) { return v > rounding ? std::sqrt(v) : 0; });
  const Eigen::VectorXd inverse = root.unaryExpr([](double v) { return v > 0 ? 1 / v : 0; });
  const Eigen::MatrixXd scaled = inverse.asDiagonal() * nearest * inverse.asDiagonal();
  return root.asDiagonal() * withoutNegativeEigenvalues(scaled) * root.asDiagonal();
}

Eigen::MatrixXd covarianceRoot(const MatrixArg& A) {
  const Eigen::LLT<Eigen::MatrixXd> factor(A);
  if (isDefinite(factor, A)) return factor.matrixL();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(A);
  return solver.eigenvectors() * solver.eigenvalues().cwiseMax(0).cwiseSqrt().asDiagonal();
}

}  // namespace rex
