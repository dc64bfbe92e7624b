#pragma once

#include <BulletDynamics/Featherstone/btMultiBodyConstraint.h>

namespace rex::internal {

/// The coordinates of a body in Bullet, the six of the base included.
inline int velocityCount(const btMultiBody& body) { return 6 + body.getNumDofs(); }

/// Rows that hold two links to each other and are solved along with the contacts; Couplings then makes them
/// exact. If both are in one body, the Jacobian of A holds everything: Bullet adds the terms of A and B on
/// their own, but not the coupling between them.
class HeldRows : public btMultiBodyConstraint {
 public:
  using btMultiBodyConstraint::btMultiBodyConstraint;

  [[nodiscard]] bool isInOneBody() const { return m_bodyA == m_bodyB; }
  /// The coefficients of a row for the velocities of a body; null if it has none.
  [[nodiscard]] const double* coefficients(int row, const btMultiBody& body) {
    if (&body == m_bodyA) return jacobianA(row);
    return &body == m_bodyB ? jacobianB(row) : nullptr;
  }
  /// The velocity along a row that reduces its error, in the posture in which the rows were last created.
  [[nodiscard]] virtual double wanted(int row) const = 0;

  /// Forgets the impulses of the last step.
  void forget() {
    for (int i = 0; i < getNumRows(); ++i) internalSetAppliedImpulse(i, 0);
  }

  int getIslandIdA() const override;
  int getIslandIdB() const override;
  void debugDraw(btIDebugDraw*) override {}

 protected:
  /// Adds a row with the Jacobians as they are.
  btMultiBodySolverConstraint& addRow(int i, double velocity, btMultiBodyConstraintArray& rows,
                                      btMultiBodyJacobianData& data, const btContactSolverInfo& info);
};

}  // namespace rex::internal
