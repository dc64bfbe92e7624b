#include "support/world_frame_dynamics.h"

#include <vector>

#include <Eigen/Geometry>

#include "kinematics/forward_kinematics.h"

namespace rex {
namespace {

// A twist or a force seen from the world's origin: angular part (or torque), linear part (or force).
struct Spatial {
  Eigen::Vector3d angular = Eigen::Vector3d::Zero(), linear = Eigen::Vector3d::Zero();
  friend Spatial operator+(const Spatial& a, const Spatial& b) {
    return {a.angular + b.angular, a.linear + b.linear};
  }
  friend Spatial operator*(double x, const Spatial& a) { return {x * a.angular, x * a.linear}; }
};

Spatial twist(const Pose& X_WF, const DegreeOfFreedom& freedom) {
  const Eigen::Vector3d angular = X_WF.R * freedom.angular;
  return {angular, X_WF.R * freedom.linear + X_WF.p.cross(angular)};
}

// How a twist s that is fixed in a frame with twist V changes.
Spatial crossMotion(const Spatial& V, const Spatial& s) {
  return {V.angular.cross(s.angular), V.angular.cross(s.linear) + V.linear.cross(s.angular)};
}

// What it takes to move a body with twist V at acceleration A.
Spatial inertialForce(const Body& body, const Pose& X_WB, const Spatial& V, const Spatial& A) {
  const Eigen::Vector3d c = X_WB * body.p_BBcm;
  const Eigen::Matrix3d I = X_WB.R * body.I_BBcm_B * X_WB.R.transpose();
  const Eigen::Vector3d velocity = V.linear + V.angular.cross(c);
  const Eigen::Vector3d force = body.mass * (A.linear + A.angular.cross(c) + V.angular.cross(velocity));
  const Eigen::Vector3d torque = I * A.angular + V.angular.cross(I * V.angular);
  return {torque + c.cross(force), force};
}

}  // namespace

Eigen::VectorXd worldFrameInverseDynamics(const Model& model, const VectorArg& q, const VectorArg& v,
                                          const VectorArg& a, const Eigen::Vector3d& gravity_W) {
  const BodyPoses poses = forwardKinematics(model, q);
  const std::size_t count = model.bodies().size();
  std::vector<Spatial> V(count), A(count), f(count);
  A[0].linear = -gravity_W;
  const auto isOfParent = [](const DegreeOfFreedom& freedom) {
    return freedom.frame == DegreeOfFreedom::Frame::kParent;
  };
  const auto twistOf = [&](const Joint& joint, const DegreeOfFreedom& freedom) {
    return twist(poses[isOfParent(freedom) ? joint.parent : joint.child], freedom);
  };
  for (std::size_t i = 1; i < count; ++i) {
    const Body& body = model.bodies()[i];
    const std::size_t parent = static_cast<std::size_t>(body.parent);
    V[i] = V[parent], A[i] = A[parent];
    if (body.joint == kNoJoint) continue;
    const Joint& joint = model[body.joint];
    const std::span freedoms(joint.freedoms.data(), static_cast<std::size_t>(joint.nv));
    int k = joint.vIndex;
    for (const DegreeOfFreedom& freedom : freedoms) V[i] = V[i] + v[k++] * twistOf(joint, freedom);
    k = joint.vIndex;
    for (const DegreeOfFreedom& freedom : freedoms) {
      const Spatial s = twistOf(joint, freedom);
      A[i] = A[i] + a[k] * s + v[k] * crossMotion(V[isOfParent(freedom) ? parent : i], s);
      ++k;
    }
  }
  Eigen::VectorXd u = Eigen::VectorXd::Zero(model.nv());
  for (std::size_t i = count; i-- > 1;) {
    const Body& body = model.bodies()[i];
    f[i] = f[i] + inertialForce(body, poses.X_WB[i], V[i], A[i]);
    f[static_cast<std::size_t>(body.parent)] = f[static_cast<std::size_t>(body.parent)] + f[i];
    if (body.joint == kNoJoint) continue;
    const Joint& joint = model[body.joint];
    for (int k = 0; k < joint.nv; ++k) {
      const Spatial s = twistOf(joint, joint.freedoms[static_cast<std::size_t>(k)]);
      u[joint.vIndex + k] += s.angular.dot(f[i].angular) + s.linear.dot(f[i].linear);
      u[joint.vIndex + k] += joint.ratio * joint.armature * (joint.ratio * a[joint.vIndex + k]);
    }
  }
  return u;
}

}  // namespace rex
