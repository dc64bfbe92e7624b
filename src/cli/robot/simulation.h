#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "cli/robot/posture_option.h"
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
  bool isHeld = false;     ///< computed torque holds the posture of the start; otherwise joints are free
  std::uint64_t seed = 0;  ///< of the noise
};

/// A state and its energy.
struct Moment {
  State state;
  Energy energy;
};

/// The motion: the start, and the state after each step. Throws Error as Stepper or PhysicsWorld, and
/// Interrupted.
[[nodiscard]] std::vector<Moment> simulate(const Model& model, const SimulationPlan& plan);

/// Its postures at `rate` per second, each the one that was nearest in time.
[[nodiscard]] Motion motionOf(const std::vector<Moment>& moments, double tau, double rate);

}  // namespace rex::cli
