#pragma once

#include "kinematics/task.h"
#include "trajectory/trajectory_problem.h"

namespace rex {

// These terms copy what they need from the model and own a workspace: threads must not share a problem with
// them. Configurations are postures q. Models with quaternions are not supported and throw Error.

/// A task over time (slide 5:4): sqrt(precision) times phi(x_t) - target for k = 0. For k = 1, 2 and 3 it
/// is sqrt(precision tau) times the k-th difference quotient of phi minus the target, which then is a
/// velocity, an acceleration or a jerk. Evaluating it throws Error naming the task for a target of the wrong
/// size. Throws Error for other orders, without a map, and for a precision that is not positive.
[[nodiscard]] TrajectoryTerm taskTerm(const Model& model, Task task, int order = 0);

/// The limits of the model's joints as inequalities (limitsTerm).
[[nodiscard]] TrajectoryTerm jointLimitsTerm(const Model& model);

}  // namespace rex
