#pragma once

#include <vector>

#include <Eigen/Geometry>

#include "geometry/pose.h"
#include "geometry/rotation.h"
#include "kinematics/forward_kinematics.h"

namespace rex::internal {

// Spatial vectors in W, seen from its origin, linear part first: a twist is the velocity of the point at the
// origin, then the angular velocity; a force (or momentum) is the force, then the torque about the origin.
// Twist . force is a power. Featherstone, Rigid Body Dynamics Algorithms, chapter 2 (angular part first).

using Matrix6d = Eigen::Matrix<double, 6, 6>;

inline Vector6d spatial(const Eigen::Vector3d& linear, const Eigen::Vector3d& angular) {
  Vector6d both;
  both << linear, angular;
  return both;
}

/// How a freedom moves what hangs on it, per unit of v.
inline Vector6d freedomTwist(const Joint& joint, const DegreeOfFreedom& freedom, const BodyPoses& poses) {
  const Pose& X_WF = poses[freedom.frame == DegreeOfFreedom::Frame::kParent ? joint.parent : joint.child];
  const Eigen::Vector3d angular = X_WF.R * freedom.angular;
  return spatial(X_WF.R * freedom.linear + X_WF.p.cross(angular), angular);
}

/// How a twist s that is fixed in a frame with twist V changes: V x s.
inline Vector6d crossMotion(const Vector6d& V, const Vector6d& s) {
  const Eigen::Vector3d w = V.tail<3>();
  return spatial(w.cross(s.head<3>()) + V.head<3>().cross(s.tail<3>()), w.cross(s.tail<3>()));
}

/// The force at the origin of a force on the point at p.
inline Vector6d forceAt(const Eigen::Vector3d& p, const Eigen::Vector3d& force) {
  return spatial(force, p.cross(force));
}

/// Calls visit(column, joint, freedom) for all freedoms of the joint into `body`, if one leads there.
template <class Visit>
void forEachFreedomOf(const Model& model, BodyId body, const Visit& visit) {
  if (model[body].joint == kNoJoint) return;
  const Joint& joint = model[model[body].joint];
  for (int i = 0; i < joint.nv; ++i)
    visit(joint.vIndex + i, joint, joint.freedoms[static_cast<std::size_t>(i)]);
}

/// Twists of all bodies, by BodyId, into V.
inline void bodyTwists(const Model& model, const BodyPoses& poses, const VectorArg& v,
                       std::vector<Vector6d>& V) {
  V.assign(model.bodies().size(), Vector6d::Zero());
  for (int i = 1; i < static_cast<int>(V.size()); ++i) {
    const std::size_t at = static_cast<std::size_t>(i);
    V[at] = V[static_cast<std::size_t>(model[BodyId{i}].parent)];
    forEachFreedomOf(model, BodyId{i}, [&](int column, const Joint& joint, const DegreeOfFreedom& freedom) {
      V[at] += v[column] * freedomTwist(joint, freedom, poses);
    });
  }
}
inline std::vector<Vector6d> bodyTwists(const Model& model, const BodyPoses& poses, const VectorArg& v) {
  std::vector<Vector6d> V;
  bodyTwists(model, poses, v, V);
  return V;
}

/// How a freedom's twist s changes while the bodies move with twists V.
inline Vector6d freedomTwistRate(const Joint& joint, const DegreeOfFreedom& freedom, const Vector6d& s,
                                 const std::vector<Vector6d>& V) {
  const bool inParent = freedom.frame == DegreeOfFreedom::Frame::kParent;
  return crossMotion(V[static_cast<std::size_t>(inParent ? joint.parent : joint.child)], s);
}

/// A body's centre of mass and inertia about it, in W.
struct MassInWorld {
  double mass;
  Eigen::Vector3d p;
  Eigen::Matrix3d I;

  MassInWorld(const Body& body, const Pose& X_WB)
      : mass(body.mass), p(X_WB * body.p_BBcm), I(X_WB.R * body.I_BBcm_B * X_WB.R.transpose()) {}

  [[nodiscard]] Eigen::Vector3d velocity(const Vector6d& V) const {
    return V.head<3>() + V.tail<3>().cross(p);
  }
  [[nodiscard]] Vector6d momentum(const Vector6d& V) const {
    Vector6d h = forceAt(p, mass * velocity(V));
    h.tail<3>() += I * V.tail<3>();
    return h;
  }
  /// Takes a twist to the momentum.
  [[nodiscard]] Matrix6d spatialInertia() const {
    const Eigen::Matrix3d c = skew(p);
    Matrix6d inertia;
    inertia << mass * Eigen::Matrix3d::Identity(), -mass * c, mass * c, I - mass * c * c;
    return inertia;
  }
};

}  // namespace rex::internal
