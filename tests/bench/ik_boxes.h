#pragma once

#include <vector>

#include "collision/contact_model.h"
#include "kinematics/inverse_kinematics_solver.h"

namespace rex::bench {

/// The arm of data/robots/arm7dof among ten boxes, and poses of its flange that postures free of contact
/// reach.
struct IkAmongBoxes {
  explicit IkAmongBoxes(int poses);

  Model model;
  ContactModel contacts;
  BodyId tip;
  Eigen::VectorXd middle;  ///< of the limits: where each search begins
  std::vector<Pose> targets;
};

/// A posture free of contact, for a target.
[[nodiscard]] InverseKinematicsResult solve(const IkAmongBoxes& problem, std::size_t k);
/// Whether a posture leads to target k, within the limits and with all pairs of shapes apart: by forward
/// kinematics and the distance of each pair, not by what the solver asks.
[[nodiscard]] bool isRight(const IkAmongBoxes& problem, std::size_t k, const Eigen::VectorXd& q);

}  // namespace rex::bench
