#include <BulletDynamics/Featherstone/btMultiBodyLinkCollider.h>

#include "physics/held_rows_internal.h"

namespace rex::internal {

int HeldRows::getIslandIdA() const { return m_bodyA->getBaseCollider()->getIslandTag(); }
int HeldRows::getIslandIdB() const { return m_bodyB->getBaseCollider()->getIslandTag(); }

btMultiBodySolverConstraint& HeldRows::addRow(int i, double velocity, btMultiBodyConstraintArray& rows,
                                              btMultiBodyJacobianData& data,
                                              const btContactSolverInfo& info) {
  const btVector3 none(0, 0, 0);
  btMultiBodySolverConstraint& row = rows.expandNonInitializing();
  row.m_orgConstraint = this;
  row.m_orgDofIndex = i;
  fillMultiBodyConstraint(row, data, jacobianA(i), jacobianB(i), none, none, none, none, 0, info,
                          -BT_LARGE_FLOAT, BT_LARGE_FLOAT, false, 1, false, velocity);
  row.m_cfm = 0;
  row.m_contactNormal1 = row.m_contactNormal2 = none;
  row.m_relpos1CrossNormal = row.m_relpos2CrossNormal = none;
  return row;
}

}  // namespace rex::internal
