#pragma once

#include <array>
#include <vector>

#include "base/rng.h"
#include "collision/contact_model.h"
#include "scene/model.h"
#include "trajectory/trajectory_optimizer.h"

namespace rex::bench {

/// Two postures, and five balls and boxes that keep the margin from both; one of them is in the straight way.
struct ClutteredTask {
  Eigen::VectorXd from, to;
  std::vector<ShapeSpec> obstacles;
};
[[nodiscard]] ClutteredTask randomClutteredTask(Rng& rng);

/// The arm of data/robots/arm7.ors shall go from rest to rest within a second, in a hundred steps, five
/// centimetres from all obstacles.
struct ClutteredArm {
  ClutteredArm(ClutteredTask task, Rng& rng);

  ClutteredTask task;
  Model model;
  ContactModel contacts;
  TrajectoryProblem problem;
  std::array<Eigen::MatrixXd, 3> starts;  ///< the straight way, and two with a random bend
};

/// From one of the starts, with the same options for all.
[[nodiscard]] TrajectoryResult solve(const ClutteredArm& arm, const Eigen::MatrixXd& start);

/// Whether a result says that it is solved, and keeps clear of all obstacles between the steps, too.
[[nodiscard]] bool isRight(const ClutteredArm& arm, const TrajectoryResult& result);

}  // namespace rex::bench
