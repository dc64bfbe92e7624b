#include <utility>

#include <Eigen/Cholesky>

#include "base/error.h"
#include "base/require_finite.h"
#include "base/rng.h"
#include "estimation/covariance.h"
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
  return [transition = std::move(transition), observation = std::move(observation), y = Eigen::VectorXd(y)](
             Eigen::Ref<Eigen::MatrixXd> X, Eigen::Ref<Eigen::VectorXd> logWeights, Rng& rng) {
    for (Eigen::Index i = 0; i < X.cols(); ++i) {
      const Gaussian motion{transition.g(X.col(i)), transition.W};
      const Gaussian seen = extendedUpdate(motion, observation, y).belief;
      const Eigen::VectorXd next = sample(seen, rng);
      logWeights[i] += logDensity(motion, next) - logDensity(seen, next);
      X.col(i) = next;
    }
  };
}

}  // namespace rex
