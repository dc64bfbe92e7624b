// Who touches whom in random postures of our own robots, by FCL, which knows nothing of our pairs.
#include <cmath>
#include <map>
#include <memory>
#include <set>

#include <fcl/fcl.h>
#include <gtest/gtest.h>

#include "base/rng.h"
#include "collision/collision_pairs.h"
#include "collision/contacts.h"
#include "formats/ors_reader.h"
#include "formats/urdf_reader.h"
#include "kinematics/forward_kinematics.h"
#include "support/paths.h"

namespace rex::self_collision_test {

using Pair = std::pair<BodyId, BodyId>;

std::unique_ptr<fcl::CollisionObjectd> objectOf(const Shape& shape) {
  std::shared_ptr<fcl::CollisionGeometryd> geometry;
  if (shape.type == ShapeType::kBox) geometry = std::make_shared<fcl::Boxd>(shape.extent);
  if (shape.type == ShapeType::kSphere) geometry = std::make_shared<fcl::Sphered>(shape.radius);
  if (shape.type == ShapeType::kCylinder)
    geometry = std::make_shared<fcl::Cylinderd>(shape.radius, shape.extent.z());
  if (shape.type == ShapeType::kCapsule)
    geometry = std::make_shared<fcl::Capsuled>(shape.radius, shape.extent.z());
  if (!geometry) return nullptr;
  return std::make_unique<fcl::CollisionObjectd>(geometry);
}

class Robot {
 public:
  // Without an SRDF, so that what counts is the tree.
  explicit Robot(const std::string& name) : model_(compile(spec(name))) {
    for (const ModelShape& shape : model_.shapes())
      objects_.push_back(shape.contact ? objectOf(shape.shape) : nullptr);
  }

  const Model& model() const { return model_; }

  // Pairs of bodies of which two shapes overlap.
  std::set<Pair> touching(const Eigen::VectorXd& q) {
    const BodyPoses poses = forwardKinematics(model_, q);
    std::set<Pair> found;
    for (std::size_t i = 0; i < objects_.size(); ++i) {
      if (!objects_[i]) continue;
      const Pose X_WS = poses[bodyOf(i)] * model_.shapes()[i].X_BS;
      objects_[i]->setTransform(X_WS.R, X_WS.p);
      objects_[i]->computeAABB();
      for (std::size_t k = 0; k < i; ++k)
        if (objects_[k] && bodyOf(k) != bodyOf(i) && overlap(k, i)) found.emplace(bodyOf(k), bodyOf(i));
    }
    return found;
  }

 private:
  static SceneSpec spec(const std::string& name) {
    if (name == "two_arms")
      return readOrs(sourcePath("tests/collision/two_arms.ors"), {.assetRoot = sourcePath(".")}).spec;
    SceneSpec spec = readUrdf(sourcePath("data/robots") / name / (name + ".urdf")).spec;
    spec.collisionChoices.clear();
    return spec;
  }
  BodyId bodyOf(std::size_t shape) const { return model_.shapes()[shape].body; }
  bool overlap(std::size_t a, std::size_t b) const {
    fcl::CollisionRequestd request;
    fcl::CollisionResultd result;
    return objects_[a]->getAABB().overlap(objects_[b]->getAABB()) &&
           fcl::collide(objects_[a].get(), objects_[b].get(), request, result) > 0;
  }

  Model model_;
  std::vector<std::unique_ptr<fcl::CollisionObjectd>> objects_;
};

Eigen::VectorXd randomPosture(const Model& model, Rng& rng) {
  Eigen::VectorXd q(model.nq());
  for (Eigen::Index i = 0; i < q.size(); ++i)
    q[i] = rng.uniform(model.lowerLimits()[i], model.upperLimits()[i]);
  return q;
}

// By the text of the rule: a joint that moves, or that and fixed ones, leads from one to the other.
bool areLinked(const Model& model, BodyId a, BodyId b) {
  for (int turn = 0; turn < 2; ++turn, std::swap(a, b)) {
    int moving = 0;
    BodyId at = a;
    for (; at != b && at != kWorld; at = model[at].parent)
      moving += model[at].joint != kNoJoint && model[model[at].joint].nv > 0 ? 1 : 0;
    if (at == b && moving <= 1) return true;
  }
  return false;
}

// Distances of all pairs of bodies that the model looks at: the least of their shapes.
std::map<Pair, double> distances(const ContactModel& contacts, const BodyPoses& poses) {
  std::map<Pair, double> least;
  for (const Proxy& proxy : proxies(contacts, poses, 0.01)) {
    double& distance =
        least.emplace(Pair(contacts.body(proxy.pair.a), contacts.body(proxy.pair.b)), INFINITY).first->second;
    distance = std::min(distance, proxy.proximity.distance);
  }
  return least;
}

constexpr int kPostures = 10000;

class SelfCollision : public testing::TestWithParam<std::string> {};

// FCL takes cylinders to some 1e-5 m, and says of what touches whatever it likes.
TEST_P(SelfCollision, IsReportedWhereverFclSeesOne) {
  constexpr double kSurely = 1e-4;  // metres
  Robot robot(GetParam());
  const Model& model = robot.model();
  const ContactModel contacts(model);
  const std::set<Pair> atHome = robot.touching(model.initialPositions());
  std::set<Pair> allowed;
  for (const PairVerdict& verdict : pairVerdicts(model))
    if (verdict.mayCollide) allowed.emplace(verdict.a, verdict.b);
  Rng rng(5);
  long seen = 0;
  for (int k = 0; k < kPostures; ++k) {
    const Eigen::VectorXd q = randomPosture(model, rng);
    const std::set<Pair> touching = robot.touching(q);
    const std::map<Pair, double> near = distances(contacts, forwardKinematics(model, q));
    for (const Pair& pair : touching) {
      const bool isOut = areLinked(model, pair.first, pair.second) || atHome.contains(pair);
      if (isOut) continue;
      const auto found = near.find(pair);
      ASSERT_TRUE(found != near.end() && found->second < kSurely)
          << model[pair.first].name << ", " << model[pair.second].name << " in posture " << k;
      ++seen;
    }
    for (const auto& [pair, distance] : near) {
      EXPECT_TRUE(allowed.contains(pair));
      EXPECT_FALSE(areLinked(model, pair.first, pair.second));
      EXPECT_TRUE(distance >= -kSurely || touching.contains(pair)) << k;
    }
  }
  EXPECT_GT(seen, kPostures / 20) << "postures with collisions";
}

// What the model holds for immovable does not move, and all else does.
TEST_P(SelfCollision, LeavesOutWhatCannotMove) {
  Robot robot(GetParam());
  const Model& model = robot.model();
  std::vector<BodyPoses> poses;
  Rng rng(6);
  for (int k = 0; k < 10; ++k) poses.push_back(forwardKinematics(model, randomPosture(model, rng)));
  for (const PairVerdict& verdict : pairVerdicts(model)) {
    double change = 0;
    const auto relative = [&](const BodyPoses& at) { return at[verdict.a].inverse() * at[verdict.b]; };
    for (const BodyPoses& at : poses)
      change = std::max({change, (relative(at).R - relative(poses[0]).R).norm(),
                         (relative(at).p - relative(poses[0]).p).norm()});
    const bool isStill = verdict.reason == PairReason::kSamePart || verdict.reason == PairReason::kCannotMove;
    EXPECT_EQ(isStill, change < 1e-9) << model[verdict.a].name << ", " << model[verdict.b].name;
  }
}

INSTANTIATE_TEST_SUITE_P(OwnRobots, SelfCollision,
                         testing::Values("humanoid", "quadruped", "two_arms", "hand"),
                         [](const auto& i) { return i.param; });

}  // namespace rex::self_collision_test
