#pragma once

#include <memory>

#include "physics/physics_world.h"

namespace rex::internal {

/// The world in which a simulator moves with contact, made for the first step and kept for the next. A copy
/// starts a fresh one, without the contact forces of the last step, from which the solver would start.
class ContactWorld {
 public:
  ContactWorld() = default;
  ContactWorld(const ContactWorld& other) : contacts_(other.contacts_), innerStep_(other.innerStep_) {}
  ContactWorld& operator=(const ContactWorld&) = delete;
  ContactWorld& operator=(ContactWorld&&) = default;

  /// Moves the state on by tau seconds under joint forces u (nv) and motors (nv), those of the kind kForce
  /// aside. Throws Error as Simulator::stepPhysics.
  void step(const Model& model, const Eigen::Vector3d& gravity_W, const std::vector<Motor>& motors,
            const Eigen::VectorXd& u, double tau, State& state);

  /// Of the last inner step, and how long that was, seconds.
  const std::vector<PhysicsContact>& contacts() const { return contacts_; }
  double innerStep() const { return innerStep_; }

 private:
  std::vector<PhysicsContact> contacts_{};
  double innerStep_ = 0;
  std::unique_ptr<PhysicsWorld> world_{};
  Eigen::Vector3d gravity_W_{0, 0, 0};
  std::vector<Motor> motors_{};
};

}  // namespace rex::internal
