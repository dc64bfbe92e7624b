#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "cli/robot/hold.h"
#include "cli/robot/posture_option.h"
#include "cli/robot/torque_file.h"
#include "dynamics/energy.h"
#include "dynamics/stepper.h"
#include "physics/physics_world.h"

namespace rex::cli {

/// What `rex simulate` lets happen.
struct SimulationPlan {
  State start{};
  StepperOptions stepper{};
  std::optional<PhysicsOptions> physics{};  ///< if set, what steps instead, without noise
  double tau = 1e-3;                        ///< seconds per step
  int steps = 0;
  Hold hold = Hold::kNone;               ///< of the posture of the start; kMotor wants `physics`
  std::optional<TorqueTable> torques{};  ///< added to the forces that hold; without effect under kMotor
  std::uint64_t seed = 0;                ///< of the noise
};

/// A state and its energy.
struct Moment {
  State state;
  Energy energy;
};

/// Calls visit(moment) with the start, and after each step. Throws Error as Stepper or PhysicsWorld, what
/// `visit` throws, and Interrupted.
void simulate(const Model& model, const SimulationPlan& plan,
              const std::function<void(const Moment&)>& visit);

/// Chooses the postures of a film out of a motion while it goes on: `rate` per second, each the one that is
/// nearest in time.
class FilmPostures {
 public:
  /// Of `steps` steps of tau seconds.
  FilmPostures(double tau, int steps, double rate);
  /// The postures before and after each step, in turn.
  void add(const Eigen::VectorXd& q);
  /// What was chosen so far.
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
