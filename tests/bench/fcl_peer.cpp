#include <map>
#include <memory>

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
        std::vector<Pose>& poses = poses_.emplace_back();
        for (int k = 0; k < ContactScene::kPostures; ++k) poses.push_back(scene.shapePose(i, k));
      }
      pairs_.emplace_back(places[pair.a], places[pair.b]);
    }
  }

  bool collides(int k) {
    for (std::size_t i = 0; i < objects_.size(); ++i) {
      const Pose& X_WS = poses_[i][static_cast<std::size_t>(k)];
      objects_[i].setTransform(X_WS.R, X_WS.p);
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
  std::vector<std::vector<Pose>> poses_;
  std::vector<std::pair<std::size_t, std::size_t>> pairs_;
  fcl::CollisionRequestd request_;
};

}  // namespace

ContactPeer fclPeer(const ContactScene& scene) {
  const auto pairs = std::make_shared<Pairs>(scene);
  const ContactPeer peer = [pairs](int k) { return pairs->collides(k); };
  requireAgreement("FCL", scene, peer, 1e-3);
  return peer;
}

}  // namespace rex::bench
