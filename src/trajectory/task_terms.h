#pragma once

#include "kinematics/task.h"
#include "trajectory/trajectory_problem.h"

namespace rex {

// These terms copy what they need of the model, and keep room to work in: threads must not share a problem
// with them. Configurations are postures q; models with quaternions are refused with an Error.

/// A task over time (slide 5:4): sqrt(precision) times phi(x_t) - target for k = 0, and for k = 1 and 2 times
/// sqrt(tau) and the k-th difference quotient of phi, less the target, which then is a velocity or
/// an acceleration. Evaluating it throws Error naming the task for a target of another size. Throws Error for
/// another order, without a map, and for a precision that is not positive.
[[nodiscard]] TrajectoryTerm taskTerm(const Model& model, Task task, int order = 0);

/// The limits of the model's joints as inequalities (limitsTerm).
[[nodiscard]] TrajectoryTerm jointLimitsTerm(const Model& model);

}  // namespace rex
