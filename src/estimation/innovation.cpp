#include <cmath>
#include <numbers>

#include <Eigen/Cholesky>

#include "base/error.h"
#include "base/require_finite.h"
#include "estimation/covariance.h"
#include "estimation/innovation_internal.h"

namespace rex::internal {

Eigen::MatrixXd weighInnovation(const Eigen::MatrixXd& cross, KalmanUpdate& update) {
  const Eigen::LLT<Eigen::MatrixXd> factor(update.innovationCovariance);
  if (factor.info() != Eigen::Success)
    requireCovariance("covariance of the innovation", update.innovationCovariance, update.innovation.size(),
                      Definiteness::kPositive);
  update.squaredInnovation = factor.matrixL().solve(update.innovation).squaredNorm();
  const double logDeterminant = 2 * factor.matrixLLT().diagonal().array().log().sum();
  const double m = static_cast<double>(update.innovation.size());
  update.logLikelihood =
      -0.5 * (m * std::log(2 * std::numbers::pi) + logDeterminant + update.squaredInnovation);
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
