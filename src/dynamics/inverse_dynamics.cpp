#include "dynamics/inverse_dynamics.h"

#include <vector>

#include <Eigen/Geometry>

#include "base/error.h"
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

void inverseDynamics(const Model& model, const VectorArg& q, const VectorArg& v, const VectorArg& a,
                     const Eigen::Vector3d& gravity_W, DynamicsWorkspace&, Eigen::Ref<Eigen::VectorXd> u) {
  requireSize("joint velocities v", v.size(), model.nv());
  requireSize("joint accelerations a", a.size(), model.nv());
  requireSize("joint forces u", u.size(), model.nv());
  const BodyPoses poses = forwardKinematics(model, q);
  const std::size_t count = model.bodies().size();
  std::vector<Spatial> V(count), A(count), f(count);
  A[0].linear = -gravity_W;
  const auto twistOf = [&](const Joint& joint, const DegreeOfFreedom& freedom) {
    return twist(poses[freedom.frame == DegreeOfFreedom::Frame::kParent ? joint.parent : joint.child],
                 freedom);
  };
  for (std::size_t i = 1; i < count; ++i) {
    const Body& body = model.bodies()[i];
    const std::size_t parent = static_cast<std::size_t>(body.parent);
    V[i] = V[parent], A[i] = A[parent];
    if (body.joint == kNoJoint) continue;
    const Joint& joint = model[body.joint];
    for (int k = 0; k < joint.nv; ++k) {
      const DegreeOfFreedom& freedom = joint.freedoms[static_cast<std::size_t>(k)];
      V[i] = V[i] + v[joint.vIndex + k] * twistOf(joint, freedom);
    }
    for (int k = 0; k < joint.nv; ++k) {
      const DegreeOfFreedom& freedom = joint.freedoms[static_cast<std::size_t>(k)];
      const bool ofParent = freedom.frame == DegreeOfFreedom::Frame::kParent;
      const Spatial s = twistOf(joint, freedom);
      A[i] =
          A[i] + a[joint.vIndex + k] * s + v[joint.vIndex + k] * crossMotion(ofParent ? V[parent] : V[i], s);
    }
  }
  u.setZero();
  for (std::size_t i = count; i-- > 1;) {
    const Body& body = model.bodies()[i];
    f[i] = f[i] + inertialForce(body, poses.X_WB[i], V[i], A[i]);
    f[static_cast<std::size_t>(body.parent)] = f[static_cast<std::size_t>(body.parent)] + f[i];
    if (body.joint == kNoJoint) continue;
    const Joint& joint = model[body.joint];
    for (int k = 0; k < joint.nv; ++k) {
      const Spatial s = twistOf(joint, joint.freedoms[static_cast<std::size_t>(k)]);
      u[joint.vIndex + k] += s.angular.dot(f[i].angular) + s.linear.dot(f[i].linear);
    }
  }
}

Eigen::VectorXd inverseDynamics(const Model& model, const VectorArg& q, const VectorArg& v,
                                const VectorArg& a, const Eigen::Vector3d& gravity_W) {
  DynamicsWorkspace workspace;
  Eigen::VectorXd u(model.nv());
  inverseDynamics(model, q, v, a, gravity_W, workspace, u);
  return u;
}

Eigen::VectorXd biasForces(const Model& model, const VectorArg& q, const VectorArg& v,
                           const Eigen::Vector3d& gravity_W) {
  return inverseDynamics(model, q, v, Eigen::VectorXd::Zero(model.nv()), gravity_W);
}

Eigen::VectorXd gravityForces(const Model& model, const VectorArg& q, const Eigen::Vector3d& gravity_W) {
  return biasForces(model, q, Eigen::VectorXd::Zero(model.nv()), gravity_W);
}

}  // namespace rex
