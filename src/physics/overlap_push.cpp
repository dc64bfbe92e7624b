#include <algorithm>
#include <cmath>

#include <BulletDynamics/Featherstone/btMultiBodyLinkCollider.h>

#include "physics/armature_internal.h"
#include "physics/overlap_push_internal.h"

namespace rex::internal {
namespace {

// What is no deeper than this, in metres, is not worth a push.
constexpr double kDepth = 1e-6;
// Passes over the contacts, at most; one that changes no speed by more than this, in m/s, is the last.
constexpr int kPasses = 50;
constexpr double kSettledPush = 1e-6;
// 1/kg: what is harder to move than this is not pushed.
constexpr double kLeastMobilityOfPush = 1e-12;

Eigen::VectorXd velocityOf(const btMultiBody& tree) {
  return Eigen::Map<const Eigen::VectorXd>(tree.getVelocityVector(), velocityCount(tree));
}

Eigen::VectorXd velocityOf(const btRigidBody& body) {
  const btVector3 &w = body.getAngularVelocity(), &v = body.getLinearVelocity();
  return Eigen::Matrix<double, 6, 1>(w.x(), w.y(), w.z(), v.x(), v.y(), v.z());
}

void setVelocity(btMultiBody& tree, const Eigen::VectorXd& v) {
  tree.setBaseOmega({v[0], v[1], v[2]});
  tree.setBaseVel({v[3], v[4], v[5]});
  for (int link = 0; link < tree.getNumLinks(); ++link)
    tree.setJointVelMultiDof(link, v.data() + 6 + tree.getLink(link).m_dofOffset);
}

void setVelocity(btRigidBody& body, const Eigen::VectorXd& v) {
  body.setAngularVelocity({v[0], v[1], v[2]});
  body.setLinearVelocity({v[3], v[4], v[5]});
}

}  // namespace

OverlapPush::Pushed& OverlapPush::pushedOf(btMultiBody* tree, btRigidBody* body) {
  for (const auto& one : pushed_)
    if (one->tree == tree && one->body == body) return *one;
  Pushed& one = *pushed_.emplace_back(std::make_unique<Pushed>(Pushed{.tree = tree, .body = body}));
  one.before = tree != nullptr ? velocityOf(*tree) : velocityOf(*body);
  one.push = Eigen::VectorXd::Zero(one.before.size());
  return one;
}

void OverlapPush::measure(const btCollisionObject& object, const btVector3& point, const btVector3& normal,
                          Side& side) {
  const btMultiBodyLinkCollider* const collider = btMultiBodyLinkCollider::upcast(&object);
  auto* const rigid = const_cast<btRigidBody*>(btRigidBody::upcast(&object));
  if (collider == nullptr && rigid == nullptr) return;
  side.pushed = &pushedOf(collider != nullptr ? collider->m_multiBody : nullptr, rigid);
  side.J.resize(side.pushed->push.size());
  side.answer.resize(side.J.size());
  if (btMultiBody* const tree = side.pushed->tree) {
    tree->fillContactJacobianMultiDof(collider->m_link, point, normal, side.J.data(), scratchR_, scratchV_,
                                      scratchM_);
    answerOf(*tree, side.J.data(), side.answer.data(), scratchR_, scratchV_);
    return;
  }
  const btRigidBody& body = *side.pushed->body;
  const btVector3 turn = (point - body.getCenterOfMassPosition()).cross(normal),
                  answer = body.getInvInertiaTensorWorld() * turn, linear = body.getInvMass() * normal;
  side.J << turn.x(), turn.y(), turn.z(), normal.x(), normal.y(), normal.z();
  side.answer << answer.x(), answer.y(), answer.z(), linear.x(), linear.y(), linear.z();
}

// The contact is to separate at `rate`, or may close its gap, by velocity and push together.
void OverlapPush::addRow(const btPersistentManifold& manifold, const btManifoldPoint& point, double rate,
                         double h) {
  Row row;
  const btVector3& normal = point.m_normalWorldOnB;
  measure(*manifold.getBody0(), point.getPositionWorldOnA(), normal, row.sides[0]);
  measure(*manifold.getBody1(), point.getPositionWorldOnB(), -normal, row.sides[1]);
  // Two links of one tree: their common answer.
  if (row.sides[0].pushed != nullptr && row.sides[0].pushed == row.sides[1].pushed) {
    row.sides[0].J += row.sides[1].J;
    row.sides[0].answer += row.sides[1].answer;
    row.sides[1].pushed = nullptr;
  }
  double speed = 0;
  for (const Side& side : row.sides) {
    if (side.pushed == nullptr) continue;
    speed += side.J.dot(side.pushed->before);
    row.mobility += side.J.dot(side.answer);
  }
  row.wanted = rate - std::max(speed, 0.0) - std::max(point.getDistance(), 0.0) / h;
  if (row.mobility > kLeastMobilityOfPush) rows_.push_back(std::move(row));
}

// Gauss and Seidel's method, projected onto impulses that do not pull.
void OverlapPush::iterate() {
  for (int pass = 0; pass < kPasses; ++pass) {
    double most = 0;
    for (Row& row : rows_) {
      double missing = row.wanted;
      for (const Side& side : row.sides)
        if (side.pushed != nullptr) missing -= side.J.dot(side.pushed->push);
      const double impulse = std::max(row.impulse + missing / row.mobility, 0.0);
      const double change = impulse - row.impulse;
      row.impulse = impulse;
      for (const Side& side : row.sides)
        if (side.pushed != nullptr) side.pushed->push += change * side.answer;
      most = std::max(most, std::abs(change) * row.mobility);
    }
    if (most < kSettledPush) return;
  }
}

void OverlapPush::solve(btDispatcher& dispatcher, std::span<const HiddenDepth> hidden, double h, double share,
                        double speed, Couplings* couplings) {
  if (std::ranges::none_of(hidden, [](const HiddenDepth& one) { return one.depth > kDepth; })) return;
  std::size_t next = 0;
  for (int i = 0; i < dispatcher.getNumManifolds(); ++i) {
    const btPersistentManifold& manifold = *dispatcher.getManifoldByIndexInternal(i);
    for (int k = 0; k < manifold.getNumContacts(); ++k) {
      const btManifoldPoint& point = manifold.getContactPoint(k);
      const bool isHidden = next < hidden.size() && hidden[next].point == &point;
      const double depth = isHidden ? hidden[next++].depth : 0;
      addRow(manifold, point, std::min(share * depth / h, speed), h);
    }
  }
  iterate();
  rows_.clear();
  if (couplings != nullptr) holdCouplings(*couplings);
}

// They settle the velocities of Bullet's bodies, so these become the push for a moment.
void OverlapPush::holdCouplings(Couplings& couplings) {
  couplings.forEachBody([&](btMultiBody& tree) { pushedOf(&tree, nullptr); });
  for (const auto& one : pushed_)
    if (one->tree != nullptr) setVelocity(*one->tree, one->push);
  couplings.settle(Couplings::Aim::kHold);
  for (const auto& one : pushed_) {
    if (one->tree == nullptr) continue;
    one->push = velocityOf(*one->tree);
    setVelocity(*one->tree, one->before);
  }
}

void OverlapPush::add() {
  for (const auto& one : pushed_) {
    const Eigen::VectorXd v = one->before + one->push;
    one->tree != nullptr ? setVelocity(*one->tree, v) : setVelocity(*one->body, v);
  }
}

void OverlapPush::remove() {
  for (const auto& one : pushed_)
    one->tree != nullptr ? setVelocity(*one->tree, one->before) : setVelocity(*one->body, one->before);
  pushed_.clear();
}

void SteppingWorld::setApart(bool isApart) {
  if (isApart && !isApart_) {
    for (int i = 0; i < getDispatcher()->getNumManifolds(); ++i)
      getDispatcher()->getManifoldByIndexInternal(i)->clearManifold();
  }
  isApart_ = isApart;
}

void SteppingWorld::performDiscreteCollisionDetection() {
  if (!isApart_) btMultiBodyDynamicsWorld::performDiscreteCollisionDetection();
}

void SteppingWorld::solveConstraints(btContactSolverInfo& info) {
  hideDepths(info);
  btMultiBodyDynamicsWorld::solveConstraints(info);
  for (const HiddenDepth& one : hidden_) one.point->setDistance(one.point->getDistance() - one.depth);
  if (couplings_ != nullptr) couplings_->settle();
  push_.solve(*getDispatcher(), hidden_, info.m_timeStep, info.m_erp2, partingSpeed_, couplings_);
}

void SteppingWorld::integrateTransforms(btScalar h) {
  push_.add();
  btMultiBodyDynamicsWorld::integrateTransforms(h);
  push_.remove();
}

// A contact keeps the speed at which the solver separates it, so the solver is shown no more depth than makes
// up for the softness of contacts: a load that rests sinks by softness times impulse per second, and the
// solver removes that again. What is deeper is pushed apart.
void SteppingWorld::hideDepths(const btContactSolverInfo& info) {
  hidden_.clear();
  const double perImpulse = info.m_globalCfm / info.m_erp2;
  for (int i = 0; i < getDispatcher()->getNumManifolds(); ++i) {
    btPersistentManifold& manifold = *getDispatcher()->getManifoldByIndexInternal(i);
    for (int k = 0; k < manifold.getNumContacts(); ++k) {
      btManifoldPoint& point = manifold.getContactPoint(k);
      const double shown = perImpulse * point.getAppliedImpulse();
      if (point.getDistance() >= -shown) continue;
      hidden_.push_back({&point, -shown - point.getDistance()});
      point.setDistance(-shown);
    }
  }
}

}  // namespace rex::internal
