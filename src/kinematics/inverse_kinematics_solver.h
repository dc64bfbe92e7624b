#pragma once

#include "base/rng.h"
#include "kinematics/task.h"

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

}  // namespace rex
