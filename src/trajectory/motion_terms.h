#pragma once

#include "trajectory/trajectory_problem.h"

namespace rex {

// Terms of slide 5:4 over configurations. Their rows are sqrt(w tau) times a difference quotient, so that
// the sum of squares over all steps approximates an integral over time, whatever tau is. `weights`: w of
// each coordinate, not negative; empty: ones. Evaluating terms throws Error for vectors that are not of
// size n.

/// Velocity (x_t - x_{t-1}) / tau, k = 1.
[[nodiscard]] TrajectoryTerm velocityTerm(Eigen::VectorXd weights = {});
/// Acceleration (x_t - 2 x_{t-1} + x_{t-2}) / tau^2, k = 2.
[[nodiscard]] TrajectoryTerm accelerationTerm(Eigen::VectorXd weights = {});
/// Jerk (x_t - 3 x_{t-1} + 3 x_{t-2} - x_{t-3}) / tau^3, k = 3.
[[nodiscard]] TrajectoryTerm jerkTerm(Eigen::VectorXd weights = {});

/// x_t - target, k = 0, not scaled by tau: for a posture on the way or at the end.
[[nodiscard]] TrajectoryTerm postureTerm(const VectorArg& target);
/// lower <= x_t <= upper as inequalities, k = 0; infinite entries are not limits. Throws Error for vectors
/// of different sizes, and if lower is above upper.
[[nodiscard]] TrajectoryTerm limitsTerm(const VectorArg& lower, const VectorArg& upper);
/// |x_t - x_{t-1}| <= limit tau as inequalities, k = 1; infinity is not a limit. Throws Error for limits that
/// are not positive.
[[nodiscard]] TrajectoryTerm velocityLimitsTerm(const VectorArg& limit);

/// x_T-1 = x and x_T-1 = x_T-2: a motion that ends at rest there, as two equalities.
[[nodiscard]] std::vector<TrajectoryTerm> restAt(const VectorArg& target, int steps);

}  // namespace rex
