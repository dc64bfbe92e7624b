#pragma once

#include "optim/constrained_solver.h"
#include "trajectory/trajectory_problem.h"

namespace rex {

/// A trajectory and how it was found. Multipliers are ordered by term, then by step.
struct TrajectoryResult {
  Eigen::MatrixXd X{};  ///< n x T
  ConstrainedResult solution{};
};

/// Minimises the costs of a k-order problem under its constraints (slides 5:3 and 5:5) from `start` (n x
/// T), with the methods of solveConstrained(). The Hessian is banded, so a step takes time proportional to
/// T. For a warm start, pass an earlier X, with its multipliers and penalty in `options`. The status names
/// the most violated constraint with its step. Throws Error for a start of the wrong size, terms whose
/// values change size or whose Jacobians have the wrong size, and like solveConstrained().
[[nodiscard]] TrajectoryResult optimizeTrajectory(const TrajectoryProblem& problem, const MatrixArg& start,
                                                  const ConstrainedOptions& options = {});

/// T configurations (n x T) on the straight line, the first one step away from `from`, the last at `to`: a
/// start for optimizeTrajectory(). Throws Error for vectors of different sizes and T < 1.
[[nodiscard]] Eigen::MatrixXd straightTrajectory(const VectorArg& from, const VectorArg& to, int steps);

/// The shortest time step, seconds, for which the differences of the path (n x N, one configuration per
/// column) respect limits of velocity and acceleration (n, positive; empty: none). They scale with 1/tau
/// and 1/tau^2. Returns 0 without limits. Throws Error for limits of the wrong size or not positive.
[[nodiscard]] double shortestTau(const MatrixArg& path, const Eigen::VectorXd& velocityLimit,
                                 const Eigen::VectorXd& accelerationLimit);

}  // namespace rex
