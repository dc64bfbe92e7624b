#include "kinematics/jacobians.h"

#include <cassert>

#include <Eigen/Geometry>

namespace rex {
namespace {

// Calls visit(column, freedom, X) for each degree of freedom between the root and the body; X is the pose in
// W of the frame in which the freedom is given.
template <class Visit>
void forEachFreedomAbove(const Model& model, const BodyPoses& poses, BodyId body, const Visit& visit) {
  assert(poses.X_WB.size() == model.bodies().size());
  for (BodyId at = body; at != kWorld; at = model[at].parent) {
    if (model[at].joint == kNoJoint) continue;
    const Joint& joint = model[model[at].joint];
    for (int i = 0; i < joint.nv; ++i) {
      const DegreeOfFreedom& freedom = joint.freedoms[static_cast<std::size_t>(i)];
      const bool inParent = freedom.frame == DegreeOfFreedom::Frame::kParent;
      visit(joint.vIndex + i, freedom, poses[inParent ? joint.parent : at]);
    }
  }
}

}  // namespace

Eigen::Vector3d position(const BodyPoses& poses, BodyId body, const Eigen::Vector3d& p_BQ) {
  return poses[body] * p_BQ;
}

Eigen::Vector3d direction(const BodyPoses& poses, BodyId body, const Eigen::Vector3d& vector_B) {
  return poses[body].R * vector_B;
}

void positionJacobian(const Model& model, const BodyPoses& poses, BodyId body, const Eigen::Vector3d& p_BQ,
                      Eigen::Ref<Eigen::Matrix3Xd> J) {
  assert(J.cols() == model.nv());
  const Eigen::Vector3d p_WQ = position(poses, body, p_BQ);
  J.setZero();
  // += because joints that mimic one another share a column.
  forEachFreedomAbove(model, poses, body, [&](int column, const DegreeOfFreedom& f, const Pose& X) {
    const Eigen::Vector3d axis = X.R * f.angular;
    J.col(column) += axis.cross(p_WQ - X.p) + X.R * f.linear;
  });
}

void angularJacobian(const Model& model, const BodyPoses& poses, BodyId body,
                     Eigen::Ref<Eigen::Matrix3Xd> J) {
  assert(J.cols() == model.nv());
  J.setZero();
  forEachFreedomAbove(model, poses, body, [&](int column, const DegreeOfFreedom& f, const Pose& X) {
    J.col(column) += X.R * f.angular;
  });
}

Eigen::Matrix3Xd positionJacobian(const Model& model, const BodyPoses& poses, BodyId body,
                                  const Eigen::Vector3d& p_BQ) {
  Eigen::Matrix3Xd J(3, model.nv());
  positionJacobian(model, poses, body, p_BQ, J);
  return J;
}

Eigen::Matrix3Xd angularJacobian(const Model& model, const BodyPoses& poses, BodyId body) {
  Eigen::Matrix3Xd J(3, model.nv());
  angularJacobian(model, poses, body, J);
  return J;
}

Eigen::Matrix3Xd directionJacobian(const Model& model, const BodyPoses& poses, BodyId body,
                                   const Eigen::Vector3d& vector_B) {
  const Eigen::Vector3d vector_W = direction(poses, body, vector_B);
  Eigen::Matrix3Xd J = angularJacobian(model, poses, body);
  for (auto column : J.colwise()) column = Eigen::Vector3d(column).cross(vector_W);
  return J;
}

}  // namespace rex
