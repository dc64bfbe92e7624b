#pragma once

#include <span>

#include "dynamics/stepper.h"
#include "physics/physics_world.h"

namespace rex::internal {

/// Moves a model that nothing touches by the equation of motion alone, which keeps its energy.
class UntouchedMotion {
 public:
  UntouchedMotion(const Model& model, const PhysicsOptions& options);

  void setMotors(std::span<const Motor> motors);
  /// Advances all but the time by h. False, and the state is as it was, if more than gravity and forces acts:
  /// other motors, friction or damping, a limit nearby; or if it moves too fast.
  bool step(State& state, double h);
  /// Forgets the past, so that the same steps follow as from a new one.
  void reset() { stepper_.reset(); }

 private:
  [[nodiscard]] bool isWithinLimits(const Model& model, const State& state, double h) const;

  const Model* model_;
  bool isAble_, hasLimits_, hasForcesOnly_ = true;
  Stepper stepper_, fastStepper_;
  Eigen::VectorXd u_;
  State next_{};
};

}  // namespace rex::internal
