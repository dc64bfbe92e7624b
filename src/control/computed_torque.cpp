#include "control/computed_torque.h"

#include <algorithm>

#include <fmt/format.h>

#include "base/error.h"
#include "base/require.h"
#include "control/require_internal.h"

namespace rex {

Reference standAt(const Model& model, const VectorArg& q) {
  requireSize("posture q", q.size(), model.nq());
  requireFinite("posture q", q);
  const Eigen::VectorXd still = Eigen::VectorXd::Zero(model.nv());
  return {q, still, still};
}

Reference referenceAlong(const Model& model, const VectorArg& q0, const VectorArg& qT, double seconds,
                         double t, const MotionProfile& profile) {
  requirePositive("seconds", seconds);
  requireFinite("posture q0", q0);
  requireFinite("posture qT", qT);
  const ProfilePoint at = profileAt(profile, t / seconds);
  const Eigen::VectorXd way = difference(model, q0, qT);
  return {integrate(model, q0, at.position * way), at.velocity / seconds * way,
          at.acceleration / (seconds * seconds) * way};
}

Reference referenceAt(const Model& model, const MatrixArg& Q, double tau, int i) {
  requirePositive("time between samples tau", tau);
  if (Q.cols() == 0)
    throw Error({.what = "samples of a reference", .found = "none", .wanted = "at least one"});
  const int last = static_cast<int>(Q.cols()) - 1;
  if (i < 0 || i > last)
    throw Error({.what = "sample of a reference",
                 .found = fmt::format("{}", i),
                 .wanted = fmt::format("0 to {}", last)});
  for (int k = std::max(i - 1, 0); k <= std::min(i + 1, last); ++k)
    requireFinite(fmt::format("sample {} of a reference", k), Q.col(k));
  const Eigen::VectorXd before = difference(model, Q.col(std::max(i - 1, 0)), Q.col(i)) / tau;
  const Eigen::VectorXd after = difference(model, Q.col(i), Q.col(std::min(i + 1, last))) / tau;
  return {Q.col(i), (before + after) / 2, (after - before) / tau};
}

Eigen::VectorXd followReference(const Model& model, const State& state, const Reference& reference,
                                const PdGains& gains) {
  requireSize("reference velocities", reference.v.size(), model.nv());
  requireSize("reference accelerations", reference.a.size(), model.nv());
  requireSize("joint velocities v", state.v.size(), model.nv());
  internal::requireFinite(state);
  internal::requireFinite(gains);
  requireFinite("reference positions", reference.q);
  requireFinite("reference velocities", reference.v);
  requireFinite("reference accelerations", reference.a);
  return reference.a + gains.Kp * difference(model, state.q, reference.q) +
         gains.Kd * (reference.v - state.v);
}

Eigen::VectorXd computedTorque(const Model& model, const State& state, const Reference& reference,
                               const PdGains& gains, const Eigen::Vector3d& gravity_W) {
  requireFinite("gravity", gravity_W);
  return inverseDynamics(model, state.q, state.v, followReference(model, state, reference, gains), gravity_W);
}

}  // namespace rex
