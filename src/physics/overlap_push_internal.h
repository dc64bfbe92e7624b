#pragma once

#include <memory>
#include <span>
#include <vector>

#include <BulletDynamics/Featherstone/btMultiBodyDynamicsWorld.h>
#include <Eigen/Core>

#include "physics/coupling_internal.h"

namespace rex::internal {

/// A contact that is deeper than the solver of velocities is shown, by so many metres.
struct HiddenDepth {
  btManifoldPoint* point = nullptr;
  double depth = 0;
};

/// Separates what overlaps by changing positions and not velocities: by a push, which is a velocity that
/// lasts for one update of positions. Among those that separate all contacts as fast as wanted and close no
/// other one, it has the smallest kinetic energy. Bullet does so for rigid bodies ("split impulse"), but
/// multibodies keep the velocity that separates them.
class OverlapPush {
 public:
  /// Finds the push of a step of h seconds, after its velocities are known. It removes `share` of the depths,
  /// at `speed` (m/s) at most, and keeps couplings and pins, if any.
  void solve(btDispatcher& dispatcher, std::span<const HiddenDepth> hidden, double h, double share,
             double speed, Couplings* couplings);
  /// Adds it to the velocities of what is pushed.
  void add();
  /// Restores the velocities before add(), and forgets the push.
  void remove();

 private:
  // A tree, or else a rigid body. Velocities in Bullet's order: angular, linear, joints.
  struct Pushed {
    btMultiBody* tree = nullptr;
    btRigidBody* body = nullptr;
    Eigen::VectorXd push{}, before{};
  };
  // A pushed body in a contact: its velocity along the normal is J v, a unit impulse changes v by `answer`.
  struct Side {
    Pushed* pushed = nullptr;
    Eigen::VectorXd J{}, answer{};
  };
  struct Row {
    Side sides[2]{};
    double wanted = 0, mobility = 0, impulse = 0;
  };

  Pushed& pushedOf(btMultiBody* tree, btRigidBody* body);
  void holdCouplings(Couplings& couplings);
  void measure(const btCollisionObject& object, const btVector3& point, const btVector3& normal, Side& side);
  void addRow(const btPersistentManifold& manifold, const btManifoldPoint& point, double rate, double h);
  void iterate();

  std::vector<std::unique_ptr<Pushed>> pushed_;
  std::vector<Row> rows_;
  btAlignedObjectArray<btScalar> scratchR_;
  btAlignedObjectArray<btVector3> scratchV_;
  btAlignedObjectArray<btMatrix3x3> scratchM_;
};

/// Bullet's world with a hand in its steps, where it has solved for velocities and has not moved yet.
class SteppingWorld : public btMultiBodyDynamicsWorld {
 public:
  using btMultiBodyDynamicsWorld::btMultiBodyDynamicsWorld;

  /// What settles velocities; it must outlive the steps.
  void use(Couplings* couplings) { couplings_ = couplings; }
  /// How fast what is in overlap is pushed apart at most, m/s.
  void setPartingSpeed(double speed) { partingSpeed_ = speed; }

  /// Whether nothing can touch in the next steps, so that no contacts need to be looked for. Those found
  /// before are then forgotten.
  void setApart(bool isApart);
  void performDiscreteCollisionDetection() override;
  void solveConstraints(btContactSolverInfo& info) override;
  void integrateTransforms(btScalar h) override;

 private:
  void hideDepths(const btContactSolverInfo& info);

  Couplings* couplings_ = nullptr;
  double partingSpeed_ = BT_LARGE_FLOAT;
  std::vector<HiddenDepth> hidden_;
  OverlapPush push_;
  bool isApart_ = false;
};

}  // namespace rex::internal
