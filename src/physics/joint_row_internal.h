#pragma once

#include <BulletDynamics/Featherstone/btMultiBodyConstraint.h>

#include "physics/joint_law_internal.h"

namespace rex::internal {

/// Constraints on one velocity of a joint or of a base that is free, all solved along with the contacts:
/// motor, limits, friction, damping.
class JointRow : public btMultiBodyConstraint {
 public:
  /// Of the freedom `place` of a link; both count from 0.
  JointRow(btMultiBody& body, int link, int place);
  /// Of a base; measureBase() says which velocity.
  explicit JointRow(btMultiBody& body);

  /// The velocity is angular * omega + linear * v, of the origin of the base; all in W.
  void measureBase(const btVector3& angular, const btVector3& linear);

  void setGoals(const JointGoals& goals) { goals_ = goals; }
  /// Forgets the goals and the impulses of the last step, from which the solver starts otherwise.
  void forget();

  void finalizeMultiDof() override;
  int getIslandIdA() const override;
  int getIslandIdB() const override { return getIslandIdA(); }
  void createConstraintRows(btMultiBodyConstraintArray& rows, btMultiBodyJacobianData& data,
                            const btContactSolverInfo& info) override;
  void debugDraw(btIDebugDraw*) override {}

 private:
  int place_ = 0;
  JointGoals goals_;
};

}  // namespace rex::internal
