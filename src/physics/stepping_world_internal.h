#pragma once

#include <vector>

#include <BulletDynamics/Featherstone/btMultiBodyDynamicsWorld.h>

#include "physics/coupling_internal.h"
#include "physics/overlap_push_internal.h"

namespace rex::internal {

/// Bullet's world with a hand in its steps, where it has solved for velocities and has not moved yet.
class SteppingWorld : public btMultiBodyDynamicsWorld {
 public:
  using btMultiBodyDynamicsWorld::btMultiBodyDynamicsWorld;

  /// What settles velocities; it must outlive the steps.
  void use(Couplings* couplings) { couplings_ = couplings; }
  /// How fast what is in overlap is pushed apart at most, m/s.
  void setPartingSpeed(double speed) { partingSpeed_ = speed; }

  /// Whether nothing can touch in the next steps, so that no contacts need to be looked for. Those found
  /// before are then forgotten.
  void setApart(bool isApart);
  void performDiscreteCollisionDetection() override;
  void solveConstraints(btContactSolverInfo& info) override;
  void integrateTransforms(btScalar h) override;

 private:
  void hideDepths(const btContactSolverInfo& info);

  Couplings* couplings_ = nullptr;
  double partingSpeed_ = BT_LARGE_FLOAT;
  std::vector<HiddenDepth> hidden_;
  OverlapPush push_;
  bool isApart_ = false;
};

}  // namespace rex::internal
