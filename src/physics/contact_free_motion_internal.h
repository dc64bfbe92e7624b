#pragma once

#include <array>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include <Eigen/Cholesky>

#include "dynamics/equations_of_motion.h"
#include "dynamics/stepper.h"
#include "physics/physics_world.h"

namespace rex::internal {

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// Limits become active within this distance, radians or metres, or within twice the motion of a step.
inline constexpr double kLimitReach = 0.01;

/// What bounds, resists or pulls the motion of one coordinate.
struct JointLaw {
  double lower = -kInfinity, upper = kInfinity;
  double damping = 0, friction = 0, maxVelocity = kInfinity;
  double armature = 0, stiffness = 0;
};

/// The law of entry `coordinate` of a joint's v; balls have no limits.
[[nodiscard]] JointLaw jointLaw(const Model& model, const Joint& joint, int coordinate,
                                const PhysicsOptions& options);

/// Where a coordinate is at the start of a step.
struct JointPlace {
  double q = 0, v = 0;
  double stretch = 0;  ///< of its spring
  double inertia = 0;  ///< that it meets, or less: kg m^2 or kg; matters for springs only
};

/// The impulse of a spring in a step of h seconds.
[[nodiscard]] inline double springImpulse(const JointLaw& law, double stretch, double h) {
  return -h * law.stiffness * stretch;
}

/// Wants a velocity of a coordinate to be `velocity`, with impulses within bounds. It yields by `softness`
/// times the impulse.
struct JointGoal {
  double velocity = 0;
  double lowest = 0, highest = 0;  ///< impulse: N s, or N m s
  double softness = 0;
};

enum JointPurpose { kMotor, kDamping, kFriction, kLowerLimit, kUpperLimit, kJointPurposes };
using JointGoals = std::array<std::optional<JointGoal>, kJointPurposes>;

/// What a coordinate is to do in a step of h seconds, beside springImpulse(). Springs too stiff for the step
/// are damped.
[[nodiscard]] JointGoals jointGoals(const JointLaw& law, const Motor& motor, const JointPlace& at, double h);

/// The velocities v that minimise (v - M^-1 p)^T M (v - M^-1 p) / 2 plus, for each coordinate, the convex and
/// piecewise linear or quadratic cost whose slopes are the impulses of its goals: motors, friction and limits
/// of joints, solved exactly and together. Block principal pivoting: each coordinate is tried at a goal's
/// velocity or between two, and moves on as long as its impulse or its velocity lies outside. Júdice and
/// Pires, A block principal pivoting algorithm for large-scale strictly monotone linear complementarity
/// problems, 1994.
class JointImpulses {
 public:
  explicit JointImpulses(Eigen::Index count);

  /// Tells what coordinate i is to do in the next step.
  void set(Eigen::Index i, const JointGoals& goals);
  /// Solves for v, which holds the velocities of the last step. M is symmetric and positive definite and is
  /// overwritten. False if none is found, which only rounding can cause.
  bool solve(Eigen::MatrixXd& M, const Eigen::VectorXd& p, Eigen::VectorXd& v);
  /// Forgets where the last solution was, from which the next search begins.
  void reset();

 private:
  // The impulse drops from `highest` to `lowest` where the velocity is this.
  struct Edge {
    double velocity = 0, lowest = 0, highest = 0;
    int purpose = kMotor;
  };
  // An odd place 2 k + 1 is at edge k, an even one, 2 k, below edge k and above the one before.
  struct Coordinate {
    std::array<Edge, 4> edges{};
    int count = 0, place = 0, last = -1;  // last: the purpose at which it was at the end of the last step
    double softening = 0;                 // 1 / softness of the damping
  };

  static void insert(Coordinate& one, const Edge& edge);
  static double impulseAbove(const Coordinate& one, int edges);
  static bool isForbidden(const Coordinate& one);
  bool move(Eigen::Index i, double v, double impulse);
  void begin(const Eigen::VectorXd& v);

  std::vector<Coordinate> coordinates_;
  Eigen::MatrixXd A_;
  Eigen::VectorXd b_, impulse_;
  Eigen::LLT<Eigen::MatrixXd> llt_;
};

/// Moves a model of hinges that nothing touches by the equation of motion alone: by Stepper, which keeps its
/// energy, where only forces act, those of springs included; and with the new v, as Bullet, where motors,
/// friction, damping, limits or springs too stiff for Stepper do.
class ContactFreeMotion {
 public:
  ContactFreeMotion(const Model& model, const PhysicsOptions& options);

  void setMotors(std::span<const Motor> motors);
  /// Advances all but the time by h. False, and the state is as it was, if it cannot: joints of other kinds,
  /// or a motion too fast.
  bool step(State& state, double h);
  /// Forgets the past, so that the same steps follow as from a new one.
  void reset();

 private:
  [[nodiscard]] bool onlyForcesAct(const State& state, double h) const;
  void findMobility(const State& state);
  void stepFreely(State& state, double h, int count);
  bool stepWithGoals(State& state, double h, int count);
  bool stepWithGoals(State& state, double h);

  const Model* model_;
  Eigen::Vector3d gravity_W_;
  bool isAble_, hasForcesOnly_ = true, resists_ = false;
  std::vector<JointLaw> laws_{};
  std::vector<Motor> motors_;
  std::optional<Stepper> stepper_{}, fastStepper_{};  // if it is able
  JointImpulses impulses_;
  Eigen::VectorXd u_, p_, v_;
  Eigen::VectorXd stiffness_{}, rest_{};  // of springs
  Eigen::VectorXd mobility_{};            // the diagonal of M^-1, of models with springs
  EquationOfMotion motion_{};
  DynamicsWorkspace workspace_{};
  State next_{};
};

}  // namespace rex::internal
