#pragma once

#include "scene/model.h"
#include "trajectory/trajectory_optimizer.h"

namespace rex::bench {

/// The arm of data/robots/arm7.ors shall go from rest to rest within a second, in T steps, with little
/// acceleration; where there is an obstacle, a ball in the middle of the straight way of its tip, 5 cm from
/// it.
struct ArmTrajectory {
  ArmTrajectory(int steps, bool obstacle);

  bool hasObstacle;
  Model model;
  TrajectoryProblem problem;
  Eigen::MatrixXd start;  ///< the straight way
};

/// Solves it from the start. Throws std::logic_error unless it is solved.
[[nodiscard]] TrajectoryResult solve(const ArmTrajectory& arm);

}  // namespace rex::bench
