#include "kinematics/jacobian_batch.h"

#include <algorithm>
#include <array>

#include "base/cpu_lanes.h"
#include "kinematics/freedoms_internal.h"
#include "kinematics/jacobian_batch_internal.h"

namespace rex {
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
