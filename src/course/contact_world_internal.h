#pragma once

#include <memory>

#include "physics/physics_world.h"

namespace rex::internal {

/// The world in which a simulator moves with contact, made for the first step and kept for the next. A copy
/// starts a fresh one, without the contact forces of the last step, from which the solver would start.
class ContactWorld {
 public:
  ContactWorld() = default;
  ContactWorld(const ContactWorld&) {}
  ContactWorld& operator=(const ContactWorld&) = delete;

  /// Moves the state on by tau seconds under joint forces u (nv).
  /// Throws Error as Simulator::stepPhysics.
  void step(const Model& model, const Eigen::Vector3d& gravity_W, const Eigen::VectorXd& u, double tau,
            State& state);

 private:
  std::unique_ptr<PhysicsWorld> world_{};
  Eigen::Vector3d gravity_W_ = Eigen::Vector3d::Zero();
  std::vector<Motor> motors_{};
};

}  // namespace rex::internal
