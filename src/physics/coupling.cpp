#include <algorithm>
#include <array>

#include <BulletDynamics/Featherstone/btMultiBodyLinkCollider.h>
#include <Eigen/Cholesky>

#include "physics/coupling_internal.h"

namespace rex::internal {
namespace {

// Position errors decay at this rate, 1/s. They are only rounding errors, because velocities are exact and
// positions are linear in them. Removing a share per step would amplify them by the inverse square of short
// steps.
constexpr double kErrorRate = 20;

// The coefficient of a row for one velocity of a body.
struct Coefficient {
  const btMultiBody* body;
  int index;
  double value;
};

std::array<Coefficient, 2> coefficientsOf(const Follower& one) {
  return {Coefficient{one.at.body, one.at.velocityIndex(), 1},
          Coefficient{one.leader.body, one.leader.velocityIndex(), -one.ratio}};
}

int velocityCount(const btMultiBody& body) { return 6 + body.getNumDofs(); }

}  // namespace

CouplingRow::CouplingRow(const Follower& follower)
    : btMultiBodyConstraint(follower.at.body, follower.leader.body, follower.at.link, follower.leader.link, 1,
                            false, MULTIBODY_CONSTRAINT_GEAR),
      follower_(follower) {
  CouplingRow::finalizeMultiDof();
}

// If both are in one body, the Jacobian of A holds everything: Bullet adds the terms of A and B on their
// own, but not the coupling between them.
void CouplingRow::finalizeMultiDof() {
  allocateJacobiansMultiDof();
  jacobianA(0)[follower_.at.velocityIndex()] = 1;
  (isInOneBody() ? jacobianA(0) : jacobianB(0))[follower_.leader.velocityIndex()] = -follower_.ratio;
}

int CouplingRow::getIslandIdA() const { return m_bodyA->getBaseCollider()->getIslandTag(); }
int CouplingRow::getIslandIdB() const { return m_bodyB->getBaseCollider()->getIslandTag(); }

void CouplingRow::createConstraintRows(btMultiBodyConstraintArray& rows, btMultiBodyJacobianData& data,
                                       const btContactSolverInfo& info) {
  const btVector3 none(0, 0, 0);
  btMultiBodySolverConstraint& row = rows.expandNonInitializing();
  row.m_orgConstraint = this;
  row.m_orgDofIndex = 0;
  fillMultiBodyConstraint(row, data, jacobianA(0), jacobianB(0), none, none, none, none, 0, info,
                          -BT_LARGE_FLOAT, BT_LARGE_FLOAT);
  row.m_cfm = 0;
  row.m_contactNormal1 = row.m_contactNormal2 = none;
  row.m_relpos1CrossNormal = row.m_relpos2CrossNormal = none;
}

Couplings::Couplings(const std::vector<Follower>& followers) {
  for (const Follower& follower : followers) {
    CouplingRow* const row = rows_.emplace_back(std::make_unique<CouplingRow>(follower)).get();
    Group joined{{row}, {follower.at.body}};
    if (!row->isInOneBody()) joined.bodies.push_back(follower.leader.body);
    std::erase_if(groups_, [&](const Group& group) {
      if (std::ranges::find_first_of(group.bodies, joined.bodies) == group.bodies.end()) return false;
      joined.rows.insert(joined.rows.end(), group.rows.begin(), group.rows.end());
      for (btMultiBody* const body : group.bodies)
        if (std::ranges::find(joined.bodies, body) == joined.bodies.end()) joined.bodies.push_back(body);
      return true;
    });
    groups_.push_back(std::move(joined));
  }
}

void Couplings::addTo(btMultiBodyDynamicsWorld& world) {
  for (const auto& row : rows_) world.addMultiBodyConstraint(row.get());
}

void Couplings::removeFrom(btMultiBodyDynamicsWorld& world) {
  for (const auto& row : rows_) world.removeMultiBodyConstraint(row.get());
}

void Couplings::forget() {
  for (const auto& row : rows_) row->forget();
}

void Couplings::settle() {
  for (Group& group : groups_) settle(group);
}

// v += M^-1 G^T (G M^-1 G^T)^-1 (wanted - G v), where G has a row per coupling.
void Couplings::settle(Group& group) {
  const auto count = static_cast<Eigen::Index>(group.rows.size());
  const std::size_t bodies = group.bodies.size();
  answers_.resize(group.rows.size() * bodies);
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(count, count);
  Eigen::VectorXd missing(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const Follower& one = group.rows[static_cast<std::size_t>(i)]->follower();
    const double error = one.at.body->getJointPos(one.at.link) -
                         one.ratio * one.leader.body->getJointPos(one.leader.link) - one.offset;
    missing[i] = -kErrorRate * error;
    for (const Coefficient& part : coefficientsOf(one))
      missing[i] -= part.value * part.body->getVelocityVector()[part.index];
    for (std::size_t k = 0; k < bodies; ++k) {
      const btMultiBody& body = *group.bodies[k];
      std::vector<btScalar>& answer = answers_[static_cast<std::size_t>(i) * bodies + k];
      answer.assign(static_cast<std::size_t>(velocityCount(body)), 0);
      force_.assign(answer.size(), 0);
      for (const Coefficient& part : coefficientsOf(one))
        if (part.body == &body) force_[static_cast<std::size_t>(part.index)] += part.value;
      body.calcAccelerationDeltasMultiDof(force_.data(), answer.data(), scratchR_, scratchV_);
      for (Eigen::Index j = 0; j < count; ++j)
        for (const Coefficient& part : coefficientsOf(group.rows[static_cast<std::size_t>(j)]->follower()))
          if (part.body == &body) A(j, i) += part.value * answer[static_cast<std::size_t>(part.index)];
    }
  }
  const Eigen::VectorXd impulses = A.llt().solve(missing);
  for (Eigen::Index i = 0; i < count; ++i)
    for (std::size_t k = 0; k < bodies; ++k)
      group.bodies[k]->applyDeltaVeeMultiDof(answers_[static_cast<std::size_t>(i) * bodies + k].data(),
                                             impulses[i]);
}

bool Couplings::isStuck(const CoordinatePlace& place) {
  const auto at = static_cast<std::size_t>(place.velocityIndex());
  std::vector<btScalar> answer(static_cast<std::size_t>(velocityCount(*place.body)));
  force_.assign(answer.size(), 0);
  force_[at] = 1;
  place.body->calcAccelerationDeltasMultiDof(force_.data(), answer.data(), scratchR_, scratchV_);
  return !(answer[at] > 0);
}

JointId Couplings::massless(const Model& model) {
  btAlignedObjectArray<btMatrix3x3> scratchM;
  for (const Group& group : groups_) {
    for (btMultiBody* const body : group.bodies)
      body->computeAccelerationsArticulatedBodyAlgorithmMultiDof(1, scratchR_, scratchV_, scratchM, false,
                                                                 false, false);
    for (const CouplingRow* const row : group.rows) {
      const Follower& one = row->follower();
      if (isStuck(one.at)) return one.joint;
      if (!isStuck(one.leader)) continue;
      const auto owner = std::ranges::find_if(model.joints(), [&](const Joint& joint) {
        return !joint.mimics && joint.nv > 0 && joint.qIndex == model[one.joint].qIndex;
      });
      return JointId{static_cast<int>(owner - model.joints().begin())};
    }
  }
  return kNoJoint;
}

}  // namespace rex::internal
