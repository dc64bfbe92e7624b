#include "systems/motion_model.h"

#include "base/derivative_check.h"
#include "base/error.h"
#include "base/require.h"

namespace rex {

void requireMotion(const MotionModel& model, const VectorArg& x, const VectorArg& u, double dt) {
  if (!model.f)
    throw Error({.what = "motion model", .found = "no function f", .wanted = "the state after a motion"});
  requireSize("state of a motion model", x.size(), model.states);
  requireFinite("state of a motion model", x);
  requireSize("control of a motion model", u.size(), model.controls);
  requireFinite("control of a motion model", u);
  requireNotNegative("time of a motion", dt, kSeconds);
}

namespace {

Eigen::VectorXd checkedState(const MotionModel& model, Eigen::VectorXd next) {
  requireSize("next state of a motion model", next.size(), model.states);
  requireFinite("next state of a motion model", next);
  return next;
}

}  // namespace

Eigen::VectorXd meanAfter(const MotionModel& model, const VectorArg& x, const VectorArg& u, double dt) {
  requireMotion(model, x, u, dt);
  return checkedState(model, model.f(x, u, dt));
}

StepJacobians stepJacobians(const MotionModel& model, const VectorArg& x, const VectorArg& u, double dt) {
  requireMotion(model, x, u, dt);
  StepJacobians at;
  at.A = model.A ? model.A(x, u, dt)
                 : numericJacobian([&](const Eigen::VectorXd& y) { return model.f(y, u, dt); }, x);
  at.B = model.B ? model.B(x, u, dt)
                 : numericJacobian([&](const Eigen::VectorXd& v) { return model.f(x, v, dt); }, u);
  requireSize("df/dx of a motion model", at.A.size(), static_cast<long>(model.states) * model.states);
  requireSize("df/du of a motion model", at.B.size(), static_cast<long>(model.states) * model.controls);
  return at;
}

}  // namespace rex
