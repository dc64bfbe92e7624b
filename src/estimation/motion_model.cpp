#include "estimation/motion_model.h"

#include "base/rng.h"
#include "estimation/gaussian.h"

namespace rex {
namespace {

Eigen::MatrixXd noiseOf(const MotionModel& model, const VectorArg& x, const VectorArg& u, double dt) {
  if (!model.noise) return Eigen::MatrixXd::Zero(model.states, model.states);
  Eigen::MatrixXd Q = model.noise(x, u, dt);
  requireCovariance("noise of a motion model", Q, model.states);
  return Q;
}

}  // namespace

Eigen::VectorXd moved(const MotionModel& model, const VectorArg& x, const VectorArg& u, double dt, Rng& rng) {
  Eigen::VectorXd next = meanAfter(model, x, u, dt);
  if (model.noise) next += covarianceRoot(noiseOf(model, x, u, dt)) * rng.normalVector(model.states);
  return next;
}

NonlinearModel transitionModel(const MotionModel& model, const VectorArg& x, const VectorArg& u, double dt) {
  requireMotion(model, x, u, dt);
  NonlinearModel transition{.W = noiseOf(model, x, u, dt)};
  transition.g = [model, u = Eigen::VectorXd(u), dt](const Eigen::VectorXd& y) {
    return meanAfter(model, y, u, dt);
  };
  if (model.A)
    transition.jacobian = [model, u = Eigen::VectorXd(u), dt](const Eigen::VectorXd& y) {
      return model.A(y, u, dt);
    };
  return transition;
}

MotionSampler motionProposal(const MotionModel& model, const VectorArg& u, double dt) {
  return [model, u = Eigen::VectorXd(u), dt](Eigen::Ref<Eigen::MatrixXd> X, Eigen::Ref<Eigen::VectorXd>,
                                             Rng& rng) {
    for (auto x : X.colwise()) x = moved(model, x, u, dt, rng);
  };
}

}  // namespace rex
