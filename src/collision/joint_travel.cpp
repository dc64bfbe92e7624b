#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "base/error.h"
#include "collision/joint_travel_internal.h"

namespace rex::internal {
namespace {

using Eigen::VectorXd;

// A quaternion that moves along a line by d, and whose length is at least `least`, turns by at most 2 |d| /
// least.
double turn(const Joint& joint, const VectorXd& from, const VectorXd& to) {
  const VectorXd d = to - from;
  if (d.isZero(0)) return 0;
  const double t = std::clamp(-from.dot(d) / d.squaredNorm(), 0., 1.);
  const double least = (from + t * d).norm();
  if (!(least > 1e-6 * std::max(from.norm(), to.norm())))
    throw Error({.what = fmt::format("motion of joint '{}'", joint.name),
                 .found = "a quaternion that becomes zero on the way",
                 .wanted = "quaternions at both ends with a positive inner product"});
  return 2 * d.norm() / least;
}

}  // namespace

JointTravel jointTravel(const Joint& joint, const VectorArg& from, const VectorArg& to) {
  const double ratio = joint.nq == 1 ? joint.ratio : 1, offset = joint.nq == 1 ? joint.offset : 0;
  const VectorXd a = (ratio * from.segment(joint.qIndex, joint.nq)).array() + offset,
                 b = (ratio * to.segment(joint.qIndex, joint.nq)).array() + offset;
  JointTravel travel;
  // From the last movement to the first: a rotation carries everything after it, which is farthest from the
  // axis at one of the ends.
  Eigen::Vector3d moved = Eigen::Vector3d::Zero(), after_a = moved, after_b = moved;
  const JointMovements all = movements(joint);
  for (std::size_t k = all.size(); k-- > 0;) {
    const JointMovement& one = all[k];
    const int i = one.coordinate;
    switch (one.kind) {
      case JointMovement::Kind::kFixed:
        break;
      case JointMovement::Kind::kSlider:
        moved += (b[i] - a[i]) * one.axis;
        after_a += a[i] * one.axis;
        after_b += b[i] * one.axis;
        break;
      case JointMovement::Kind::kHinge: {
        const double reach = std::max(one.axis.cross(after_a).norm(), one.axis.cross(after_b).norm());
        travel.angle += std::abs(b[i] - a[i]);
        travel.way += std::abs(b[i] - a[i]) * reach;
        break;
      }
      case JointMovement::Kind::kQuaternion:
        travel.angle += turn(joint, a.segment<4>(i), b.segment<4>(i));
        break;
    }
  }
  travel.way += moved.norm();
  return travel;
}

BodyId carrierOfBoth(const Model& model, BodyId a, BodyId b) {
  std::vector<BodyId> above{a};
  while (above.back() != kWorld) above.push_back(model[above.back()].parent);
  while (std::find(above.begin(), above.end(), b) == above.end()) b = model[b].parent;
  return b;
}

}  // namespace rex::internal
