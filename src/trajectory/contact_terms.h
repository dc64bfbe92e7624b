#pragma once

#include "collision/contacts.h"
#include "trajectory/trajectory_problem.h"

namespace rex {

// Terms of order 1 that look at `samples` postures on the straight way from x_{t-1} to x_t, the last one x_t:
// thin obstacles lie between steps. They see all that is nearer than the margin there: nothing is missed
// where no point of the robot goes further than two margins between samples, and trajectoryClearance() proves
// it afterwards. As for task terms, threads must not share them, and models have no quaternions. They throw
// Error for a margin that is not positive and fewer than one sample.

struct ContactSampling {
  double margin = kContactMargin;  ///< metres
  int samples = 1;
};

/// Contact cost of slide 2:60 (contactCost) of each sample, times sqrt(precision / samples).
[[nodiscard]] TrajectoryTerm contactCostTerm(const Model& model, const ContactModel& contacts,
                                             const ContactSampling& sampling = {}, double precision = 1);

/// Each pair of contacts.pairs() keeps the margin in each sample, as inequalities: 1 - d / margin <= 0, the
/// rows of the first sample first. Pairs from two margins on count as that far.
[[nodiscard]] TrajectoryTerm clearanceTerm(const Model& model, const ContactModel& contacts,
                                           const ContactSampling& sampling = {});

/// The smallest distance of any pair on a trajectory, metres, and in which step.
struct TrajectoryClearance {
  double distance = 0;  ///< proven: no pair comes nearer (motionClearance). Infinite without pairs
  int step = 0;         ///< between columns step and step + 1
};

/// Of the straight ways from each column of a path (nq x N, N >= 2) to the next, within `tolerance` metres of
/// the largest that could be proven. Throws Error for fewer columns and as motionClearance().
[[nodiscard]] TrajectoryClearance trajectoryClearance(const Model& model, const ContactModel& contacts,
                                                      const MatrixArg& path, double tolerance);

}  // namespace rex
