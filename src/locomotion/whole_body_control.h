#pragma once

#include <vector>

#include "dynamics/inverse_dynamics.h"
#include "geometry/pose.h"
#include "locomotion/walking_pattern.h"
#include "locomotion/zero_moment_point.h"
#include "optim/quadratic_program.h"
#include "scene/state.h"

namespace rex {

/// What a foot should do: stand, or move freely.
struct FootGoal {
  bool stands = true;  ///< whether it may push against the ground
  Vector6d acceleration =
      Vector6d::Zero();  ///< of the centre of the sole, then angular; W, m/s^2 and rad/s^2
};

/// The accelerations that a robot on two feet should have.
struct WholeBodyGoal {
  FootGoal left{}, right{};
  Eigen::Vector3d center_W{0, 0, 0};           ///< of the centre of mass, m/s^2
  Eigen::Vector3d angularMomentum_W{0, 0, 0};  ///< its rate, about the centre of mass, N m
  Eigen::Vector3d trunk_W{0, 0, 0};            ///< angular, rad/s^2
  Eigen::VectorXd joints{};                    ///< nv; those of the trunk's free joint are not used
};

/// Weights of the squared errors of a WholeBodyGoal, and of the forces.
struct WholeBodyOptions {
  double friction = 0.4;  ///< forces stay in the pyramid |f_x|, |f_y| <= friction f_z; below the true one
  double standing = 200, swinging = 50, center = 20, angularMomentum = 0.02, trunk = 5;
  double legs = 1e-3, joints = 0.3;  ///< of joints between trunk and feet, and of all others
  double forces = 2e-6;
};

/// Joint forces, and what they should cause.
struct WholeBodyForces {
  QuadraticStatus status = QuadraticStatus::kStalled;  ///< the rest is empty unless kOptimal
  Eigen::VectorXd u{};                   ///< nv, within the limits of effort; zero for the free joint
  Eigen::VectorXd a{};                   ///< nv: M a + F = u + the effect of the contacts
  std::vector<ContactForce> contacts{};  ///< at the four corners of each standing sole
  double residual = 0;                   ///< of the optimality conditions, see QuadraticSolution
  std::vector<int> active{};             ///< rows at their bound: a guess for the next call
};

/// The accelerations and contact forces nearest to the goal that obey the equation of motion, the limits of
/// effort of all joints and the friction pyramids: a quadratic program. Herzog et al. 2016, Momentum control
/// with hierarchical inverse dynamics on a torque-controlled humanoid, here with weights instead of
/// priorities. Nothing but the joints and the ground moves the robot: the rows of the trunk's free joint have
/// no force.
class WholeBodyControl {
 public:
  /// Throws Error for a trunk that is not moved by a free joint of the world, feet that do not hang on it,
  /// options and sizes of the sole that are not positive, and a model without mass.
  WholeBodyControl(const Model& model, const Legs& legs, const Sole& sole,
                   const WholeBodyOptions& options = {});

  /// `guess`: the active rows of the last call; it changes the work, not the answer. Throws Error for sizes
  /// that do not fit and numbers that are not finite.
  [[nodiscard]] WholeBodyForces forces(const State& state, const WholeBodyGoal& goal,
                                       const std::vector<int>& guess = {}) const;

 private:
  Model model_;
  Legs legs_;
  Sole sole_;
  WholeBodyOptions options_;
  int base_ = 0;              // the first of the trunk's six coordinates in v
  Eigen::VectorXd effort_{};  // nv: zero for the trunk
  Eigen::VectorXd weight_{};  // nv: of the goals of joints
};

}  // namespace rex
