#include "kinematics/forward_kinematics.h"

#include <algorithm>
#include <array>

#include "base/cpu_lanes.h"
#include "geometry/rotation.h"
#include "kinematics/forward_kinematics_internal.h"

namespace rex {

void forwardKinematics(const Model& model, const VectorArg& q, BodyPoses& out) {
  static_assert(sizeof(Pose) == MotionStep::kPoseSize * sizeof(double));
  requireSize("joint positions q", q.size(), model.nq());
  if (internal::hasQuaternions(model)) internal::requireQuaternions(model, q.data());
  out.X_WB.resize(model.bodies().size());
  out.X_WB.front() = Pose{};
  const std::span<const MotionStep> steps = model.motionSteps();
  const double* numbers = q.data();
  kernelFor<internal::ForwardKinematicsKernel>(cpuLanes())
      .one(steps.data(), static_cast<int>(steps.size()), &numbers, out.X_WB.front().R.data());
}

BodyPoses forwardKinematics(const Model& model, const VectorArg& q) {
  BodyPoses poses;
  forwardKinematics(model, q, poses);
  return poses;
}

void internal::requireQuaternions(const Model& model, const double* q) {
  for (const MotionStep& step : model.motionSteps()) {
    if (step.kind == MotionStep::Kind::kQuaternion)
      static_cast<void>(rotationFromQuaternion(Quaternion(q + step.qIndex)));
  }
}

void PoseBatch::resize(int bodies, int count) {
  const int oldBodies = numbers_.items(), oldBlocks = blocks();
  numbers_.resize(bodies, count);
  if (bodies == 0 || (bodies == oldBodies && blocks() == oldBlocks)) return;
  for (int b = 0; b < blocks(); ++b) {
    for (int i = 0; i < 12; ++i)
      std::fill_n(block(b, kWorld).begin() + kLanes * i, kLanes, i < 9 && i % 4 == 0 ? 1. : 0.);
  }
}

Pose PoseBatch::pose(BodyId body, int k) const {
  const std::array<double, 12> numbers = numbers_.at(static_cast<int>(body), k);
  return {Eigen::Map<const Eigen::Matrix3d>(numbers.data()),
          Eigen::Map<const Eigen::Vector3d>(numbers.data() + 9)};
}

void forwardKinematicsBatch(const Model& model, const MatrixArg& Q, PoseBatch& out) {
  internal::forwardKinematicsBatch(kernelFor<internal::ForwardKinematicsKernel>(cpuLanes()), model, Q, out);
}

namespace internal {

void forwardKinematicsBatch(const ForwardKinematicsKernel& kernel, const Model& model, const MatrixArg& Q,
                            PoseBatch& out) {
  constexpr int kLanes = PoseBatch::kLanes;
  static_assert(ForwardKinematicsKernel::kBlock == kLanes);
  requireSize("joint positions, a column of Q", Q.rows(), model.nq());
  if (hasQuaternions(model)) {
    for (const auto& q : Q.colwise()) requireQuaternions(model, q.data());
  }
  const int count = static_cast<int>(Q.cols());
  out.resize(static_cast<int>(model.bodies().size()), count);
  const std::span<const MotionStep> steps = model.motionSteps();
  for (int b = 0; b < out.blocks(); ++b) {
    std::array<const double*, kLanes> columns;
    for (int lane = 0; lane < kLanes; ++lane)
      columns[static_cast<std::size_t>(lane)] = Q.col(std::min(kLanes * b + lane, count - 1)).data();
    kernel.block(steps.data(), static_cast<int>(steps.size()), columns.data(), out.block(b, kWorld).data());
  }
}

}  // namespace internal
}  // namespace rex
