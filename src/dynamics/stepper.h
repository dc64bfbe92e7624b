#pragma once

#include <memory>
#include <vector>

#include "dynamics/inverse_dynamics.h"
#include "scene/model.h"
#include "scene/state.h"

namespace rex {

/// Forces of the joints themselves; all but springs must be switched on.
struct JointForces {
  bool springs = true;  ///< those of the scene, see dynamics/joint_springs.h
  /// -damping v - friction tanh(v / frictionSpeed), with the numbers of the scene (Joint::damping, friction).
  bool friction = false;
  double frictionSpeed = 1e-2;  ///< at which friction has reached 76 % of its value, rad/s or m/s
  /// Limits push back with limitStiffness per unit by which a coordinate is beyond, and limitDamping per
  /// unit of v meanwhile: soft forces, N m/rad and N m s/rad, or N/m and N s/m. 0: limits have no effect.
  /// Quaternions have none.
  double limitStiffness = 0;
  double limitDamping = 0;
  /// Whether a joint of the model has any.
  [[nodiscard]] bool any(const Model& model) const {
    return (springs && model.hasSprings()) || friction || limitStiffness > 0 || limitDamping > 0;
  }
};

/// The forces (nv) that joints add to u. Throws Error for wrong sizes, and for settings that are negative
/// or not finite.
[[nodiscard]] Eigen::VectorXd jointForces(const Model& model, const VectorArg& q, const VectorArg& v,
                                          const JointForces& forces);
/// Overload for hot loops. The caller owns u, which must be nv already.
void jointForces(const Model& model, const VectorArg& q, const VectorArg& v, const JointForces& forces,
                 Eigen::Ref<Eigen::VectorXd> u);

/// Throws Error naming the setting that is negative or not finite, or a frictionSpeed of 0.
void requireValid(const JointForces& forces);

class Rng;

/// How a state is advanced by a step of size h with u held constant. Listed are the evaluations of forward
/// dynamics per step and the order of the error.
enum class Integrator {
  kEuler,              ///< 1, first order: q with the old v. From the script, for learning
  kSemiImplicitEuler,  ///< 1, first order: q with the new v
  kRungeKutta4,        ///< 4, fourth order: the default
  kBeeman,             ///< 1, fourth order: extrapolates from two old accelerations, see Stepper::reset()
  /// Several, second order, reversible: a step of -h undoes a step of h. This is drift-kick-drift from
  /// textbooks (kick-drift-kick shifted by half a step). Because forces depend on v, the kick is an
  /// implicit midpoint rule, iterated until only rounding changes v.
  kLeapfrog
};

struct StepperOptions {
  Integrator integrator = Integrator::kRungeKutta4;
  Eigen::Vector3d gravity_W = earthGravity();
  JointForces jointForces{};
  /// After each step, sqrt(h) * noise * N(0, 1) is added to each entry of v, if the step is given an Rng.
  double noise = 0;
};

/// Advances states of one model in time. It keeps a copy of the model (copies of a mesh share their data),
/// and step() allocates nothing after the first call. A copy continues exactly as the original would.
class Stepper {
 public:
  /// Throws Error for options that are not finite, or negative where that is not allowed.
  explicit Stepper(const Model& model, const StepperOptions& options = {});
  Stepper(const Stepper& other);
  Stepper& operator=(const Stepper& other);
  Stepper(Stepper&&) noexcept;
  Stepper& operator=(Stepper&&) noexcept;
  ~Stepper();

  /// Advances the state by h > 0 seconds (kLeapfrog: any h but 0) under joint forces u (nv). Throws Error,
  /// and leaves the state as it was, for wrong sizes, for numbers that are not finite, as forwardDynamics
  /// does, and if the motion grows without bounds (a joint faster than light), naming the time and the joint.
  void step(State& state, const VectorArg& u, double h);
  /// The same, and adds the noise of the options. Without noise, or if it throws, the Rng is unchanged.
  void step(State& state, const VectorArg& u, double h, Rng& rng);

  /// Sets external wrenches for all later steps: constant in W, on points that move with their bodies.
  /// Initially there are none. Throws as requireValid(model, wrenches).
  void setWrenches(std::vector<Wrench> wrenches);

  /// Forgets old accelerations. Only kBeeman keeps some, and forgets them by itself if q, v, u, h or the
  /// wrenches are not those of its last step. It then restarts with two Runge-Kutta steps, so with noise,
  /// or a u that changes in each step, it is no better than kRungeKutta4. Call this only if a run from the
  /// state of the last step must be bitwise equal to one with a new Stepper.
  void reset();

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace rex
