#include <BulletDynamics/Featherstone/btMultiBodyLinkCollider.h>

#include "physics/joint_row_internal.h"

namespace rex::internal {

JointRow::JointRow(btMultiBody& body, int link, int place)
    : btMultiBodyConstraint(&body, &body, link, body.getLink(link).m_parent, 1, true,
                            MULTIBODY_CONSTRAINT_1DOF_JOINT_MOTOR),
      place_(place) {}

void JointRow::finalizeMultiDof() {
  allocateJacobiansMultiDof();
  constexpr int kBaseVelocities = 6;
  jacobianA(0)[kBaseVelocities + m_bodyA->getLink(m_linkA).m_dofOffset + place_] = 1;
  m_numDofsFinalized = m_jacSizeBoth;
}

int JointRow::getIslandIdA() const { return m_bodyA->getBaseCollider()->getIslandTag(); }

void JointRow::createConstraintRows(btMultiBodyConstraintArray& rows, btMultiBodyJacobianData& data,
                                    const btContactSolverInfo& info) {
  if (m_numDofsFinalized != m_jacSizeBoth) finalizeMultiDof();
  const btVector3 none(0, 0, 0);
  for (int i = 0; i < count_; ++i) {
    const Goal& goal = goals_[i];
    btMultiBodySolverConstraint& row = rows.expandNonInitializing();
    row.m_orgConstraint = this;
    row.m_orgDofIndex = 0;
    fillMultiBodyConstraint(row, data, jacobianA(0), jacobianB(0), none, none, none, none, 0, info,
                            goal.lowest, goal.highest, false, 1, false, goal.velocity);
    const double stiffened = 1 / (1 + goal.softness * row.m_jacDiagABInv);
    row.m_rhs *= stiffened;
    row.m_jacDiagABInv *= stiffened;
    row.m_cfm = goal.softness * row.m_jacDiagABInv;
    row.m_contactNormal1 = row.m_contactNormal2 = none;
    row.m_relpos1CrossNormal = row.m_relpos2CrossNormal = none;
  }
}

}  // namespace rex::internal
