#pragma once

#include "collision/contact_model.h"
#include "scene/model.h"
#include "trajectory/contact_terms.h"
#include "trajectory/trajectory_optimizer.h"

namespace rex::cli {

/// Moves a point of `body` from rest at `start` to rest at p_WQ, with little acceleration and within the
/// joint limits. If `avoids`, all pairs of shapes stay `margin` metres apart.
struct TrajectoryTask {
  Model model;
  ContactModel contacts;
  BodyId body;
  Eigen::Vector3d p_WQ;
  Eigen::VectorXd start;
  bool avoids = false;
  double margin = 0.02;
  int steps = 100;
  double seconds = 2;
  ConstraintMethod method = ConstraintMethod::kAugmentedLagrangian;
};

/// The trajectory found, beginning with the start.
struct FoundTrajectory {
  Eigen::MatrixXd path{};  ///< nq x (steps + 1), `tau` seconds apart
  double tau = 0;
  double error = 0;              ///< final distance of the body's point from the goal, metres
  ConstrainedResult solution{};  ///< with the log of all iterations
  TrajectoryClearance clearance{};
  int samples = 0;     ///< postures per step checked for obstacles in the last round; 0: none
  double cpuTime = 0;  ///< seconds

  [[nodiscard]] bool isSolved() const { return solution.status == ConstrainedStatus::kSolved; }
};

/// First solves the problem without obstacles, starting from standing still. Then solves it with obstacles
/// from a warm start, checking more and more postures per step until everything in between is proven clear.
/// Throws Error like the terms, and for a model with quaternions.
[[nodiscard]] FoundTrajectory findTrajectory(const TrajectoryTask& task);

}  // namespace rex::cli
