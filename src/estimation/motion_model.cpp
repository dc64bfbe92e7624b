#include "estimation/motion_model.h"

#include "base/derivative_check.h"
#include "base/error.h"
#include "base/require.h"
#include "base/rng.h"
#include "estimation/covariance.h"

namespace rex {
namespace {

void requireArguments(const MotionModel& model, const VectorArg& x, const VectorArg& u, double dt) {
  if (!model.f)
    throw Error({.what = "motion model", .found = "no function f", .wanted = "the state after a motion"});
  requireSize("state of a motion model", x.size(), model.states);
  requireFinite("state of a motion model", x);
  requireSize("control of a motion model", u.size(), model.controls);
  requireFinite("control of a motion model", u);
  requireNotNegative("time of a motion", dt, kSeconds);
}

Eigen::VectorXd checkedState(const MotionModel& model, Eigen::VectorXd next) {
  requireSize("next state of a motion model", next.size(), model.states);
  requireFinite("next state of a motion model", next);
  return next;
}

Eigen::MatrixXd noiseOf(const MotionModel& model, const VectorArg& x, const VectorArg& u, double dt) {
  if (!model.noise) return Eigen::MatrixXd::Zero(model.states, model.states);
  Eigen::MatrixXd Q = model.noise(x, u, dt);
  requireCovariance("noise of a motion model", Q, model.states);
  return Q;
}

}  // namespace

Eigen::VectorXd meanAfter(const MotionModel& model, const VectorArg& x, const VectorArg& u, double dt) {
  requireArguments(model, x, u, dt);
  return checkedState(model, model.f(x, u, dt));
}

Eigen::VectorXd moved(const MotionModel& model, const VectorArg& x, const VectorArg& u, double dt, Rng& rng) {
  Eigen::VectorXd next = meanAfter(model, x, u, dt);
  if (model.noise) next += covarianceRoot(noiseOf(model, x, u, dt)) * rng.normalVector(model.states);
  return next;
}

StepJacobians jacobiansOf(const MotionModel& model, const VectorArg& x, const VectorArg& u, double dt) {
  requireArguments(model, x, u, dt);
  StepJacobians at;
  at.A = model.A ? model.A(x, u, dt)
                 : numericJacobian([&](const Eigen::VectorXd& y) { return model.f(y, u, dt); }, x);
  at.B = model.B ? model.B(x, u, dt)
                 : numericJacobian([&](const Eigen::VectorXd& v) { return model.f(x, v, dt); }, u);
  requireSize("df/dx of a motion model", at.A.size(), static_cast<long>(model.states) * model.states);
  requireSize("df/du of a motion model", at.B.size(), static_cast<long>(model.states) * model.controls);
  return at;
}

NonlinearModel transitionOf(const MotionModel& model, const VectorArg& x, const VectorArg& u, double dt) {
  requireArguments(model, x, u, dt);
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

Propose motionProposal(const MotionModel& model, const VectorArg& u, double dt) {
  return [model, u = Eigen::VectorXd(u), dt](Eigen::Ref<Eigen::MatrixXd> X, Eigen::Ref<Eigen::VectorXd>,
                                             Rng& rng) {
    for (auto x : X.colwise()) x = moved(model, x, u, dt, rng);
  };
}

}  // namespace rex
