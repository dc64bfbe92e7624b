#pragma once

#include "collision/contacts.h"
#include "trajectory/trajectory_problem.h"

namespace rex {

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

}  // namespace rex
