#pragma once

#include <limits>
#include <span>
#include <string>
#include <vector>

#include "kinematics/task_map.h"

namespace rex {

/// The tolerance of a task that is only weighed against others: no distance from its target is too large.
inline constexpr double kNoTolerance = std::numeric_limits<double>::infinity();

/// One of several things that a robot should do: bring the value of a task map to a target (slide 2:47).
struct Task {
  std::string name{};        ///< for messages
  TaskMap map{};             ///< gives y (d)
  Eigen::VectorXd target{};  ///< y* (d); empty: zero
  double precision = 1;      ///< rho > 0: the task costs rho |y - y*|^2
  double tolerance = 1e-6;   ///< the task is fulfilled if max |y - y*| is at most this; see kNoTolerance
};

/// The big task of slide 2:47: Phi, which stacks sqrt(rho_i) (y_i - y_i*) of all tasks, and its Jacobian.
/// Its target is zero and its metric the identity. Throws Error naming the task if it has no map, a
/// precision that is not positive or a negative tolerance, or if its value, Jacobian or target has the
/// wrong size or a number that is not finite.
[[nodiscard]] TaskValue stackTasks(std::span<const Task> tasks, const Posture& at);
/// Overload for hot loops. `values` becomes the unweighted value of each task, `phi` the stack. If the maps
/// do not allocate, neither does it, once both have been used with these tasks.
void stackTasks(std::span<const Task> tasks, const Posture& at, std::vector<TaskValue>& values,
                TaskValue& phi);

/// max |y - y*| of a task's value, in the unit of y.
[[nodiscard]] double taskError(const Task& task, const TaskValue& value);

}  // namespace rex
