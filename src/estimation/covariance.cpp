#include "estimation/covariance.h"

#include <cmath>
#include <string>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <fmt/format.h>

#include "base/error.h"

namespace rex {
namespace {

constexpr double kTolerance = 1e-9;

void requireSymmetric(const std::string& what, const MatrixArg& A) {
  const double scale = A.cwiseAbs().maxCoeff();
  for (Eigen::Index j = 0; j < A.cols(); ++j) {
    for (Eigen::Index i = 0; i < j; ++i) {
      if (std::abs(A(i, j) - A(j, i)) <= kTolerance * scale) continue;
      throw Error(
          {.what = what,
           .found = fmt::format("{:g} at ({}, {}) and {:g} at ({}, {})", A(i, j), i, j, A(j, i), j, i),
           .wanted = "a symmetric matrix"});
    }
  }
}

// A factorisation tells at a fraction of the price whether eigenvalues must be looked at.
bool isClearlyDefinite(const MatrixArg& A) {
  const Eigen::LLT<Eigen::MatrixXd> factor(A);
  return factor.info() == Eigen::Success;
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
  if (isClearlyDefinite(A)) return;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(A, Eigen::EigenvaluesOnly);
  const double least = solver.eigenvalues().minCoeff();
  const bool isPositive = wanted == Definiteness::kPositive;
  if (!isPositive && least >= -kTolerance * A.cwiseAbs().maxCoeff()) return;
  throw Error({.what = name,
               .found = fmt::format("the eigenvalue {:g}", least),
               .wanted = isPositive ? "a positive definite matrix" : "no negative eigenvalue"});
}

Eigen::MatrixXd symmetrized(const MatrixArg& A) { return 0.5 * (A + A.transpose()); }

Eigen::MatrixXd covarianceRoot(const MatrixArg& A) {
  const Eigen::LDLT<Eigen::MatrixXd> factor(A);
  const Eigen::VectorXd roots = factor.vectorD().cwiseMax(0).cwiseSqrt();
  const Eigen::MatrixXd L = factor.matrixL();
  return factor.transpositionsP().transpose() * (L * roots.asDiagonal());
}

}  // namespace rex
