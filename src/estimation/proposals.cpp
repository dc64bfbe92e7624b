#include <utility>

#include <Eigen/Cholesky>

#include "base/error.h"
#include "base/require.h"
#include "base/rng.h"
#include "estimation/covariance.h"
#include "estimation/innovation_internal.h"
#include "estimation/kalman_filter.h"
#include "estimation/particle_filter.h"

namespace rex {
namespace {

void requireFunction(const char* what, const NonlinearModel& model) {
  if (!model.g) throw Error({.what = what, .found = "no function g"});
}

}  // namespace

Propose motionProposal(NonlinearModel transition) {
  requireFunction("transition", transition);
  requireCovariance("transition: covariance of the noise", transition.W, transition.W.rows());
  const Eigen::MatrixXd root = covarianceRoot(transition.W);
  return [transition = std::move(transition), root](Eigen::Ref<Eigen::MatrixXd> X,
                                                    Eigen::Ref<Eigen::VectorXd>, Rng& rng) {
    for (Eigen::Index i = 0; i < X.cols(); ++i) {
      const Eigen::VectorXd next = transition.g(X.col(i));
      requireSize("next state", next.size(), X.rows());
      requireSize("noise of the transition", root.rows(), X.rows());
      X.col(i) = next + root * rng.normalVector(static_cast<int>(X.rows()));
    }
  };
}

Weigh observationWeights(NonlinearModel observation, const VectorArg& y) {
  requireFunction("observation model", observation);
  requireFinite("observation", y);
  requireCovariance("observation model: covariance of the noise", observation.W, y.size(),
                    Definiteness::kPositive);
  const Eigen::MatrixXd root = Eigen::LLT<Eigen::MatrixXd>(observation.W).matrixL();
  return [observation = std::move(observation), root, y = Eigen::VectorXd(y)](
             const MatrixArg& X, Eigen::Ref<Eigen::VectorXd> logWeights) {
    const auto L = root.triangularView<Eigen::Lower>();
    for (Eigen::Index i = 0; i < X.cols(); ++i) {
      const Eigen::VectorXd expected = observation.g(X.col(i));
      requireSize("expected observation", expected.size(), y.size());
      logWeights[i] -= 0.5 * L.solve(difference(observation, y, expected)).squaredNorm();
    }
  };
}

Propose observedProposal(NonlinearModel transition, NonlinearModel observation, const VectorArg& y) {
  requireFunction("transition", transition);
  requireFunction("observation model", observation);
  requireFinite("observation", y);
  requireCovariance("transition: covariance of the noise", transition.W, transition.W.rows(),
                    Definiteness::kPositive);
  requireCovariance("observation model: covariance of the noise", observation.W, y.size(),
                    Definiteness::kPositive);
  return [transition = std::move(transition), observation = std::move(observation), y = Eigen::VectorXd(y)](
             Eigen::Ref<Eigen::MatrixXd> X, Eigen::Ref<Eigen::VectorXd> logWeights, Rng& rng) {
    const auto sensor = definiteFactor("observation model: covariance of the noise", observation.W);
    for (Eigen::Index i = 0; i < X.cols(); ++i) {
      // For the model along its tangent, p(next | state) / p(next | state, y) is p(y | state) / p(y | next).
      const Gaussian motion{transition.g(X.col(i)), transition.W};
      requireSize("next state", motion.mean.size(), X.rows());
      const KalmanUpdate seen = extendedUpdate(motion, observation, y);
      const Eigen::VectorXd offset =
          covarianceRoot(seen.belief.covariance) * rng.normalVector(static_cast<int>(X.rows()));
      const Eigen::VectorXd next = seen.belief.mean + offset;
      const Eigen::VectorXd error =
          seen.innovation - linearized(observation, motion.mean).C * (next - motion.mean);
      logWeights[i] += seen.logLikelihood - internal::logNormal(sensor, error);
      X.col(i) = next;
    }
  };
}

}  // namespace rex
