#include <limits>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <fmt/format.h>

#include "base/error.h"
#include "control/require_internal.h"

namespace rex::internal {
namespace {

// By the pivots of Cholesky's method, with the diagonal scaled to ones so that units do not matter.
bool isPositiveDefinite(const MatrixArg& M) {
  if (!(M.diagonal().minCoeff() > 0)) return false;
  const Eigen::VectorXd scale = M.diagonal().cwiseSqrt().cwiseInverse();
  const Eigen::MatrixXd scaled = scale.asDiagonal() * M * scale.asDiagonal();
  const Eigen::LLT<Eigen::MatrixXd> factors(scaled);
  const double rounding = 100 * static_cast<double>(M.rows()) * std::numeric_limits<double>::epsilon();
  return factors.info() == Eigen::Success && factors.matrixLLT().diagonal().cwiseAbs2().minCoeff() > rounding;
}

}  // namespace

Eigen::MatrixXd symmetricPart(const MatrixArg& M) { return 0.5 * (M + M.transpose()); }

void requireFiniteMatrix(const std::string& name, const MatrixArg& M) {
  if (!M.allFinite())
    throw Error({.what = fmt::format("matrix {}", name), .found = "entries that are not finite"});
}

void requireSymmetric(const std::string& name, const MatrixArg& M, Eigen::Index n) {
  requireSize(fmt::format("rows of {}", name), M.rows(), n);
  requireSize(fmt::format("columns of {}", name), M.cols(), n);
  requireFiniteMatrix(name, M);
  if (n > 0 && (M - M.transpose()).cwiseAbs().maxCoeff() > 1e-9 * M.cwiseAbs().maxCoeff())
    throw Error({.what = fmt::format("matrix {}", name),
                 .found = "a matrix that is not symmetric",
                 .wanted = "a symmetric one"});
}

void requirePositiveDefinite(const std::string& name, const MatrixArg& M) {
  if (isPositiveDefinite(M)) return;
  const double least =
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(M, Eigen::EigenvaluesOnly).eigenvalues()[0];
  throw Error({.what = fmt::format("matrix {}", name),
               .found = fmt::format("the eigenvalue {:.6g}", least),
               .wanted = "a positive definite matrix"});
}

}  // namespace rex::internal
