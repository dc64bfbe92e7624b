#pragma once

#include <memory>
#include <vector>

#include "dynamics/inverse_dynamics.h"
#include "dynamics/joint_forces.h"
#include "dynamics/wrench.h"
#include "scene/state.h"

namespace rex {

class Rng;

/// How a state is advanced by a step of length h with u held. Evaluations of forward dynamics per step, and
/// the order of the error:
enum class Integrator {
  kEuler,              ///< 1, first order: q with the old v. The script's, to learn from
  kSemiImplicitEuler,  ///< 1, first order: q with the new v
  kRungeKutta4,        ///< 4, fourth order: the default
  kBeeman,             ///< 1, fourth order: extrapolates from two old accelerations, see Stepper::reset()
  /// Several, second order, reversible: a step of -h undoes a step of h. The textbook's drift-kick-drift
  /// (half a step later its kick-drift-kick), but as forces depend on v, v is kicked by the implicit midpoint
  /// rule, iterated until only rounding changes it.
  kLeapfrog
};

struct StepperOptions {
  Integrator integrator = Integrator::kRungeKutta4;
  Eigen::Vector3d gravity_W = earthGravity();
  JointForces jointForces{};
  /// After each step v += sqrt(h) * noise * N(0, 1) in each of its numbers, if the step is given an Rng.
  double noise = 0;
};

/// Moves states of one model on in time. It keeps a copy of the model (copies of a mesh are one mesh), and
/// step() allocates nothing after the first time. A copy of it goes on as the original would.
class Stepper {
 public:
  /// Throws Error for options that are not finite, and those that are negative but must not be.
  explicit Stepper(const Model& model, const StepperOptions& options = {});
  Stepper(const Stepper& other);
  Stepper& operator=(const Stepper& other);
  Stepper(Stepper&&) noexcept;
  Stepper& operator=(Stepper&&) noexcept;
  ~Stepper();

  /// Moves the state on by h > 0 seconds (kLeapfrog: any h but 0) under joint forces u (nv). Throws Error,
  /// and leaves the state as it was, for wrong sizes, for numbers that are not finite, as forwardDynamics
  /// does, and if the motion grows without bounds (a joint faster than light), naming time and joint.
  void step(State& state, const VectorArg& u, double h);
  /// The same, and adds the noise of the options. Without noise, or if it throws, the Rng is left alone.
  void step(State& state, const VectorArg& u, double h, Rng& rng);

  /// Pushes from outside, during all steps to come: constant in W, on points that move with their bodies.
  /// None at first. Throws as requireValid(model, wrenches).
  void setWrenches(std::vector<Wrench> wrenches);

  /// Forgets old accelerations. Only kBeeman keeps some, and forgets them by itself where q, v, u, h or
  /// wrenches are not those of its last step; it starts again with two steps of Runge and Kutta, so under a u
  /// that changes with each step, and with noise, it is no better than kRungeKutta4. To be called only where
  /// a run from the state of the last step shall have the bytes of one with a new Stepper.
  void reset();

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace rex
