#pragma once

#include <memory>
#include <utility>
#include <vector>

#include <BulletCollision/CollisionShapes/btEmptyShape.h>
#include <BulletDynamics/Featherstone/btMultiBodyConstraintSolver.h>
#include <BulletDynamics/Featherstone/btMultiBodyDynamicsWorld.h>
#include <btBulletCollisionCommon.h>

#include "collision/contacts.h"
#include "physics/armature_internal.h"
#include "physics/coupling_internal.h"
#include "physics/overlap_push_internal.h"
#include "physics/simulated_tree_internal.h"

namespace rex::internal {

/// Lets the shapes collide that ContactModel lets collide, unless the bodies of both stand still. Objects
/// know their body by their user index.
class BodyPairs : public btOverlapFilterCallback {
 public:
  BodyPairs(const Model& model, const std::vector<bool>& isStill);
  bool needBroadphaseCollision(btBroadphaseProxy* a, btBroadphaseProxy* b) const override;
  /// Makes shape `place` of the model part of this, which must outlive it, if shapes of bodies that collide
  /// do not all do so.
  void watch(btCollisionShape& shape, int place) const;

 private:
  static bool mayTouch(const btCollisionShape* a, const btCollisionShape* b);

  std::size_t bodies_;
  std::vector<bool> collide_;
  std::vector<ShapePair> pairs_;  // sorted; empty if all shapes of bodies that collide do so
};

class Articulation;

/// A model in Bullet's hands: what moves, what stands still, and what holds between them.
class BulletWorld {
 public:
  /// Throws Error as PhysicsWorld.
  BulletWorld(const Model& model, const PhysicsOptions& options);
  ~BulletWorld();
  BulletWorld(const BulletWorld&) = delete;
  BulletWorld& operator=(const BulletWorld&) = delete;

  [[nodiscard]] const std::vector<std::unique_ptr<SimulatedTree>>& trees() const { return trees_; }
  /// Sets the state and forgets all contacts, so that the same steps follow as from a new world.
  void reset(const State& state);
  /// Advances by h; if the caller knows that nothing can touch, much faster.
  void step(double h, bool isApart);
  /// Lets rays meet everything where it is now, after steps in which nothing could touch.
  void updateBounds() { world_.updateAabbs(); }
  [[nodiscard]] std::vector<PhysicsContact> contacts() const;
  /// Of each pair of shapes that is deeper than `depth` in overlap in this state, the deepest point; by
  /// pairs. Forgets all contacts, as reset().
  [[nodiscard]] std::vector<PhysicsContact> overlaps(const State& state, double depth);
  /// The shapes of contacts(), the smaller place first, in any order; some come twice.
  void collectTouching(std::vector<std::pair<int, int>>& pairs) const;
  [[nodiscard]] std::optional<RayHit> rayCast(const Eigen::Vector3d& from_W,
                                              const Eigen::Vector3d& to_W) const;

 private:
  void setUpSolver(const Model& model, const PhysicsOptions& options);
  btCollisionShape* addShape(const Model& model, BodyId body, const Pose& X_BL);
  void addStill(const Model& model, BodyId body, const Pose& X_WB, const PhysicsOptions& options);
  // Gives back what may have couplings, else null.
  Articulation* addTree(const Model& model, std::span<const BodyId> bodies, const Pose& X_WP,
                        const PhysicsOptions& options);
  void setUp(btCollisionObject& object, BodyId body, const PhysicsOptions& options);
  void addCouplings(const Model& model, const std::vector<Articulation*>& trees, const Couplings::Pins& pins);
  static Couplings::Pins pinsOf(const Model& model, const std::vector<Articulation*>& trees,
                                const std::vector<Pose>& still);
  void addAll();
  void removeAll();
  template <class Visit>
  void forEachContact(const Visit& visit) const;
  [[nodiscard]] int shapeOf(const btCollisionObject& object, int child) const;

  std::unique_ptr<BodyPairs> pairs_;
  btEmptyShape nothing_;
  std::vector<std::vector<int>> shapesOf_;  // of each body: places in Model::shapes()
  std::vector<std::unique_ptr<btCollisionShape>> shapes_;
  std::vector<std::unique_ptr<btCollisionObject>> still_;
  std::vector<std::unique_ptr<SimulatedTree>> trees_;
  btDefaultCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_{&configuration_};
  btDbvtBroadphase broadphase_;
  ArmatureSolver solver_;
  std::optional<Couplings> couplings_;
  SteppingWorld world_{&dispatcher_, &broadphase_, &solver_, &configuration_};
  double softness_ = 0;  // of contacts, 1/kg
};

}  // namespace rex::internal
