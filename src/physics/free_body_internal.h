#pragma once

#include "physics/free_motion_internal.h"

namespace rex::internal {

/// A single body on a free joint of the world, which does not damp it.
class FreeBody : public Mover {
 public:
  /// The shape, in the frame of the link, must outlive it.
  FreeBody(const Joint& joint, const BulletLink& link, const Pose& X_WP, btCollisionShape* shape);

  btCollisionObject& object() { return body_; }
  void addTo(btMultiBodyDynamicsWorld& world) override { world.addRigidBody(&body_); }
  void removeFrom(btMultiBodyDynamicsWorld& world) override { world.removeRigidBody(&body_); }
  void place(const State& state) override;
  void read(State& state) const override { motion_.read(current(), state); }
  void drive(std::span<const Motor> motors, double h) override;
  void remember() override;
  void undo() override { set(remembered_); }
  [[nodiscard]] int runaway(double limit) const override;

 private:
  [[nodiscard]] FreeMotion::LinkMotion current() const;
  struct Raw {
    btTransform X_WL;
    btVector3 linear, angular;
  };
  void set(const Raw& raw);

  FreeMotion motion_;
  btRigidBody body_;
  int vIndex_;
  Raw remembered_;
};

}  // namespace rex::internal
