#include "kinematics/jacobians.h"

#include <algorithm>
#include <array>
#include <cassert>

#include <Eigen/Geometry>

#include "base/cpu_lanes.h"
#include "kinematics/jacobian_kernel_internal.h"
#include "kinematics/jacobians_internal.h"
#include "scene/model.h"

namespace rex::internal {

/// Calls visit(column, freedom, frame) for each degree of freedom between the root and the body; `frame` is
/// the body in whose frame the freedom is given. Joints that mimic one another share a column.
template <class Visit>
void forEachFreedomAbove(const Model& model, BodyId body, const Visit& visit) {
  for (BodyId at = body; at != kWorld; at = model[at].parent) {
    if (model[at].joint == kNoJoint) continue;
    const Joint& joint = model[model[at].joint];
    for (int i = 0; i < joint.nv; ++i) {
      const DegreeOfFreedom& freedom = joint.freedoms[static_cast<std::size_t>(i)];
      const bool inParent = freedom.frame == DegreeOfFreedom::Frame::kParent;
      visit(joint.vIndex + i, freedom, inParent ? joint.parent : at);
    }
  }
}

}  // namespace rex::internal

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

namespace {

using internal::forEachFreedomAbove;
using internal::JacobianKernel;

// Allocates the Jacobians, all zero.
void clear(const Model& model, const PoseBatch& poses, JacobianBatch& out) {
  assert(poses.bodies() == static_cast<int>(model.bodies().size()));
  out.resize(model.nv(), poses.count());
  for (int b = 0; b < out.blocks(); ++b) {
    for (int column = 0; column < out.columns(); ++column) std::ranges::fill(out.block(b, column), 0.);
  }
}

}  // namespace

Eigen::Matrix3Xd JacobianBatch::jacobian(int k) const {
  Eigen::Matrix3Xd J(3, columns());
  for (int column = 0; column < columns(); ++column)
    J.col(column) = Eigen::Map<const Eigen::Vector3d>(numbers_.at(column, k).data());
  return J;
}

void internal::positionJacobianBatch(const JacobianKernel& kernel, const Model& model, const PoseBatch& poses,
                                     BodyId body, const Eigen::Vector3d& p_BQ, JacobianBatch& out) {
  clear(model, poses, out);
  alignas(64) std::array<double, 3 * PoseBatch::kLanes> p_WQ;
  for (int b = 0; b < out.blocks(); ++b) {
    kernel.block.point(poses.block(b, body).data(), p_BQ.data(), p_WQ.data());
    forEachFreedomAbove(model, body, [&](int column, const DegreeOfFreedom& f, BodyId frame) {
      kernel.block.addVelocity(poses.block(b, frame).data(), f.angular.data(), f.linear.data(), p_WQ.data(),
                               out.block(b, column).data());
    });
  }
}

void internal::angularJacobianBatch(const JacobianKernel& kernel, const Model& model, const PoseBatch& poses,
                                    BodyId body, JacobianBatch& out) {
  clear(model, poses, out);
  for (int b = 0; b < out.blocks(); ++b) {
    forEachFreedomAbove(model, body, [&](int column, const DegreeOfFreedom& f, BodyId frame) {
      kernel.block.addAngular(poses.block(b, frame).data(), f.angular.data(), out.block(b, column).data());
    });
  }
}

void positionJacobianBatch(const Model& model, const PoseBatch& poses, BodyId body,
                           const Eigen::Vector3d& p_BQ, JacobianBatch& out) {
  internal::positionJacobianBatch(kernelFor<JacobianKernel>(cpuLanes()), model, poses, body, p_BQ, out);
}

void angularJacobianBatch(const Model& model, const PoseBatch& poses, BodyId body, JacobianBatch& out) {
  internal::angularJacobianBatch(kernelFor<JacobianKernel>(cpuLanes()), model, poses, body, out);
}

}  // namespace rex
