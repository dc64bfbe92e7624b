#pragma once

#include <memory>

#include "dynamics/inverse_dynamics.h"
#include "dynamics/joint_forces.h"
#include "scene/state.h"

namespace rex {

class Rng;

/// How a state is advanced by a step of length h with u held. Evaluations of forward dynamics per step, and
/// the order of the error:
enum class Integrator {
  kEuler,              ///< 1, first order: q with the old v. The script's, to learn from
  kSemiImplicitEuler,  ///< 1, first order: q with the new v
  kRungeKutta4,        ///< 4, fourth order: the default
  kBeeman,             ///< 1, third order: extrapolates from two old accelerations, see Stepper::reset()
  kLeapfrog            ///< several, second order, reversible: a step of -h undoes a step of h
};

struct StepperOptions {
  Integrator integrator = Integrator::kRungeKutta4;
  Eigen::Vector3d gravity_W = earthGravity();
  JointForces jointForces{};
  /// After each step v += sqrt(h) * noise * N(0, 1) in each of its numbers, if the step is given an Rng.
  double noise = 0;
};

/// Moves states of one model on in time. It copies what it needs of the model; step() allocates nothing.
class Stepper {
 public:
  explicit Stepper(const Model& model, const StepperOptions& options = {});
  Stepper(Stepper&&) noexcept;
  Stepper& operator=(Stepper&&) noexcept;
  ~Stepper();

  /// Moves the state on by h > 0 seconds (kLeapfrog: any h but 0) under joint forces u (nv). Throws Error,
  /// and leaves the state as it was, for wrong sizes, for numbers that are not finite, as forwardDynamics
  /// does, and if the motion grows without bounds, naming time and joint.
  void step(State& state, const VectorArg& u, double h);
  /// The same, and adds the noise of the options.
  void step(State& state, const VectorArg& u, double h, Rng& rng);

  /// Forgets old accelerations. kBeeman needs that after a jump: of the state, or of u.
  void reset();

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace rex
