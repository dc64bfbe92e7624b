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
  for (const Deep& one : hidden_) one.point->setDistance(one.distance);
  if (couplings_ != nullptr) couplings_->settle();
}

// The solver removes a share of the depth within the step, so it is shown no more depth than it may push
// out. Bullet has no other bound on that speed.
void SteppingWorld::hideDepths(const btContactSolverInfo& info) {
  hidden_.clear();
  const double deepest = partingSpeed_ * info.m_timeStep / info.m_erp2;
  for (int i = 0; i < getDispatcher()->getNumManifolds(); ++i) {
    btPersistentManifold& manifold = *getDispatcher()->getManifoldByIndexInternal(i);
    for (int k = 0; k < manifold.getNumContacts(); ++k) {
      btManifoldPoint& point = manifold.getContactPoint(k);
      if (point.getDistance() >= -deepest) continue;
      hidden_.push_back({&point, point.getDistance()});
      point.setDistance(-deepest);
    }
  }
}

}  // namespace rex::internal
