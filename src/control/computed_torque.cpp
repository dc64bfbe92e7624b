#include "control/computed_torque.h"

#include <algorithm>

#include <fmt/format.h>

#include "base/error.h"
#include "base/require.h"
#include "control/require_internal.h"
#include "dynamics/joint_springs.h"

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
  const bool isInside = i > 0 && i < last;
  const int reach = std::min(last, isInside ? 1 : 3);
  for (int k = std::max(i - reach, 0); k <= std::min(i + reach, last); ++k)
    requireFinite(fmt::format("sample {} of a reference", k), Q.col(k));
  if (last == 0) return standAt(model, Q.col(0));
  // The mean velocity from sample k to its neighbour k + 1.
  const auto between = [&](int k) -> Eigen::VectorXd {
    return difference(model, Q.col(k), Q.col(k + 1)) / tau;
  };
  if (isInside) {
    const Eigen::VectorXd before = between(i - 1), after = between(i);
    return {Q.col(i), (before + after) / 2, (after - before) / tau};
  }
  // At an end, from the nearest intervals; the time runs to the other side at the last sample.
  const bool isFirst = i == 0;
  const auto fromEnd = [&](int k) { return between(isFirst ? k : last - 1 - k); };
  const double step = isFirst ? tau : -tau;
  const Eigen::VectorXd nearest = fromEnd(0), next = last > 1 ? fromEnd(1) : nearest;
  const Eigen::VectorXd beyond = last > 2 ? fromEnd(2) : 2 * next - nearest;
  return {Q.col(i), (3 * nearest - next) / 2, (3 * next - 2 * nearest - beyond) / step};
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
  const Eigen::VectorXd a = followReference(model, state, reference, gains);
  return inverseDynamics(model, state.q, state.v, a, gravity_W) - springForces(model, state.q);
}

}  // namespace rex
