#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "scene/state.h"

namespace rex {

struct PhysicsOptions {
  Eigen::Vector3d gravity_W{0, 0, -9.81};
  double friction = 0.6;      ///< of every shape that touches
  double restitution = 0;     ///< 0: nothing bounces, 1: without loss. Stacks stand best with 0
  bool jointLimits = true;    ///< what starts beyond comes back at 1 rad/s or m/s at most
  bool jointFriction = true;  ///< Joint::damping and friction of the scene (of free joints, damping only)
  int iterations = 20;        ///< of the solver, per step
};

/// What drives a coordinate of v (see Joint::vIndex): a force, or, of plain coordinates, a motor that holds a
/// velocity or a position with at most `maxForce`. No motor is faster than Joint::maxVelocity, and a position
/// is approached at 20 /s of the way that is left.
struct Motor {
  enum class Kind { kForce, kVelocity, kPosition };
  Kind kind = Kind::kForce;
  double target = 0;    ///< N m or N; rad/s or m/s; rad or m
  double maxForce = 0;  ///< of velocity and position motors
};

/// Two shapes that touch in an inner step, where they are at its start: places in Model::shapes().
struct PhysicsContact {
  int shapeA = 0, shapeB = 0;
  Eigen::Vector3d p_WA, p_WB;  ///< nearest points on each, in W
  Eigen::Vector3d normal_W;    ///< unit, from B to A
  double distance = 0;         ///< metres, negative in overlap
  double impulse = 0;          ///< N s along the normal, of the inner step
};

/// Two shapes that begin or cease to touch: places in Model::shapes(), the smaller one first.
struct ContactEvent {
  enum class Kind { kBegin, kEnd };
  Kind kind = Kind::kBegin;
  int shapeA = 0, shapeB = 0;
  double time = 0;  ///< seconds; start of the first inner step in which they do
};

/// What a ray hits first.
struct RayHit {
  int shape = 0;  ///< place in Model::shapes()
  Eigen::Vector3d p_WQ, normal_W;
  double distance = 0;  ///< metres from the start of the ray
};

/// Simulation with contact of one model: Bullet's multibody dynamics in double precision, deterministic; v
/// moves on first, then q with the new v, and errors are of first order in the step. What may collide is told
/// by ContactModel; meshes collide as their convex hulls. It holds a stack of 20 boxes. What starts in
/// overlap comes apart at 1 m/s at most. Joints that mimic follow to rounding, and a motor moves all that
/// share its coordinate. Only this module knows Bullet.
class PhysicsWorld {
 public:
  /// Throws Error for what cannot be simulated, naming it: ball and free joints that mimic others, moving
  /// bodies without mass, options out of range; and as ContactModel.
  explicit PhysicsWorld(const Model& model, const PhysicsOptions& options = {});
  PhysicsWorld(PhysicsWorld&&) noexcept;
  PhysicsWorld& operator=(PhysicsWorld&&) noexcept;
  ~PhysicsWorld();

  [[nodiscard]] State state() const;
  /// Forgets all contacts, so that the same steps follow as in a new world. Throws Error for wrong sizes, for
  /// numbers that are not finite and for quaternions that are zero.
  void setState(const State& state);
  /// One motor for each number of v; at first all are forces of zero. Throws Error for a wrong number of them
  /// and for bad numbers.
  void setMotors(std::span<const Motor> motors);
  /// Moves on by h seconds, 1e-9 to 1000, in equal inner steps of a millisecond at most. Throws Error for
  /// other h, and if the motion grows without bounds, naming time and joint; the state is then as before.
  void step(double h);
  /// The contacts of the last inner step, in a fixed order.
  [[nodiscard]] std::vector<PhysicsContact> contacts() const;
  /// The shapes that are more than `depth` metres in overlap where they are now, the deepest point of each
  /// pair, without impulses; sorted by pair. Forgets all contacts, as setState().
  [[nodiscard]] std::vector<PhysicsContact> overlaps(double depth = 1e-4);
  /// What began and ended between shapes in the last step, also if it was over at once, by time. After
  /// setState() everything begins anew.
  [[nodiscard]] std::vector<ContactEvent> events() const;
  /// The first shape between two points, if any: flat faces exactly, round ones to a millimetre. Throws Error
  /// for numbers that are not finite.
  [[nodiscard]] std::optional<RayHit> rayCast(const Eigen::Vector3d& from_W,
                                              const Eigen::Vector3d& to_W) const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace rex
