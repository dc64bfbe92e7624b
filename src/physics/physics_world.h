#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "scene/state.h"

namespace rex {

struct PhysicsOptions {
  Eigen::Vector3d gravity_W{0, 0, -9.81};
  double friction = 0.6;   ///< of every shape that touches
  double restitution = 0;  ///< 0: nothing bounces, 1: without loss
  bool jointLimits = true;
  bool jointFriction = true;  ///< Joint::damping and friction of the scene
  int iterations = 20;        ///< of the solver, per step
};

/// What drives a coordinate of v (see Joint::vIndex): a force, or a motor that holds a velocity or a position
/// with at most `maxForce`.
struct Motor {
  enum class Kind { kForce, kVelocity, kPosition };
  Kind kind = Kind::kForce;
  double target = 0;    ///< N m or N; rad/s or m/s; rad or m
  double maxForce = 0;  ///< of velocity and position motors
};

/// Two shapes that touch after a step: places in Model::shapes().
struct PhysicsContact {
  int shapeA = 0, shapeB = 0;
  Eigen::Vector3d p_WA, p_WB;  ///< nearest points on each, in W
  Eigen::Vector3d normal_W;    ///< unit, from B to A
  double distance = 0;         ///< metres, negative in overlap
  double impulse = 0;          ///< N s along the normal, of the last step
};

/// What a ray hits first.
struct RayHit {
  int shape = 0;  ///< place in Model::shapes()
  Eigen::Vector3d p_WQ, normal_W;
  double distance = 0;  ///< metres from the start of the ray
};

/// Simulation with contact of one model: Bullet's multibody dynamics in double precision, deterministic. Only
/// this module knows Bullet.
class PhysicsWorld {
 public:
  /// Throws Error for what cannot be simulated, naming it: joints that mimic others, moving bodies without
  /// mass.
  explicit PhysicsWorld(const Model& model, const PhysicsOptions& options = {});
  PhysicsWorld(PhysicsWorld&&) noexcept;
  PhysicsWorld& operator=(PhysicsWorld&&) noexcept;
  ~PhysicsWorld();

  [[nodiscard]] State state() const;
  /// Throws Error for wrong sizes and numbers that are not finite.
  void setState(const State& state);
  /// One motor for each number of v; at first all are forces of zero. Throws Error for a wrong number of them
  /// and for bad numbers.
  void setMotors(std::span<const Motor> motors);
  /// One step of h > 0 seconds. Throws Error for other h, and if the motion grows without bounds, naming time
  /// and joint; the state is then as before.
  void step(double h);
  /// The contacts of the last step, in a fixed order.
  [[nodiscard]] std::vector<PhysicsContact> contacts() const;
  /// The first shape between two points, if any.
  [[nodiscard]] std::optional<RayHit> rayCast(const Eigen::Vector3d& from_W,
                                              const Eigen::Vector3d& to_W) const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace rex
