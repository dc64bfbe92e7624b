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
class Mover {
 public:
  virtual ~Mover() = default;
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

}  // namespace rex::internal
