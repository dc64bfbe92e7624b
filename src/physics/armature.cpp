#include <utility>

#include <BulletDynamics/Featherstone/btMultiBodyConstraint.h>

#include "physics/armature_internal.h"
#include "physics/coupling_internal.h"

namespace rex::internal {
namespace {

// The share of its mobility below which a row can move nothing.
constexpr double kLeastLeft = 1e-9;
// Less than this share of what a row meets counts as that: nothing.
constexpr double kLeastOfMet = 1e-12;

using Velocities = Eigen::Map<Eigen::VectorXd>;

Eigen::Map<const Eigen::VectorXd> velocitiesOf(const btMultiBody& body) {
  return {body.getVelocityVector(), velocityCount(body)};
}

}  // namespace

Armature::Armature(btMultiBody& body, int rows)
    : body_(body),
      Jt_(Eigen::MatrixXd::Zero(velocityCount(body), rows)),
      G_(Jt_),
      inertia_(Eigen::VectorXd::Zero(rows)),
      resistance_(inertia_),
      met_(inertia_),
      drift_(inertia_),
      llt_(rows) {
  body.setUserPointer(this);
}

void Armature::measureBase(int row, const Eigen::Vector3d& angular, const Eigen::Vector3d& linear,
                           double drift) {
  Jt_.col(row).head<3>() = angular;
  Jt_.col(row).segment<3>(3) = linear;
  drift_[row] = drift;
}

void Armature::begin() {
  before_ = velocitiesOf(body_);
  isBegun_ = true;
}

void Armature::slowDown() {
  if (!std::exchange(isBegun_, false)) return;
  for (Eigen::Index i = 0; i < Jt_.cols(); ++i)
    body_.calcAccelerationDeltasMultiDof(Jt_.col(i).data(), G_.col(i).data(), scratchR_, scratchV_);
  Eigen::MatrixXd K = Jt_.transpose() * G_;
  met_ = K.diagonal().cwiseInverse();
  const Eigen::VectorXd all = (inertia_ + resistance_).cwiseMax(kLeastOfMet * met_);
  K.diagonal() += all.cwiseInverse();
  llt_.compute(K);
  // What has inertia keeps its velocity, and what resists wants none.
  const Eigen::VectorXd kept = inertia_.cwiseQuotient(all).cwiseProduct(Jt_.transpose() * before_ - drift_);
  const Eigen::VectorXd faster = Jt_.transpose() * velocitiesOf(body_) - kept;
  const Eigen::VectorXd change = -G_ * llt_.solve(faster);
  body_.applyDeltaVeeMultiDof(change.data(), 1);
}

void Armature::correct(Eigen::Ref<Eigen::VectorXd> answer) const {
  const Eigen::VectorXd taken = llt_.solve(Jt_.transpose() * answer);
  answer.noalias() -= G_ * taken;
}

void answerOf(const btMultiBody& body, const btScalar* impulse, btScalar* answer,
              btAlignedObjectArray<btScalar>& scratchR, btAlignedObjectArray<btVector3>& scratchV) {
  body.calcAccelerationDeltasMultiDof(const_cast<btScalar*>(impulse), answer, scratchR, scratchV);
  if (const Armature* const armature = Armature::of(body))
    armature->correct(Velocities(answer, velocityCount(body)));
}

btScalar ArmatureSolver::solveGroupCacheFriendlySetup(btCollisionObject** bodies, int bodyCount,
                                                      btPersistentManifold** manifolds, int manifoldCount,
                                                      btTypedConstraint** constraints, int constraintCount,
                                                      const btContactSolverInfo& info, btIDebugDraw* debug) {
  bool isWanted = false;
  for (int i = 0; i < m_tmpNumMultiBodyConstraints; ++i) {
    Armature* const armature = Armature::of(*m_tmpMultiBodyConstraints[i]->getMultiBodyA());
    if (armature == nullptr) continue;
    armature->slowDown();
    isWanted = true;
  }
  for (int i = 0; i < m_tmpNumMultiBodyConstraints && couplings_ != nullptr; ++i) {
    CoupledBody* const coupled = couplings_->coupled(*m_tmpMultiBodyConstraints[i]->getMultiBodyA());
    if (coupled == nullptr) continue;
    coupled->begin();
    isWanted = true;
  }
  const btScalar residual = btMultiBodyConstraintSolver::solveGroupCacheFriendlySetup(
      bodies, bodyCount, manifolds, manifoldCount, constraints, constraintCount, info, debug);
  if (!isWanted) return residual;
  for (btMultiBodyConstraintArray* const rows :
       {&m_multiBodyNonContactConstraints, &m_multiBodyNormalContactConstraints,
        &m_multiBodyFrictionContactConstraints, &m_multiBodyTorsionalFrictionContactConstraints,
        &m_multiBodySpinningFrictionContactConstraints})
    for (int i = 0; i < rows->size(); ++i) correct((*rows)[i]);
  return residual;
}

// Bullet scales the target and the softness of a row by the inverse of its mobility, to which the softness is
// already added.
void ArmatureSolver::correct(btMultiBodySolverConstraint& row) {
  double less = 0;
  if (row.m_multiBodyA != nullptr)
    less += correctSide(*row.m_multiBodyA, row.m_jacAindex, row.m_deltaVelAindex, row.m_appliedImpulse);
  if (row.m_multiBodyB != nullptr)
    less += correctSide(*row.m_multiBodyB, row.m_jacBindex, row.m_deltaVelBindex, row.m_appliedImpulse);
  if (less == 0 || row.m_jacDiagABInv == 0) return;
  // Nothing is left that it could move: a joint of a mechanism that is locked.
  const double left = 1 - less * row.m_jacDiagABInv;
  if (left < kLeastLeft) {
    row.m_jacDiagABInv = row.m_rhs = row.m_cfm = 0;
    row.m_appliedImpulse = 0;
    return;
  }
  const double scale = 1 / left;
  row.m_jacDiagABInv *= scale;
  row.m_rhs *= scale;
  row.m_cfm *= scale;
}

// Corrects the answer to a row, and what its impulse of the last step, from which the solver starts, has
// changed already. Returns by how much the mobility is less.
double ArmatureSolver::correctSide(const btMultiBody& body, int jacobian, int velocities, double impulse) {
  const Armature* const armature = Armature::of(body);
  const CoupledBody* const coupled = couplings_ != nullptr ? couplings_->coupled(body) : nullptr;
  if (armature == nullptr && coupled == nullptr) return 0;
  const int count = velocityCount(body);
  Velocities answer(&m_data.m_deltaVelocitiesUnitImpulse[jacobian], count);
  change_ = -answer;
  if (armature != nullptr) armature->correct(answer);
  if (coupled != nullptr) coupled->correct(answer);
  change_ += answer;
  if (impulse != 0) {
    const_cast<btMultiBody&>(body).applyDeltaVeeMultiDof2(change_.data(), impulse);
    applyDeltaVee(change_.data(), impulse, velocities, count);
  }
  return -change_.dot(Velocities(&m_data.m_jacobians[jacobian], count));
}

}  // namespace rex::internal
