#include <algorithm>

#include <Eigen/Geometry>

#include "collision/coupled_motion_internal.h"
#include "collision/reference_posture_internal.h"

namespace rex::internal {
namespace {

using Eigen::Vector3d;

constexpr double kRounding = 1e-12;

double sizeOf(const Vector3d& angular, const Vector3d& linear) { return 1 + angular.norm() + linear.norm(); }

}  // namespace

CoupledMotion::CoupledMotion(const Model& model) : model_(model) {
  isCoupled_ = std::ranges::any_of(model.joints(), [](const Joint& joint) { return joint.mimics; });
  if (!isCoupled_) return;
  poses_ = forwardKinematics(model, referencePosture(model));
  for (const Joint& joint : model.joints()) addTwists(joint);
}

// Seen from the world, a joint at x moves by exp(twist 1 x1) exp(twist 2 x2) ..., because in the reference
// posture all of its coordinates are 0, or the offset of the joint.
void CoupledMotion::addTwists(const Joint& joint) {
  std::vector<Twist>& twists = twists_.emplace_back();
  for (int i = 0; i < joint.nv; ++i) {
    const DegreeOfFreedom& freedom = joint.freedoms[static_cast<std::size_t>(i)];
    const bool isOfParent = freedom.frame == DegreeOfFreedom::Frame::kParent;
    const Pose& X_WB = poses_[isOfParent ? joint.parent : joint.child];
    const Vector3d angular = X_WB.R * freedom.angular;
    const Twist twist{joint.qIndex + i, angular, X_WB.R * freedom.linear + X_WB.p.cross(angular),
                      joint.nq == joint.nv};
    if (!twist.isPlain || !isZero(twist)) twists.push_back(twist);
  }
}

bool CoupledMotion::isZero(const Twist& twist) {
  return twist.angular.norm() <= kRounding && twist.linear.norm() <= kRounding;
}

// Whether their Lie bracket is zero.
bool CoupledMotion::commute(const Twist& one, const Twist& other) {
  if (!one.isPlain || !other.isPlain) return false;
  const double small = kRounding * sizeOf(one.angular, one.linear) * sizeOf(other.angular, other.linear);
  return one.angular.cross(other.angular).norm() <= small &&
         (one.angular.cross(other.linear) - other.angular.cross(one.linear)).norm() <= small;
}

// X_AB = X_A X(twists) X_B with constants at both ends.
std::vector<CoupledMotion::Twist> CoupledMotion::twistsBetween(BodyId a, BodyId b) const {
  std::vector<Twist> upwards, downwards;
  const auto climb = [&](BodyId& body, std::vector<Twist>& way) {
    if (const JointId joint = model_[body].joint; joint != kNoJoint) {
      const std::vector<Twist>& own = twists_[static_cast<std::size_t>(joint)];
      way.insert(way.end(), own.rbegin(), own.rend());
    }
    body = model_[body].parent;
  };
  while (a != b) a > b ? climb(a, upwards) : climb(b, downwards);  // parents come before children
  for (Twist& twist : upwards) {
    twist.angular = -twist.angular;
    twist.linear = -twist.linear;
  }
  upwards.insert(upwards.end(), downwards.rbegin(), downwards.rend());
  return upwards;
}

// exp(A x) ... exp(B x) = exp((A + B) x) ... if B commutes with A and with everything between them.
bool CoupledMotion::mergeOnce(std::vector<Twist>& twists) {
  for (auto one = twists.begin(); one != twists.end(); ++one) {
    for (auto other = one + 1; other != twists.end(); ++other) {
      if (other->coordinate != one->coordinate) continue;
      if (!std::all_of(one, other, [&](const Twist& between) { return commute(*other, between); })) continue;
      const double size = std::max(sizeOf(one->angular, one->linear), sizeOf(other->angular, other->linear));
      one->angular += other->angular;
      one->linear += other->linear;
      twists.erase(other);
      if (one->angular.norm() <= kRounding * size && one->linear.norm() <= kRounding * size)
        twists.erase(one);
      return true;
    }
  }
  return false;
}

bool CoupledMotion::cancels(BodyId a, BodyId b) const {
  if (!isCoupled_) return false;
  std::vector<Twist> twists = twistsBetween(a, b);
  const auto isAlone = [&](const Twist& one) {
    return std::ranges::count(twists, one.coordinate, &Twist::coordinate) == 1;
  };
  if (std::ranges::any_of(twists, isAlone)) return false;
  while (mergeOnce(twists)) {
  }
  return twists.empty();
}

}  // namespace rex::internal
