#include "estimation/kalman_filter.h"

#include "estimation/covariance.h"
#include "estimation/innovation_internal.h"

namespace rex {
namespace {

using internal::requireBelief;
using internal::requireObservation;
using internal::weighInnovation;

// The update by a model that is known to fit; the innovation is given, since angles need care there.
KalmanUpdate update(const Gaussian& predicted, const LinearModel& model, Eigen::VectorXd innovation) {
  const Eigen::MatrixXd& S = predicted.covariance;
  KalmanUpdate result;
  result.innovation = std::move(innovation);
  const Eigen::MatrixXd cross = S * model.C.transpose();
  result.innovationCovariance = symmetrized(model.W + model.C * cross);
  const Eigen::MatrixXd K = weighInnovation(cross, result);
  result.belief.mean = predicted.mean + K * result.innovation;
  const Eigen::MatrixXd rest = Eigen::MatrixXd::Identity(S.rows(), S.rows()) - K * model.C;
  result.belief.covariance = symmetrized(rest * S * rest.transpose() + K * model.W * K.transpose());
  return result;
}

}  // namespace

Gaussian kalmanPredict(const Gaussian& belief, const LinearModel& transition) {
  requireBelief(belief);
  requireModel("transition", transition, belief.mean.size());
  return propagated(belief, transition.C, transition.c, transition.W);
}

KalmanUpdate kalmanUpdate(const Gaussian& predicted, const LinearModel& observation, const VectorArg& y) {
  requireBelief(predicted);
  requireModel("observation model", observation, predicted.mean.size());
  requireObservation(y, observation.c.size());
  return update(predicted, observation, y - observation.C * predicted.mean - observation.c);
}

Gaussian extendedPredict(const Gaussian& belief, const NonlinearModel& transition) {
  requireBelief(belief);
  return kalmanPredict(belief, linearized(transition, belief.mean));
}

KalmanUpdate extendedUpdate(const Gaussian& predicted, const NonlinearModel& observation,
                            const VectorArg& y) {
  requireBelief(predicted);
  const LinearModel tangent = linearized(observation, predicted.mean);
  requireObservation(y, tangent.c.size());
  return update(predicted, tangent, difference(observation, y, tangent.C * predicted.mean + tangent.c));
}

}  // namespace rex
