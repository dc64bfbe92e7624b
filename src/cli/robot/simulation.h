#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "cli/robot/posture_option.h"
#include "cli/robot/torque_file.h"
#include "dynamics/energy.h"
#include "dynamics/stepper.h"
#include "live/hold.h"
#include "physics/physics_world.h"

namespace rex::cli {

/// The settings of `rex simulate`.
struct SimulationPlan {
  State start{};
  StepperOptions stepper{};
  std::optional<PhysicsOptions> physics{};  ///< if set, PhysicsWorld is used instead, without noise
  double tau = 1e-3;                        ///< seconds per step
  int steps = 0;
  Hold hold = Hold::kNone;               ///< for the initial posture; kMotor needs `physics`
  std::optional<TorqueTable> torques{};  ///< added to the holding forces; no effect with kMotor
  std::uint64_t seed = 0;                ///< of the noise
};

/// A state and its energy.
struct Moment {
  State state;
  Energy energy;
};

/// Energy that nothing has given: the solver made it.
struct EnergyGain {
  double time = 0;    ///< seconds
  double gained = 0;  ///< joules, since the total energy was lowest
  double given =
      0;  ///< joules: the most that the start, gravity, torques and whatever holds joints can have given
};

/// Calls visit(moment) at the start and after each step. Stops as soon as the energy has grown by more than
/// twice what it can have been given, and returns that gain. Throws Error like Stepper or PhysicsWorld, what
/// `visit` throws, and Interrupted.
std::optional<EnergyGain> simulate(const Model& model, const SimulationPlan& plan,
                                   const std::function<void(const Moment&)>& visit);

/// Selects the postures of a film during a simulation: `rate` per second, each the one nearest in time.
class FilmPostures {
 public:
  /// For `steps` steps of tau seconds.
  FilmPostures(double tau, int steps, double rate);
  /// Call it with the initial posture, and then after each step.
  void add(const Eigen::VectorXd& q);
  /// The postures selected so far.
  [[nodiscard]] const Motion& motion() const { return motion_; }

 private:
  [[nodiscard]] long nearestStep() const;

  double tau_, rate_;
  int steps_;
  std::size_t count_;
  long step_ = 0;
  Motion motion_{};
};

}  // namespace rex::cli
