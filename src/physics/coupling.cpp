#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include <BulletDynamics/Featherstone/btMultiBodyLinkCollider.h>
#include <Eigen/Cholesky>

#include "physics/armature_internal.h"
#include "physics/coupling_internal.h"

namespace rex::internal {

int LockedRows::getIslandIdA() const { return m_bodyA->getBaseCollider()->getIslandTag(); }
int LockedRows::getIslandIdB() const { return m_bodyB->getBaseCollider()->getIslandTag(); }

void LockedRows::createConstraintRows(btMultiBodyConstraintArray& rows, btMultiBodyJacobianData& data,
                                      const btContactSolverInfo& info) {
  if (!isInSolver_) return;
  measure();
  for (int i = 0; i < getNumRows(); ++i) addRow(i, rows, data, info);
}

void LockedRows::addRow(int i, btMultiBodyConstraintArray& rows, btMultiBodyJacobianData& data,
                        const btContactSolverInfo& info) {
  const btVector3 none(0, 0, 0);
  btMultiBodySolverConstraint& row = rows.expandNonInitializing();
  row.m_orgConstraint = this;
  row.m_orgDofIndex = i;
  fillMultiBodyConstraint(row, data, jacobianA(i), jacobianB(i), none, none, none, none, 0, info,
                          -BT_LARGE_FLOAT, BT_LARGE_FLOAT, false, 1, false, wantedOfSolver(i));
  row.m_cfm = 0;
  row.m_contactNormal1 = row.m_contactNormal2 = none;
  row.m_relpos1CrossNormal = row.m_relpos2CrossNormal = none;
}

namespace {

constexpr int kAxes = 3;
// Gaps, which each step of finite length opens, close at this rate, 1/s: a fifth of them in a millisecond.
// Those at the start are as slow as what parts from an overlap, m/s: what the pin moves keeps its speed
// afterwards.
constexpr double kClosingRate = 200, kClosingSpeed = 1;

}  // namespace

PinRows::PinRows(const PinEnd& A, const PinEnd& B)
    : LockedRows(A.body, B.body ? B.body : A.body, A.link, B.body ? B.link : A.link, kAxes, false,
                 MULTIBODY_CONSTRAINT_POINT_TO_POINT),
      A_(A),
      B_(B) {
  PinRows::finalizeMultiDof();
}

double PinRows::wanted(int row) const {
  return -kClosingRate * gap_[row] / std::max(1.0, kClosingRate / kClosingSpeed * gap_.length());
}

void PinRows::addSpeed(const PinEnd& end, const btVector3& axis, double sign, double* coefficients) {
  if (end.body == nullptr) return;
  one_.resize(velocityCount(*end.body));
  end.body->fillConstraintJacobianMultiDof(end.link, end.inWorld(), btVector3(0, 0, 0), axis, &one_[0],
                                           scratchR_, scratchV_, scratchM_);
  for (int i = 0; i < one_.size(); ++i) coefficients[i] += sign * one_[i];
}

void PinRows::measure() {
  gap_ = A_.inWorld() - B_.inWorld();
  for (int i = 0; i < kAxes; ++i) {
    btVector3 axis(0, 0, 0);
    axis[i] = 1;
    std::fill_n(jacobianA(i), velocityCount(*m_bodyA), 0.0);
    if (!isInOneBody()) std::fill_n(jacobianB(i), velocityCount(*m_bodyB), 0.0);
    addSpeed(A_, axis, 1, jacobianA(i));
    addSpeed(B_, axis, -1, isInOneBody() ? jacobianA(i) : jacobianB(i));
  }
}

namespace {

// Position errors decay at this rate, 1/s. They are only rounding errors, because velocities are exact and
// positions are linear in them. Removing a share per step would amplify them by the inverse square of short
// steps.
constexpr double kErrorRate = 20;
// 1/kg or 1/(kg m^2): the mobility along a row that counts as none. The second is relative to it.
constexpr double kLeastMobility = std::numeric_limits<double>::epsilon(), kLeastShare = 1e-12;

}  // namespace

CouplingRow::CouplingRow(const Follower& follower)
    : LockedRows(follower.at.body, follower.leader.body, follower.at.link, follower.leader.link, 1, false,
                 MULTIBODY_CONSTRAINT_GEAR),
      follower_(follower) {
  CouplingRow::finalizeMultiDof();
}

void CouplingRow::finalizeMultiDof() {
  allocateJacobiansMultiDof();
  jacobianA(0)[follower_.at.velocityIndex()] = 1;
  (isInOneBody() ? jacobianA(0) : jacobianB(0))[follower_.leader.velocityIndex()] = -follower_.ratio;
}

double CouplingRow::wanted(int) const {
  const Follower& one = follower_;
  return -kErrorRate * (one.at.body->getJointPos(one.at.link) -
                        one.ratio * one.leader.body->getJointPos(one.leader.link) - one.offset);
}

namespace {

// Rows are scaled alike; those that can move nothing get 0, and are left out, as Bullet does.
Eigen::VectorXd scaleOf(const Eigen::MatrixXd& A) {
  return A.diagonal().unaryExpr(
      [](double mobility) { return mobility > kLeastMobility ? 1 / std::sqrt(mobility) : 0; });
}

// A positive definite matrix of the scaled rows. Rows of pins may depend on each other: what they agree on
// remains right.
Eigen::MatrixXd scaled(const Eigen::MatrixXd& A, const Eigen::VectorXd& scale, bool hasPins) {
  Eigen::MatrixXd S = scale.asDiagonal() * A * scale.asDiagonal();
  for (Eigen::Index i = 0; i < S.rows(); ++i)
    if (scale[i] == 0) S(i, i) = 1;
  if (hasPins) S.diagonal().array() += kLeastShare;
  return S;
}

}  // namespace

CoupledBody::CoupledBody(btMultiBody& body, std::vector<LockedRows*> held, bool hasPins)
    : body_(body), held_(std::move(held)), hasPins_(hasPins) {
  Eigen::Index count = 0;
  for (LockedRows* const rows : held_) {
    count += rows->getNumRows();
    rows->leaveSolver();
  }
  Gt_.resize(velocityCount(body), count);
  W_ = Gt_;
  wanted_.resize(count);
}

void CoupledBody::begin() {
  if (std::exchange(isBegun_, true)) return;
  Eigen::Index column = 0;
  for (LockedRows* const rows : held_) {
    rows->measure();
    for (int i = 0; i < rows->getNumRows(); ++i, ++column) {
      Gt_.col(column) = Eigen::Map<const Eigen::VectorXd>(rows->coefficients(i, body_), Gt_.rows());
      answerOf(body_, Gt_.col(column).data(), W_.col(column).data(), scratchR_, scratchV_);
      wanted_[column] = rows->wanted(i);
    }
  }
  const Eigen::MatrixXd A = Gt_.transpose() * W_;
  scale_ = scaleOf(A);
  llt_.compute(scaled(A, scale_, hasPins_));
  const Eigen::Map<const Eigen::VectorXd> v(body_.getVelocityVector(), Gt_.rows());
  const Eigen::VectorXd change = W_ * solve(wanted_ - Gt_.transpose() * v);
  body_.applyDeltaVeeMultiDof(change.data(), 1);
}

Eigen::VectorXd CoupledBody::solve(const Eigen::VectorXd& missing) const {
  return scale_.cwiseProduct(llt_.solve(scale_.cwiseProduct(missing)));
}

void CoupledBody::correct(Eigen::Ref<Eigen::VectorXd> answer) const {
  answer -= W_ * solve(Gt_.transpose() * answer);
}

Couplings::Couplings(const std::vector<Follower>& followers, const Pins& pins) {
  for (const Follower& follower : followers)
    join(followers_.emplace_back(std::make_unique<CouplingRow>(follower)).get());
  for (const auto& [A, B] : pins) join(pins_.emplace_back(std::make_unique<PinRows>(A, B)).get());
  for (Group& group : groups_)
    group.hasPins = std::ranges::any_of(
        group.held, [](const LockedRows* held) { return dynamic_cast<const PinRows*>(held) != nullptr; });
  for (Group& group : groups_)
    if (group.bodies.size() == 1)
      group.alone = std::make_unique<CoupledBody>(*group.bodies.front(), group.held, group.hasPins);
}

CoupledBody* Couplings::coupled(const btMultiBody& body) {
  for (const Group& group : groups_)
    if (group.alone && group.bodies.front() == &body) return group.alone.get();
  return nullptr;
}

void Couplings::join(LockedRows* rows) {
  Group joined{{rows}, {rows->getMultiBodyA()}};
  if (!rows->isInOneBody()) joined.bodies.push_back(rows->getMultiBodyB());
  std::erase_if(groups_, [&](const Group& group) {
    if (std::ranges::find_first_of(group.bodies, joined.bodies) == group.bodies.end()) return false;
    joined.held.insert(joined.held.end(), group.held.begin(), group.held.end());
    for (btMultiBody* const body : group.bodies)
      if (std::ranges::find(joined.bodies, body) == joined.bodies.end()) joined.bodies.push_back(body);
    return true;
  });
  groups_.push_back(std::move(joined));
}

void Couplings::addTo(btMultiBodyDynamicsWorld& world) {
  for (const auto& row : followers_) world.addMultiBodyConstraint(row.get());
  for (const auto& pin : pins_) world.addMultiBodyConstraint(pin.get());
}

void Couplings::removeFrom(btMultiBodyDynamicsWorld& world) {
  for (const auto& row : followers_) world.removeMultiBodyConstraint(row.get());
  for (const auto& pin : pins_) world.removeMultiBodyConstraint(pin.get());
}

void Couplings::forget() {
  for (const auto& row : followers_) row->forget();
  for (const auto& pin : pins_) pin->forget();
}

void Couplings::settle(Aim aim) {
  for (Group& group : groups_) settle(group, aim);
}

// v += M^-1 G^T (G M^-1 G^T)^-1 (wanted - G v), where G holds all rows.
void Couplings::settle(Group& group, Aim aim) {
  if (group.alone) group.alone->end();
  struct Row {
    LockedRows* held;
    int row;
  };
  std::vector<Row> rows;
  for (LockedRows* const held : group.held)
    for (int i = 0; i < held->getNumRows(); ++i) rows.push_back({held, i});
  const auto count = static_cast<Eigen::Index>(rows.size());
  const std::size_t bodies = group.bodies.size();
  answers_.resize(rows.size() * bodies);
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(count, count);
  Eigen::VectorXd missing(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const auto [held, row] = rows[static_cast<std::size_t>(i)];
    missing[i] = aim == Aim::kHold ? 0 : held->wanted(row);
    for (std::size_t k = 0; k < bodies; ++k) {
      const btMultiBody& body = *group.bodies[k];
      const int velocities = velocityCount(body);
      std::vector<btScalar>& answer = answers_[static_cast<std::size_t>(i) * bodies + k];
      answer.assign(static_cast<std::size_t>(velocities), 0);
      const double* const own = held->coefficients(row, body);
      if (own == nullptr) continue;
      missing[i] -= std::inner_product(own, own + velocities, body.getVelocityVector(), 0.0);
      answerOf(body, own, answer.data(), scratchR_, scratchV_);
      for (Eigen::Index j = 0; j < count; ++j) {
        const auto& other = rows[static_cast<std::size_t>(j)];
        if (const double* const its = other.held->coefficients(other.row, body))
          A(j, i) += std::inner_product(its, its + velocities, answer.data(), 0.0);
      }
    }
  }
  const Eigen::VectorXd scale = scaleOf(A);
  const Eigen::VectorXd impulses =
      scale.cwiseProduct(scaled(A, scale, group.hasPins).llt().solve(scale.cwiseProduct(missing)));
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
    for (const LockedRows* const held : group.held) {
      const auto* const row = dynamic_cast<const CouplingRow*>(held);
      if (row == nullptr) continue;
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
