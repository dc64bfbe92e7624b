#include <algorithm>
#include <numbers>

#include <fmt/format.h>

#include "base/error.h"
#include "collision/joint_travel_internal.h"

namespace rex::internal {
namespace {

using Eigen::VectorXd;

// A quaternion that moves straight by d and is at least `least` long turns by no more than 2 |d| / least.
double turn(const Joint& joint, const VectorXd& from, const VectorXd& to) {
  const VectorXd d = to - from;
  if (d.isZero(0)) return 0;
  const double t = std::clamp(-from.dot(d) / d.squaredNorm(), 0., 1.);
  const double least = (from + t * d).norm();
  if (!(least > 1e-6 * std::max(from.norm(), to.norm())))
    throw Error({.what = fmt::format("motion of joint '{}'", joint.name),
                 .found = "a quaternion that is zero on the way",
                 .wanted = "quaternions of both ends with a positive product"});
  return 2 * d.norm() / least;
}

}  // namespace

JointTravel jointTravel(const Joint& joint, const VectorArg& from, const VectorArg& to) {
  const double ratio = joint.nq == 1 ? joint.ratio : 1, offset = joint.nq == 1 ? joint.offset : 0;
  const VectorXd a = (ratio * from.segment(joint.qIndex, joint.nq)).array() + offset,
                 b = (ratio * to.segment(joint.qIndex, joint.nq)).array() + offset;
  const VectorXd d = (b - a).cwiseAbs();
  switch (joint.type) {
    case JointType::kRigid:
      return {};
    case JointType::kHinge:
      return {d[0], 0};
    case JointType::kSlider:
    case JointType::kPlanarXY:
    case JointType::kTranslation3:
      return {0, d.norm()};
    case JointType::kScrew:
      return {d[0], std::abs(joint.pitch) / (2 * std::numbers::pi) * d[0]};
    case JointType::kCylindrical:
      return {d[0], d[1]};
    case JointType::kPlanarXYPhi:
      return {d[2], d.head<2>().norm()};
    case JointType::kPlanarPhiXY:
      // The turn carries the origin, which is farthest from the axis at one of the ends.
      return {d[0], d.tail<2>().norm() + d[0] * std::max(a.tail<2>().norm(), b.tail<2>().norm())};
    case JointType::kUniversal:
      return {d.sum(), 0};
    case JointType::kBall:
      return {turn(joint, a, b), 0};
    case JointType::kFree:
      return {turn(joint, a.tail<4>(), b.tail<4>()), d.head<3>().norm()};
  }
  return {};
}

}  // namespace rex::internal
