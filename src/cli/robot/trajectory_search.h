#pragma once

#include "collision/contact_model.h"
#include "scene/model.h"
#include "trajectory/contact_terms.h"
#include "trajectory/trajectory_optimizer.h"

namespace rex::cli {

/// From rest at `start`, the point p_BQ of `body` shall come to p_WQ, and rest there, with little
/// acceleration and within the limits of the joints; while avoiding, all pairs of shapes stay `margin` metres
/// apart.
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

/// What was found, with the start before it.
struct FoundTrajectory {
  Eigen::MatrixXd path{};  ///< nq x (steps + 1), each `tau` seconds after the one before
  double tau = 0;
  double error = 0;              ///< how far the body's point is from the goal at the end, metres
  ConstrainedResult solution{};  ///< with the log of all iterations
  TrajectoryClearance clearance{};
  int samples = 0;     ///< postures of a step in which obstacles were looked at last; 0: none
  double cpuTime = 0;  ///< seconds

  [[nodiscard]] bool isSolved() const { return solution.status == ConstrainedStatus::kSolved; }
};

/// First without obstacles, from standing still; then, warm, with them, looked at in ever more postures of
/// each step until what lies between is proven clear. Throws Error as the terms, and for a model with
/// quaternions.
[[nodiscard]] FoundTrajectory findTrajectory(const TrajectoryTask& task);

}  // namespace rex::cli
