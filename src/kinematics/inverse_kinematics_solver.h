#pragma once

#include "base/rng.h"
#include "kinematics/task.h"

namespace rex {

struct InverseKinematicsOptions {
  int maxIterations = 100;      ///< of each start
  int maxRestarts = 50;         ///< from random postures, after the given one
  double stepTolerance = 1e-9;  ///< a start has converged where a step moves no joint further, in units of v
};

struct InverseKinematicsResult {
  enum class Status {
    kSolved,         ///< all tasks are within their tolerances, and those without are as good as they can be
    kUnreached,      ///< no start got there; q is the nearest posture of all, where no small step improves it
    kIterationLimit  ///< as before, but it might still improve
  };
  Status status = Status::kIterationLimit;
  Eigen::VectorXd q{};              ///< nq, within the limits
  std::vector<double> residuals{};  ///< max |y - y*| of each task, in the unit of its y
  double cost = 0;                  ///< |Phi(q)|^2 of slide 2:47
  int iterations = 0;               ///< of all starts
  int restarts = 0;
  std::string message{};  ///< says which task is how far from its target
};

/// The posture within the joint limits that minimises the cost |Phi(q)|^2 of all tasks (slides 2:27, 2:32 and
/// 2:47), by projected Levenberg-Marquardt steps with line search from `start` (nq; moved into the limits
/// first). |q - q0|_W^2 is a task as well: homingTask with kNoTolerance. While a task with a tolerance misses
/// its target, it starts again at random postures within the limits (joints without: half a turn or a metre
/// about `start`). Throws Error without tasks, for wrong sizes, options that are not positive, and as
/// stackTasks.
[[nodiscard]] InverseKinematicsResult solveInverseKinematics(const Model& model, std::span<const Task> tasks,
                                                             const VectorArg& start,
                                                             const InverseKinematicsOptions& options,
                                                             Rng& rng);

}  // namespace rex
