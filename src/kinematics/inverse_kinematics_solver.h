#pragma once

#include <functional>

#include "base/rng.h"
#include "kinematics/task_maps.h"

namespace rex {

struct InverseKinematicsOptions {
  int maxIterations = 500;      ///< per start
  int maxRestarts = 50;         ///< from random postures, after the given one
  double stepTolerance = 1e-9;  ///< a start has converged if its step moves no joint farther, in units of v
};

struct InverseKinematicsResult {
  enum class Status {
    kSolved,         ///< all tasks with a tolerance are within it, and those without are minimised
    kUnreached,      ///< no start succeeded; q is the nearest posture found, which no small step improves
    kRefused,        ///< of a PoseTarget: only postures that are not allowed reach it; q is one of them
    kIterationLimit  ///< as kUnreached, but q might still improve
  };
  Status status = Status::kIterationLimit;
  Eigen::VectorXd q{};              ///< nq, within the limits
  std::vector<double> residuals{};  ///< max |y - y*| of each task, in the unit of its y
  double cost = 0;                  ///< |Phi(q)|^2 of slide 2:47
  int iterations = 0;               ///< of all starts
  int restarts = 0;
  std::string message{};  ///< says which task misses its target, and how far
};

/// The posture within the joint limits that minimises the cost |Phi(q)|^2 of all tasks (slides 2:27, 2:32 and
/// 2:47), by projected Levenberg-Marquardt steps with line search from `start` (nq; first clamped to the
/// limits). The term |q - q0|_W^2 is a task as well: homingTask with kNoTolerance. While a task with a
/// tolerance misses its target, the solver restarts from random postures within the limits, or, for joints
/// without limits, within half a turn or a metre of `start`. Throws Error if there are no tasks, for wrong
/// sizes, options that are not positive, and as stackTasks.
[[nodiscard]] InverseKinematicsResult solveInverseKinematics(const Model& model, std::span<const Task> tasks,
                                                             const VectorArg& start,
                                                             const InverseKinematicsOptions& options,
                                                             Rng& rng);

/// A pose for a body, and the postures that may lead there.
struct PoseTarget {
  BodyId body{};
  Pose X_WB{};
  double tolerance = 1e-6;  ///< of each of the six numbers of poseTask, metres and radians
  /// Whether a posture within the limits is allowed: for example that it is free of contacts
  /// (collision/contacts.h). Empty: all are.
  std::function<bool(const Eigen::VectorXd& q)> isAllowed{};
};

/// A posture that is allowed, within the joint limits, and brings the body to the pose. For an arm that has a
/// closed form (ClosedFormArm), it is the one nearest to `start` in |q - start|, full turns included; only on
/// a line of singular postures, one represents the others. Otherwise, and if the closed form has none, the
/// solver above searches, and restarts also after postures that are not allowed. Throws Error as that does,
/// as ClosedFormArm::postures(), and for a tolerance that is not positive.
[[nodiscard]] InverseKinematicsResult solveInverseKinematics(const Model& model, const PoseTarget& target,
                                                             const VectorArg& start,
                                                             const InverseKinematicsOptions& options,
                                                             Rng& rng);

}  // namespace rex
