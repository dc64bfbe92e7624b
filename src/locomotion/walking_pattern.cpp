#include "locomotion/walking_pattern.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "base/require.h"
#include "kinematics/hierarchical_step.h"
#include "kinematics/motion_profile.h"
#include "kinematics/task.h"
#include "kinematics/task_maps.h"
#include "scene/state.h"

namespace rex {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Eigen::VectorXd;

// The share of the way back to the start posture that each posture takes in its free directions.
constexpr double kHomeward = 0.1;

Matrix3d turned(double yaw) { return Eigen::AngleAxisd(yaw, Vector3d::UnitZ()).toRotationMatrix(); }

// The turn from one yaw to another by the shorter way.
double turnBetween(double from, double to) { return std::remainder(to - from, 2 * std::numbers::pi); }

// Yaw and position of the centre of a sole.
struct SolePlace {
  Vector3d p;
  double yaw;
};

SolePlace solePlace(const WalkPhase& phase, Side side, double lift) {
  const Footstep& foot = side == Side::kLeft ? phase.left : phase.right;
  SolePlace at{.p = {foot.p.x(), foot.p.y(), 0}, .yaw = foot.yaw};
  if (!phase.swing || phase.swing->side != side) return at;
  const double share = profileAt({.shape = ProfileShape::kMinimumJerk}, phase.share).position;
  at.p.head<2>() += share * (phase.swing->p - foot.p);
  at.p.z() = lift * std::pow(4 * phase.share * (1 - phase.share), 3);
  at.yaw += share * turnBetween(foot.yaw, phase.swing->yaw);
  return at;
}

// The tasks of a posture at one time: first the feet and the centre of mass, then the trunk.
struct Targets {
  std::array<Task, 3> places;
  Task trunk;
};

Targets targetsAt(const Legs& legs, const WalkPhase& phase, const Vector3d& center, double lift) {
  const SolePlace left = solePlace(phase, Side::kLeft, lift), right = solePlace(phase, Side::kRight, lift);
  const auto foot = [&](const char* name, BodyId body, const SolePlace& at) {
    return Task{.name = name, .map = poseTask(body, {turned(at.yaw), at.p}, legs.p_FS)};
  };
  const double middle = left.yaw + turnBetween(left.yaw, right.yaw) / 2;
  return {.places = {foot("left foot", legs.leftFoot, left), foot("right foot", legs.rightFoot, right),
                     Task{.name = "centre of mass", .map = centerOfMassTask(), .target = center}},
          .trunk = {.name = "trunk", .map = orientationTask(legs.trunk, turned(middle))}};
}

// Brings q to the targets, and returns how far feet and centre of mass are off.
double solve(const Model& model, const Targets& targets, const VectorXd& home, const WalkOptions& options,
             VectorXd& q) {
  double error = 0;
  for (int i = 0;; ++i) {
    const BodyPoses poses = forwardKinematics(model, q);
    const Posture posture{model, q, poses};
    const TaskValue places = stackTasks(targets.places, posture);
    const TaskValue trunk = stackTasks(std::span(&targets.trunk, 1), posture);
    error = places.y.cwiseAbs().maxCoeff();
    if ((error <= options.tolerance / 10 && i > 0) || i == options.maxIterations) return error;
    const std::vector<TaskLevel> levels = {{.J = places.J, .dy = -places.y}, {.J = trunk.J, .dy = -trunk.y}};
    // Only once: moving home leads away from the targets, and must not keep Newton's steps from converging.
    const VectorXd a = (i == 0 ? kHomeward : 0) * difference(model, q, home);
    const VectorXd step = hierarchicalStep(levels, {.W = {}, .a = a});
    q = integrate(model, q, step).cwiseMax(model.lowerLimits()).cwiseMin(model.upperLimits());
  }
}

void requireOptions(const Model& model, const VectorArg& start, const WalkOptions& options) {
  requireSize("walking pattern: start", start.size(), model.nq());
  requirePositive("walking pattern: lift", options.lift);
  requirePositive("walking pattern: tolerance", options.tolerance);
  requireCount("walking pattern: iterations", options.maxIterations, 1);
}

}  // namespace

Pose solePose(const WalkPlan& plan, Side side, double t, double lift) {
  const SolePlace at = solePlace(phaseAt(plan, t), side, lift);
  return {turned(at.yaw), at.p};
}

WalkingPattern walkingPattern(const Model& model, const Legs& legs, const WalkPlan& plan,
                              const VectorArg& start, const WalkOptions& options) {
  requireOptions(model, start, options);
  const double step = options.preview.step;
  WalkingPattern pattern{.center = followZmp(zmpReference(plan, step), options.preview)};
  if (pattern.center.status != RiccatiStatus::kSolved) {
    pattern.status = WalkingPattern::Status::kNoPreview;
    pattern.message = pattern.center.message;
    return pattern;
  }
  const VectorXd home = start;
  VectorXd q = home;
  const Eigen::Index count = pattern.center.c.cols();
  pattern.Q.resize(model.nq(), count);
  for (Eigen::Index k = 0; k < count; ++k) {
    const double t = static_cast<double>(k) * step;
    const Vector3d center(pattern.center.c(0, k), pattern.center.c(1, k), options.preview.height);
    const Targets targets = targetsAt(legs, phaseAt(plan, t), center, options.lift);
    const double error = solve(model, targets, home, options, q);
    if (!(error <= options.tolerance)) {
      pattern.Q.conservativeResize(model.nq(), k);
      pattern.message = fmt::format("at {:.6g} s feet or centre of mass are off by {:.3g}", t, error);
      return pattern;
    }
    pattern.largestError = std::max(pattern.largestError, error);
    pattern.Q.col(k) = q;
  }
  pattern.status = WalkingPattern::Status::kWalks;
  pattern.message = fmt::format("walks for {:.6g} s", duration(plan));
  return pattern;
}

}  // namespace rex
