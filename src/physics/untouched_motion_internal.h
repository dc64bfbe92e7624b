#pragma once

#include <optional>
#include <span>
#include <vector>

#include "dynamics/mass_matrix.h"
#include "dynamics/stepper.h"
#include "physics/joint_impulses_internal.h"

namespace rex::internal {

/// Moves a model of hinges that nothing touches by the equation of motion alone: by Stepper, which keeps its
/// energy, where only forces act; and with the new v, as Bullet, where motors, friction, damping or limits
/// do.
class UntouchedMotion {
 public:
  UntouchedMotion(const Model& model, const PhysicsOptions& options);

  void setMotors(std::span<const Motor> motors);
  /// Advances all but the time by h. False, and the state is as it was, if it cannot: joints of other kinds,
  /// or a motion too fast.
  bool step(State& state, double h);
  /// Forgets the past, so that the same steps follow as from a new one.
  void reset();

 private:
  [[nodiscard]] bool onlyForcesAct(const State& state, double h) const;
  void stepFreely(State& state, double h, int count);
  bool stepWithGoals(State& state, double h);

  const Model* model_;
  Eigen::Vector3d gravity_W_;
  bool isAble_, hasForcesOnly_ = true, resists_ = false;
  std::vector<JointLaw> laws_{};
  std::vector<Motor> motors_;
  std::optional<Stepper> stepper_{}, fastStepper_{};  // if it is able
  JointImpulses impulses_;
  Eigen::VectorXd u_, p_, v_;
  EquationOfMotion motion_{};
  DynamicsWorkspace workspace_{};
  State next_{};
};

}  // namespace rex::internal
