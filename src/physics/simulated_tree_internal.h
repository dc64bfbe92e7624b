#pragma once

#include <span>

#include <BulletDynamics/Featherstone/btMultiBodyDynamicsWorld.h>

#include "physics/physics_world.h"

namespace rex::internal {

/// A body with what Bullet wants to know of it: its frame L at the centre of mass, along the principal axes
/// of its inertia.
struct BulletLink {
  Pose X_BL{};
  double mass = 0;
  btVector3 inertia{0, 0, 0};  ///< principal moments, kg m^2
};
[[nodiscard]] BulletLink bulletLink(const Body& body);

/// Part of the model that moves by itself: what hangs on one joint of the world.
class SimulatedTree {
 public:
  virtual ~SimulatedTree() = default;
  virtual void addTo(btMultiBodyDynamicsWorld& world) = 0;
  virtual void removeFrom(btMultiBodyDynamicsWorld& world) = 0;

  /// Sets the state, and forgets forces and whatever else of the past.
  virtual void place(const State& state) = 0;
  /// Writes its part of q and v.
  virtual void read(State& state) const = 0;
  /// Sets what drives it in the next step of h seconds; `motors` are those of the whole model.
  virtual void drive(std::span<const Motor> motors, double h) = 0;

  /// Remembers the state for undo(); cheaper than read().
  virtual void remember() = 0;
  /// Sets what remember() has seen.
  virtual void undo() = 0;
  /// The place in v of a velocity that is not finite or beyond `limit`, or -1.
  [[nodiscard]] virtual int runaway(double limit) const = 0;
};

/// How the coordinates of a free joint of the world describe the motion of its link, whose frame L is where
/// bulletLink() puts it.
class FreeMotion {
 public:
  /// X_WP is the pose of the joint's parent, which stands still.
  FreeMotion(const Joint& joint, const Pose& X_WP, const Pose& X_BL);

  /// Pose of the link, and velocity of its origin, in W.
  struct LinkMotion {
    Pose X_WL{};
    Eigen::Vector3d linear_W, angular_W;
  };
  [[nodiscard]] LinkMotion linkMotion(const State& state) const;
  void read(const LinkMotion& motion, State& state) const;

  /// Whether wrench() is zero, whatever the motion.
  [[nodiscard]] bool isIdle(std::span<const Motor> motors) const;
  /// Force and torque at the link's origin, in W: what the motors (forces all) demand.
  struct Wrench {
    Eigen::Vector3d force_W, torque_W;
  };
  /// From the link's origin to that of the joint's moved frame, in W.
  [[nodiscard]] Eigen::Vector3d p_LM_W(const LinkMotion& motion) const { return motion.X_WL.R * X_LM_.p; }
  [[nodiscard]] Wrench wrench(std::span<const Motor> motors, const LinkMotion& motion) const;

 private:
  int qIndex_, vIndex_;
  Pose X_WF_, X_ML_, X_LM_;
};

/// A single body on a free joint of the world, which does not damp it.
class FreeBody : public SimulatedTree {
 public:
  /// The shape, in the frame of the link, must outlive it. `lift_W` acts at its centre of mass, N.
  FreeBody(const Joint& joint, const BulletLink& link, const Pose& X_WP, btCollisionShape* shape,
           const Eigen::Vector3d& lift_W = Eigen::Vector3d::Zero());

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
  btVector3 lift_;
  Raw remembered_;
};

}  // namespace rex::internal
