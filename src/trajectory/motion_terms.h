#pragma once

#include "collision/contacts.h"
#include "kinematics/task_maps.h"
#include "trajectory/trajectory_optimizer.h"

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
[[nodiscard]] std::vector<TrajectoryTerm> restTerms(const VectorArg& target, int steps);

// Terms of order 1 that evaluate `samples` postures on the straight segment from x_{t-1} to x_t, the last
// one being x_t, because thin obstacles may lie between steps. Nothing is missed if no point of the robot
// moves more than two margins between samples; trajectoryClearance() proves it afterwards. As for task
// terms, threads must not share them, and the model must not have quaternions. They throw Error for a
// margin that is not positive and for fewer than one sample.

struct ContactSampling {
  double margin = kContactMargin;  ///< metres
  int samples = 1;
};

/// Contact cost of slide 2:60 (contactCost) for each sample, times sqrt(precision / samples).
[[nodiscard]] TrajectoryTerm contactCostTerm(const Model& model, const ContactModel& contacts,
                                             const ContactSampling& sampling = {}, double precision = 1);

/// Each pair of contacts.pairs() keeps the margin in each sample, as inequalities: 1 - d / margin <= 0, the
/// rows of the first sample first. Distances are capped at two margins.
[[nodiscard]] TrajectoryTerm clearanceTerm(const Model& model, const ContactModel& contacts,
                                           const ContactSampling& sampling = {});

/// The smallest distance of any pair on a trajectory, and the step in which it occurs.
struct TrajectoryClearance {
  double distance = 0;  ///< metres, proven: no pair comes nearer (motionClearance). Infinite without pairs
  int step = 0;         ///< between columns step and step + 1
};

/// The clearance of the straight segments between consecutive columns of a path (nq x N, N >= 2), within
/// `tolerance` metres of the largest provable value. Throws Error for fewer columns and like
/// motionClearance().
[[nodiscard]] TrajectoryClearance trajectoryClearance(const Model& model, const ContactModel& contacts,
                                                      const MatrixArg& path, double tolerance);

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
