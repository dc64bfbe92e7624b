#include "physics/stepping_world_internal.h"

namespace rex::internal {

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
