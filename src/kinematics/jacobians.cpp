#include "kinematics/jacobians.h"

#include <algorithm>
#include <cassert>

#include <Eigen/Geometry>

#include "base/cpu_lanes.h"
#include "kinematics/freedoms_internal.h"
#include "kinematics/jacobian_kernel_internal.h"

namespace rex {
namespace {

using internal::forEachFreedomAbove;

// The kernel that takes one configuration.
const internal::JacobianKernel::Functions& kernel() {
  static const internal::JacobianKernel::Functions kOne = kernelFor<internal::JacobianKernel>(cpuLanes()).one;
  return kOne;
}

// The entries of a pose, column by column.
const double* numbers(const Pose& X) { return X.R.data(); }

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
  assert(poses.X_WB.size() == model.bodies().size());
  const internal::JacobianKernel::Functions& one = kernel();
  Eigen::Vector3d p_WQ;
  one.point(numbers(poses[body]), p_BQ.data(), p_WQ.data());
  J.setZero();
  forEachFreedomAbove(model, body, [&](int column, const DegreeOfFreedom& f, BodyId frame) {
    one.addVelocity(numbers(poses[frame]), f.angular.data(), f.linear.data(), p_WQ.data(),
                    J.col(column).data());
  });
}

void angularJacobian(const Model& model, const BodyPoses& poses, BodyId body,
                     Eigen::Ref<Eigen::Matrix3Xd> J) {
  assert(J.cols() == model.nv());
  assert(poses.X_WB.size() == model.bodies().size());
  const auto addAngular = kernel().addAngular;
  J.setZero();
  forEachFreedomAbove(model, body, [&](int column, const DegreeOfFreedom& f, BodyId frame) {
    addAngular(numbers(poses[frame]), f.angular.data(), J.col(column).data());
  });
}

void poseJacobian(const Model& model, const BodyPoses& poses, BodyId body, const Eigen::Vector3d& p_BQ,
                  Eigen::Ref<Matrix6Xd> J) {
  assert(J.cols() == model.nv());
  assert(poses.X_WB.size() == model.bodies().size());
  const internal::JacobianKernel::Functions& one = kernel();
  Eigen::Vector3d p_WQ;
  one.point(numbers(poses[body]), p_BQ.data(), p_WQ.data());
  if (J.outerStride() == J.rows())
    std::fill_n(J.data(), J.size(), 0.);  // much faster than by columns
  else
    J.setZero();
  forEachFreedomAbove(model, body, [&](int column, const DegreeOfFreedom& f, BodyId frame) {
    one.addTwist(numbers(poses[frame]), f.angular.data(), f.linear.data(), p_WQ.data(), J.col(column).data());
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

Matrix6Xd poseJacobian(const Model& model, const BodyPoses& poses, BodyId body, const Eigen::Vector3d& p_BQ) {
  Matrix6Xd J(6, model.nv());
  poseJacobian(model, poses, body, p_BQ, J);
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
