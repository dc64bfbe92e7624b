#include "live/drag.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "base/error.h"
#include "geometry/rotation.h"
#include "kinematics/forward_kinematics.h"
#include "kinematics/inverse_kinematics.h"
#include "kinematics/jacobians.h"
#include "kinematics/task_maps.h"
#include "scene/state.h"

namespace rex {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// Which entries of v a drag of this body may move: those of the joints that carry it.
std::vector<bool> movable(const Model& model, BodyId body) {
  std::vector<bool> free(static_cast<std::size_t>(model.nv())), driven = free;
  for (BodyId at = body; at != kWorld; at = model[at].parent) {
    if (model[at].joint == kNoJoint) continue;
    const Joint& joint = model[model[at].joint];
    std::vector<bool>& kind = joint.type == JointType::kFree ? free : driven;
    for (int i = 0; i < joint.nv; ++i) kind[static_cast<std::size_t>(joint.vIndex + i)] = true;
  }
  return std::find(driven.begin(), driven.end(), true) == driven.end() ? free : driven;
}

struct LinearTask {
  MatrixXd J;
  VectorXd dy;  // what is missing, metres
};

LinearTask linearTask(const Model& model, const VectorXd& q, const DragGoal& goal,
                      const std::optional<TaskMap>& avoid) {
  constexpr double kArm = 0.2, kContactWeight = 0.02;  // metres that count as a radian, and as a unit of cost
  const BodyPoses poses = forwardKinematics(model, q);
  const int turned = goal.R_WB ? 3 : 0, avoided = avoid ? 1 : 0;
  LinearTask task{MatrixXd::Zero(3 + turned + avoided, model.nv()), VectorXd::Zero(3 + turned + avoided)};
  task.J.topRows<3>() = positionJacobian(model, poses, goal.body, goal.p_BQ);
  task.dy.head<3>() = goal.p_WQ - poses[goal.body] * goal.p_BQ;
  if (goal.R_WB) {
    TaskValue turn;
    orientationTask(goal.body, *goal.R_WB)({model, q, poses}, turn);
    task.J.middleRows<3>(3) = kArm * turn.J;
    task.dy.segment<3>(3) = -kArm * turn.y;
  }
  if (avoid) {
    TaskValue cost;
    (*avoid)({model, q, poses}, cost);
    task.J.bottomRows<1>() = kContactWeight * cost.J;
    task.dy.tail<1>() = -kContactWeight * cost.y;
  }
  return task;
}

// One step; joints that would leave their limits are held, and the others do it without them.
VectorXd stepWithin(const Model& model, const VectorXd& q, LinearTask task, const std::vector<bool>& may,
                    double damping) {
  constexpr double kFarthest = 0.1;  // metres
  task.dy *= std::min(1., kFarthest / std::max(task.dy.norm(), 1e-12));
  for (int i = 0; i < model.nv(); ++i)
    if (!may[static_cast<std::size_t>(i)]) task.J.col(i).setZero();
  VectorXd next = q;
  for (int round = 0; round <= model.nv(); ++round) {
    next = integrate(model, q, inverseKinematicsStep(task.J, task.dy, damping));
    bool isHeld = false;
    for (const Joint& joint : model.joints()) {
      if (joint.mimics || joint.nq != joint.nv) continue;
      for (int i = 0; i < joint.nq; ++i) {
        double& value = next[joint.qIndex + i];
        const double low = model.lowerLimits()[joint.qIndex + i],
                     high = model.upperLimits()[joint.qIndex + i];
        if (value >= low && value <= high) continue;
        value = std::clamp(value, low, high);
        if (task.J.col(joint.vIndex + i).isZero(0)) continue;
        task.J.col(joint.vIndex + i).setZero();
        isHeld = true;
      }
    }
    if (!isHeld) break;
  }
  return next;
}

}  // namespace

VectorXd dragged(const Model& model, const VectorXd& q, const DragGoal& goal,
                 const std::optional<TaskMap>& avoid, int steps) {
  if (!goal.p_BQ.allFinite() || !goal.p_WQ.allFinite() || (goal.R_WB && !goal.R_WB->allFinite()))
    throw Error({.what = "the goal of a drag", .found = "a number that is not finite"});
  const std::vector<bool> may = movable(model, goal.body);
  constexpr double kLeastDamping = 1e-3, kMostDamping = 10;  // metres
  constexpr double kMostTurn = 0.3;                          // radians or metres per step
  VectorXd at = q;
  LinearTask task = linearTask(model, at, goal, avoid);
  double damping = 0.02;
  // A step that leads away or far, as near a stretched posture, is damped more: the robot never shakes.
  for (int step = 0; step < steps && damping < kMostDamping; ++step) {
    if (task.dy.lpNorm<Eigen::Infinity>() < 1e-9) break;
    const VectorXd next = stepWithin(model, at, task, may, damping);
    LinearTask there = linearTask(model, next, goal, avoid);
    if (there.dy.norm() < task.dy.norm() && (next - at).lpNorm<Eigen::Infinity>() < kMostTurn) {
      at = next, task = std::move(there);
      damping = std::max(damping / 2, kLeastDamping);
    } else {
      damping *= 4;
    }
  }
  return at;
}

}  // namespace rex
