#include <memory>
#include <set>

#include <btBulletCollisionCommon.h>

#include "bench/contact_scene.h"

namespace rex::bench {
namespace {

btTransform toBullet(const Pose& X) {
  const auto& R = X.R;
  const btMatrix3x3 rotation(R(0, 0), R(0, 1), R(0, 2), R(1, 0), R(1, 1), R(1, 2), R(2, 0), R(2, 1), R(2, 2));
  return btTransform(rotation, btVector3(X.p.x(), X.p.y(), X.p.z()));
}

std::unique_ptr<btCollisionShape> toBullet(const Shape& shape) {
  if (shape.type == ShapeType::kCapsule)
    return std::make_unique<btCapsuleShapeZ>(shape.radius, shape.extent.z());
  const Eigen::Vector3d half = shape.extent / 2;
  return std::make_unique<btBoxShape>(btVector3(half.x(), half.y(), half.z()));
}

// Lets the pairs of the scene collide; objects know the places of their shapes.
struct PairFilter : btOverlapFilterCallback {
  bool needBroadphaseCollision(btBroadphaseProxy* a, btBroadphaseProxy* b) const override {
    const auto place = [](btBroadphaseProxy* proxy) {
      return static_cast<btCollisionObject*>(proxy->m_clientObject)->getUserIndex();
    };
    return pairs.contains(std::minmax(place(a), place(b)));
  }
  std::set<std::pair<int, int>> pairs;
};

class World {
 public:
  explicit World(const ContactScene& scene) {
    std::set<int> used;
    for (const ShapePair& pair : scene.contacts.pairs()) {
      filter_.pairs.insert({pair.a, pair.b});
      used.insert({pair.a, pair.b});
    }
    world_.getPairCache()->setOverlapFilterCallback(&filter_);
    for (const int i : used) {
      auto& object = objects_.emplace_back(std::make_unique<btCollisionObject>());
      shapes_.push_back(toBullet(scene.shape(i).shape));
      object->setCollisionShape(shapes_.back().get());
      object->setUserIndex(i);
      std::vector<btTransform>& places = places_.emplace_back();
      for (int k = 0; k < ContactScene::kPostures; ++k) places.push_back(toBullet(scene.shapePose(i, k)));
      object->setWorldTransform(places[0]);
      world_.addCollisionObject(object.get());
    }
  }
  ~World() {
    for (const auto& object : objects_) world_.removeCollisionObject(object.get());
  }

  bool collides(int k) {
    for (std::size_t i = 0; i < objects_.size(); ++i)
      objects_[i]->setWorldTransform(places_[i][static_cast<std::size_t>(k)]);
    world_.performDiscreteCollisionDetection();
    double nearest = 1;
    for (int i = 0; i < dispatcher_.getNumManifolds(); ++i) {
      const btPersistentManifold* manifold = dispatcher_.getManifoldByIndexInternal(i);
      for (int c = 0; c < manifold->getNumContacts(); ++c)
        nearest = std::min(nearest, manifold->getContactPoint(c).getDistance());
    }
    return nearest < 0;
  }

 private:
  btDefaultCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_{&configuration_};
  btDbvtBroadphase broadphase_;
  PairFilter filter_;
  btCollisionWorld world_{&dispatcher_, &broadphase_, &configuration_};
  std::vector<std::unique_ptr<btCollisionShape>> shapes_;
  std::vector<std::unique_ptr<btCollisionObject>> objects_;
  std::vector<std::vector<btTransform>> places_;
};

}  // namespace

ContactPeer bulletPeer(const ContactScene& scene) {
  const auto world = std::make_shared<World>(scene);
  const ContactPeer peer = [world](int k) { return world->collides(k); };
  requireAgreement("Bullet", scene, peer, 0.03);
  return peer;
}

}  // namespace rex::bench
