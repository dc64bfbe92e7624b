#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "scene/state.h"

namespace rex {

struct PhysicsOptions {
  Eigen::Vector3d gravity_W{0, 0, -9.81};
  double friction = 0.6;      ///< friction coefficient of all contacts
  double restitution = 0;     ///< 0: nothing bounces, 1: no energy loss. Stacks are most stable with 0
  bool jointLimits = true;    ///< a joint that starts beyond comes back at 1 rad/s or m/s at most
  bool jointFriction = true;  ///< Joint::damping and friction of the scene (of free joints, damping only)
  int iterations = 20;        ///< iterations of the solver per step, at most; it stops where nothing changes
};

/// The drive of an entry of v (see Joint::vIndex): a force, or, unless it belongs to a quaternion, a motor
/// that holds a velocity or a position with at most `maxForce`. No motor is faster than Joint::maxVelocity;
/// a position is approached at 20 /s times the remaining distance.
struct Motor {
  enum class Kind { kForce, kVelocity, kPosition };
  Kind kind = Kind::kForce;
  double target = 0;    ///< N m or N; rad/s or m/s; rad or m
  double maxForce = 0;  ///< limit of velocity and position motors
};

/// Two shapes, as indices of Model::shapes(), that touch in an inner step, at their poses at its start.
struct PhysicsContact {
  int shapeA = 0, shapeB = 0;
  Eigen::Vector3d p_WA, p_WB;           ///< the nearest points of A and B, in W
  Eigen::Vector3d normal_W;             ///< unit, from B to A
  double distance = 0;                  ///< metres, negative in overlap
  double impulse = 0;                   ///< N s along the normal, during the inner step
  Eigen::Vector3d friction_W{0, 0, 0};  ///< N s on A, across the normal, during that step
};

/// Two shapes that begin or cease to touch, as indices of Model::shapes(), the smaller one first.
struct ContactEvent {
  enum class Kind { kBegin, kEnd };
  Kind kind = Kind::kBegin;
  int shapeA = 0, shapeB = 0;
  double time = 0;  ///< start of the first inner step in which they do, seconds
};

/// The first hit of a ray.
struct RayHit {
  int shape = 0;  ///< index of Model::shapes()
  Eigen::Vector3d p_WQ, normal_W;
  double distance = 0;  ///< metres from the start of the ray
};

/// Simulation of one model with contacts, by Bullet's multibody dynamics in double precision;
/// deterministic. It advances v first, then q with the new v, and errors are of first order in the step.
/// Our own dynamics moves a robot that has only hinges and no pins while nothing can touch it: where only
/// forces act, by Stepper's kBeeman, which keeps their energy; else by Bullet's rule, with motors, friction,
/// damping and limits of joints solved exactly. Armatures and springs act in both; springs that a step is too
/// long for are damped. ContactModel says what may collide; meshes collide as their convex hulls. A stack of
/// 20 boxes stays up. Moving overlapping shapes apart adds no energy: it happens at 0.25 m/s at most, and
/// they keep none of that speed. Mimic joints follow to rounding, and a motor moves all joints that share its
/// coordinate. Points of pins stay together to first order in the step h: a relative acceleration c leaves a
/// gap of c h / (400 /s). Gaps at the start close at 1 m/s at most; a loop that cannot be closed moves
/// wildly. Only this module knows Bullet.
class PhysicsWorld {
 public:
  /// Throws Error for what cannot be simulated, naming it: ball and free joints that mimic others, moving
  /// bodies without mass, options out of range; and as ContactModel.
  explicit PhysicsWorld(const Model& model, const PhysicsOptions& options = {});
  PhysicsWorld(PhysicsWorld&&) noexcept;
  PhysicsWorld& operator=(PhysicsWorld&&) noexcept;
  ~PhysicsWorld();

  [[nodiscard]] State state() const;
  /// Sets the state and forgets all contacts, so that the same steps follow as in a new world. Throws Error
  /// for wrong sizes, for numbers that are not finite and for quaternions that are zero.
  void setState(const State& state);
  /// Sets one motor for each entry of v; initially all are zero forces. Throws Error for the wrong number
  /// of motors and for invalid settings.
  void setMotors(std::span<const Motor> motors);
  /// Advances by h seconds, 1e-9 to 1000, in equal inner steps of at most a millisecond. Throws Error for
  /// other h, and if the motion grows without bounds, naming time and joint; the state is then unchanged.
  void step(double h);
  /// The contacts of the last inner step, in a fixed order.
  [[nodiscard]] std::vector<PhysicsContact> contacts() const;
  /// The pairs of shapes that now overlap by more than `depth` metres, each with its deepest point and
  /// without impulse, sorted by pair. Forgets all contacts, as setState() does.
  [[nodiscard]] std::vector<PhysicsContact> overlaps(double depth = 1e-4);
  /// The contacts that began or ended in the last step, also if they were over at once, sorted by time.
  /// After setState() all contacts start again.
  [[nodiscard]] std::vector<ContactEvent> events() const;
  /// The first hit between two points, if any: exact on flat faces, to a millimetre on round ones. Throws
  /// Error for numbers that are not finite.
  [[nodiscard]] std::optional<RayHit> rayCast(const Eigen::Vector3d& from_W,
                                              const Eigen::Vector3d& to_W) const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace rex
