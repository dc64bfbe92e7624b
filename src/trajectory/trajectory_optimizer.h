#pragma once

#include "optim/constrained_solver.h"
#include "trajectory/trajectory_problem.h"

namespace rex {

/// A trajectory and how it was found. Rows of multipliers are those of the terms in order, each with its
/// steps in order.
struct TrajectoryResult {
  Eigen::MatrixXd X{};  ///< n x T
  ConstrainedResult solution{};
};

/// Minimises the costs of a k-order problem under its constraints (slides 5:3 and 5:5) from `start` (n x T),
/// with the methods of solveConstrained(): a step is solved in the band of second derivatives, in time
/// proportional to T. To start warm, pass an earlier X, and its multipliers in `options`; its penalty too.
/// The status names the most violated constraint with its step. Throws Error for a start of another size,
/// terms whose values change their size or whose Jacobians have the wrong one, and as solveConstrained().
[[nodiscard]] TrajectoryResult optimizeTrajectory(const TrajectoryProblem& problem, const MatrixArg& start,
                                                  const ConstrainedOptions& options = {});

/// T configurations on the straight way from one to another, the first one step away from `from`, the last
/// at `to`: a start for optimizeTrajectory(). n x T. Throws Error for vectors of two sizes and T < 1.
[[nodiscard]] Eigen::MatrixXd straightTrajectory(const VectorArg& from, const VectorArg& to, int steps);

/// The shortest time from one configuration to the next, seconds, with which the differences of the path (n x
/// N, one per column) keep velocities and accelerations within limits (n, positive; empty: none): they scale
/// with 1/tau and 1/tau^2. 0 without limits. Throws Error for limits of another size or not positive.
[[nodiscard]] double shortestTau(const MatrixArg& path, const Eigen::VectorXd& velocityLimit,
                                 const Eigen::VectorXd& accelerationLimit);

}  // namespace rex
