#include <map>
#include <memory>
#include <span>

#include <fcl/fcl.h>

#include "bench/contact_scene.h"

namespace rex::bench {
namespace {

std::shared_ptr<fcl::CollisionGeometryd> toFcl(const Shape& shape) {
  if (shape.type == ShapeType::kCapsule)
    return std::make_shared<fcl::Capsuled>(shape.radius, shape.extent.z());
  return std::make_shared<fcl::Boxd>(shape.extent);
}

// Objects, and pairs of them; a pair is looked at where its boxes along the axes overlap.
class Pairs {
 public:
  explicit Pairs(const ContactScene& scene) {
    std::map<int, std::size_t> places;
    for (const ShapePair& pair : scene.contacts.pairs()) {
      for (const int i : {pair.a, pair.b}) {
        if (!places.emplace(i, objects_.size()).second) continue;
        objects_.emplace_back(toFcl(scene.shape(i).shape));
        shapes_.push_back(i);
      }
      pairs_.emplace_back(places[pair.a], places[pair.b]);
    }
  }

  const std::vector<int>& shapes() const { return shapes_; }

  // `poses` are X_WS of shapes().
  bool collides(std::span<const Pose> poses) {
    for (std::size_t i = 0; i < objects_.size(); ++i) {
      objects_[i].setTransform(poses[i].R, poses[i].p);
      objects_[i].computeAABB();
    }
    for (const auto& [a, b] : pairs_) {
      if (!objects_[a].getAABB().overlap(objects_[b].getAABB())) continue;
      fcl::CollisionResultd result;
      if (fcl::collide(&objects_[a], &objects_[b], request_, result) > 0) return true;
    }
    return false;
  }

 private:
  std::vector<fcl::CollisionObjectd> objects_;
  std::vector<int> shapes_;
  std::vector<std::pair<std::size_t, std::size_t>> pairs_;
  fcl::CollisionRequestd request_;
};

}  // namespace

ContactPeer fclPeer(const ContactScene& scene) {
  const auto pairs = std::make_shared<Pairs>(scene);
  std::vector<std::vector<Pose>> poses(ContactScene::kPostures);
  for (int k = 0; k < ContactScene::kPostures; ++k)
    for (const int i : pairs->shapes()) poses[static_cast<std::size_t>(k)].push_back(scene.shapePose(i, k));
  const ContactPeer peer = [pairs, poses](int k) {
    return pairs->collides(poses[static_cast<std::size_t>(k)]);
  };
  requireAgreement("FCL", scene, peer, 1e-3);
  return peer;
}

std::function<bool(const BodyPoses&)> fclContact(const ContactScene& scene) {
  const auto pairs = std::make_shared<Pairs>(scene);
  std::vector<ModelShape> shapes;
  for (const int i : pairs->shapes()) shapes.push_back(scene.shape(i));
  return [pairs, shapes, X_WS = std::vector<Pose>(shapes.size())](const BodyPoses& poses) mutable {
    for (std::size_t i = 0; i < shapes.size(); ++i) X_WS[i] = poses[shapes[i].body] * shapes[i].X_BS;
    return pairs->collides(X_WS);
  };
}

}  // namespace rex::bench
