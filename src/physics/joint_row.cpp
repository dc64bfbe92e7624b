#include <algorithm>

#include <BulletDynamics/Featherstone/btMultiBodyLinkCollider.h>

#include "physics/joint_row_internal.h"

namespace rex::internal {

JointRow::JointRow(btMultiBody& body, int link, int place)
    : btMultiBodyConstraint(&body, &body, link, body.getLink(link).m_parent, kJointPurposes, true,
                            MULTIBODY_CONSTRAINT_1DOF_JOINT_MOTOR),
      place_(place) {
  JointRow::finalizeMultiDof();
}

JointRow::JointRow(btMultiBody& body)
    : btMultiBodyConstraint(&body, &body, -1, -1, kJointPurposes, true,
                            MULTIBODY_CONSTRAINT_1DOF_JOINT_MOTOR) {
  JointRow::finalizeMultiDof();
}

void JointRow::finalizeMultiDof() {
  allocateJacobiansMultiDof();
  constexpr int kBaseVelocities = 6;
  if (m_linkA >= 0) jacobianA(0)[kBaseVelocities + m_bodyA->getLink(m_linkA).m_dofOffset + place_] = 1;
}

void JointRow::measureBase(const btVector3& angular, const btVector3& linear) {
  for (int i = 0; i < 3; ++i) {
    jacobianA(0)[i] = angular[i];
    jacobianA(0)[3 + i] = linear[i];
  }
}

void JointRow::forget() {
  setGoals({});
  for (int i = 0; i < kJointPurposes; ++i) internalSetAppliedImpulse(i, 0);
}

int JointRow::getIslandIdA() const { return m_bodyA->getBaseCollider()->getIslandTag(); }

void JointRow::createConstraintRows(btMultiBodyConstraintArray& rows, btMultiBodyJacobianData& data,
                                    const btContactSolverInfo& info) {
  const btVector3 none(0, 0, 0);
  for (int i = 0; i < kJointPurposes; ++i) {
    if (!goals_[i]) {
      internalSetAppliedImpulse(i, 0);
      continue;
    }
    const JointGoal& goal = *goals_[i];
    btMultiBodySolverConstraint& row = rows.expandNonInitializing();
    row.m_orgConstraint = this;
    row.m_orgDofIndex = i;
    fillMultiBodyConstraint(row, data, jacobianA(0), jacobianB(0), none, none, none, none, 0, info,
                            goal.lowest, goal.highest, false, 1, false, goal.velocity);
    const double stiffened = 1 / (1 + goal.softness * row.m_jacDiagABInv);
    row.m_rhs *= stiffened;
    row.m_jacDiagABInv *= stiffened;
    row.m_cfm = goal.softness * row.m_jacDiagABInv;
    row.m_contactNormal1 = row.m_contactNormal2 = none;
    row.m_relpos1CrossNormal = row.m_relpos2CrossNormal = none;
    internalSetAppliedImpulse(i, std::clamp(getAppliedImpulse(i), goal.lowest, goal.highest));
  }
}

}  // namespace rex::internal
