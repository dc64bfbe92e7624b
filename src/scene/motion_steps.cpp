#include "geometry/rotation.h"
#include "scene/motion_steps_internal.h"

namespace rex::internal {
namespace {

using StepKind = MotionStep::Kind;
using Matrix34 = Eigen::Matrix<double, 3, 4>;

// The movement between two fixed frames: X = X_before * movement * X_after.
void setMotion(const JointMovement& movement, const Pose& X_before, const Pose& X_after, MotionStep& step) {
  const auto set = [](double* numbers, const Eigen::Matrix3d& R, const Eigen::Vector3d& p) {
    Eigen::Map<Matrix34>{numbers} << R, p;
  };
  const Eigen::Vector3d& a = movement.axis;
  const Pose X = X_before * X_after;
  switch (movement.kind) {
    case StepKind::kFixed:
      set(step.constant, X.R, X.p);
      return;
    case StepKind::kSlider:
      set(step.constant, X.R, X.p);
      set(step.first, Eigen::Matrix3d::Zero(), X_before.R * a);
      return;
    case StepKind::kQuaternion:
      set(step.constant, X_before.R, X_before.p);
      set(step.first, X_after.R, X_after.p);
      return;
    case StepKind::kHinge:
      // Rodrigues' formula turns by a a^T + cos x (1 - a a^T) + sin x [a]x.
      const Eigen::Matrix3d along = X_before.R * a * a.transpose();
      const Eigen::Matrix3d across = X_before.R - along, around = X_before.R * skew(a);
      set(step.constant, along * X_after.R, along * X_after.p + X_before.p);
      set(step.first, across * X_after.R, across * X_after.p);
      set(step.second, around * X_after.R, around * X_after.p);
      return;
  }
}

void append(const Joint& joint, std::vector<MotionStep>& steps) {
  const int child = static_cast<int>(joint.child);
  const JointMovements all = movements(joint);
  for (const JointMovement& movement : all) {
    const bool isFirst = &movement == all.begin(), isLast = &movement + 1 == all.end();
    steps.push_back({.kind = movement.kind,
                     .from = isFirst ? static_cast<int>(joint.parent) : child,
                     .to = child,
                     .qIndex = joint.qIndex + movement.coordinate,
                     .ratio = joint.ratio,
                     .offset = joint.offset});
    setMotion(movement, isFirst ? joint.X_PF : Pose{}, isLast ? joint.X_MC : Pose{}, steps.back());
  }
}

}  // namespace

std::vector<MotionStep> motionSteps(const Model& model) {
  std::vector<MotionStep> steps;
  for (int i = 1; i < static_cast<int>(model.bodies().size()); ++i) {
    const Body& body = model[BodyId{i}];
    if (body.joint != kNoJoint) {
      append(model[body.joint], steps);
      continue;
    }
    steps.push_back({.from = static_cast<int>(body.parent), .to = i});
    setMotion({StepKind::kFixed}, body.X_PB, Pose{}, steps.back());
  }
  return steps;
}

}  // namespace rex::internal
