#include <cmath>
#include <numbers>

#include <Eigen/Cholesky>

#include "base/error.h"
#include "base/require.h"
#include "estimation/covariance.h"
#include "estimation/innovation_internal.h"

namespace rex::internal {

double logNormal(const Eigen::LLT<Eigen::MatrixXd>& factor, const VectorArg& error) {
  const double n = static_cast<double>(error.size());
  const double logDeterminant = 2 * factor.matrixLLT().diagonal().array().log().sum();
  const double distance = factor.matrixL().solve(error).squaredNorm();
  return -0.5 * (n * std::log(2 * std::numbers::pi) + logDeterminant + distance);
}

Eigen::MatrixXd weighInnovation(const Eigen::MatrixXd& cross, KalmanUpdate& update) {
  const auto factor = definiteFactor("covariance of the innovation", update.innovationCovariance);
  update.squaredInnovation = factor.matrixL().solve(update.innovation).squaredNorm();
  update.logLikelihood = logNormal(factor, update.innovation);
  return factor.solve(cross.transpose()).transpose();
}

void requireBelief(const Gaussian& belief) {
  requireFinite("mean of the belief", belief.mean);
  requireCovariance("covariance of the belief", belief.covariance, belief.mean.size());
}

void requireObservation(const VectorArg& y, Eigen::Index wanted) {
  requireSize("observation", y.size(), wanted);
  requireFinite("observation", y);
}

}  // namespace rex::internal
