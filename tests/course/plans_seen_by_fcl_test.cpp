// Plans of arms between boxes, judged by FCL on the triangles of their mesh files, which knows nothing of our
// shapes.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <ostream>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <fcl/fcl.h>
#include <fcl/geometry/geometric_shape_to_BVH_model.h>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "base/rng.h"
#include "collision/collision_pairs.h"
#include "collision/contacts.h"
#include "collision/motion_clearance.h"
#include "course/motion.h"
#include "course/recording.h"
#include "course/simulator.h"
#include "geometry/pose.h"
#include "geometry/rotation.h"
#include "kinematics/forward_kinematics.h"
#include "scene/model.h"
#include "support/paths.h"
#include "support/rounds.h"

namespace rex::plans_seen_by_fcl_test {

using Eigen::Vector3d;
using Eigen::VectorXd;
using Triangles = fcl::BVHModel<fcl::OBBRSSd>;

// Boxes lie in a shell around `center`.
struct Arm {
  std::string name, file;
  Vector3d center;
  double radius;
  std::string assets{};
};

void PrintTo(const Arm& arm, std::ostream* out) { *out << arm.name; }

constexpr double kClearance = 0.01;
constexpr int kBoxes = 8;

// All triangles of each body in one piece, and the boxes of the world; other bodies without a mesh are not
// seen.
class Judge {
 public:
  explicit Judge(const Model& model) : model_(model) {
    const BodyPoses here = forwardKinematics(model, model.initialPositions()),
                    there = forwardKinematics(model, model.initialPositions().array() + 0.3);
    for (int i = 0; i < static_cast<int>(model.bodies().size()); ++i) {
      const BodyId body{i};
      solids_.push_back(meshesOf(body));
      moves_.push_back((here[body].p - there[body].p).norm() + (here[body].R - there[body].R).norm() > 1e-9);
    }
    for (const ModelShape& shape : model.shapes()) {
      const bool isBox = shape.shape.type == ShapeType::kBox || shape.shape.type == ShapeType::kRoundedBox;
      if (!isBox || !shape.contact || moves_[static_cast<std::size_t>(shape.body)]) continue;
      auto box = std::make_shared<Triangles>();
      fcl::generateBVHModel(*box, fcl::Boxd(shape.shape.extent), fcl::Transform3d::Identity());
      boxes_.push_back(std::make_unique<fcl::CollisionObjectd>(box));
      const Pose X_WS = here[shape.body] * shape.X_BS;
      boxes_.back()->setTransform(X_WS.R, X_WS.p);
    }
    for (const ShapePair& pair : collidingPairs(model))
      pairs_.emplace(std::minmax(bodyOf(pair.a), bodyOf(pair.b)));
  }

  std::size_t triangles() const { return triangles_; }

  // The least distance of a body from a box or from a body that it may touch, if it is less than `least`; 0
  // in overlap.
  double distance(const VectorXd& q, double least) {
    const BodyPoses poses = forwardKinematics(model_, q);
    for (std::size_t i = 0; i < solids_.size(); ++i) {
      if (!solids_[i]) continue;
      const Pose& X_WB = poses[static_cast<BodyId>(i)];
      solids_[i]->setTransform(X_WB.R, X_WB.p);
      if (!moves_[i]) continue;
      for (const auto& box : boxes_) least = between(solids_[i].get(), box.get(), least);
    }
    for (const auto& [a, b] : pairs_) least = between(solids_[a].get(), solids_[b].get(), least);
    return least;
  }

 private:
  std::size_t bodyOf(int shape) const {
    return static_cast<std::size_t>(model_.shapes()[static_cast<std::size_t>(shape)].body);
  }

  std::unique_ptr<fcl::CollisionObjectd> meshesOf(BodyId body) {
    std::vector<Vector3d> points;
    std::vector<fcl::Triangle> corners;
    for (const ModelShape& shape : model_.shapes()) {
      if (shape.body != body || shape.shape.mesh.isEmpty()) continue;
      const std::size_t first = points.size();
      for (const auto& [a, b, c] : shape.shape.mesh.triangles())
        corners.emplace_back(first + a, first + b, first + c);
      for (const Eigen::Vector3f& p : shape.shape.mesh.positions())
        points.push_back(shape.X_BS * Vector3d(p.cast<double>()));
    }
    if (corners.empty()) return nullptr;
    auto triangles = std::make_shared<Triangles>();
    triangles->beginModel();
    triangles->addSubModel(points, corners);
    triangles->endModel();
    triangles_ += corners.size();
    return std::make_unique<fcl::CollisionObjectd>(triangles);
  }

  static double between(const fcl::CollisionObjectd* a, const fcl::CollisionObjectd* b, double atMost) {
    if (a == nullptr || b == nullptr) return atMost;
    fcl::DistanceResultd result(atMost);  // FCL looks for less only
    fcl::distance(a, b, fcl::DistanceRequestd(), result);
    return std::min(atMost, result.min_distance);
  }

  const Model& model_;
  std::vector<std::unique_ptr<fcl::CollisionObjectd>> solids_, boxes_;  // solids: of bodies with meshes
  std::vector<bool> moves_;
  std::set<std::pair<std::size_t, std::size_t>> pairs_;
  std::size_t triangles_ = 0;
};

VectorXd randomPosture(const Model& model, Rng& rng) {
  VectorXd q(model.nq());
  for (Eigen::Index i = 0; i < q.size(); ++i)
    q[i] = rng.uniform(std::max(model.lowerLimits()[i], -M_PI), std::min(model.upperLimits()[i], M_PI));
  return q;
}

bool isClear(const Model& model, const ContactModel& contacts, const VectorXd& q) {
  return proxies(contacts, forwardKinematics(model, q), 1.1 * kClearance).empty();
}

// A robot between boxes, and two postures that are clear while the straight way between them is not.
struct Task {
  Simulator robot;
  VectorXd start, goal;
};

Task drawTask(const Arm& arm, Rng& rng) {
  for (int attempt = 0; attempt < 1000; ++attempt) {
    Task task{.robot = Simulator(arm.file, {.assetRoot = arm.assets}), .start = {}, .goal = {}};
    for (int i = 0; i < kBoxes; ++i) {
      const double around = rng.uniform(-M_PI, M_PI), out = rng.uniform(0.5, 1.1) * arm.radius;
      const Vector3d at = arm.center + Vector3d(out * std::cos(around), out * std::sin(around),
                                                rng.uniform(-0.4, 0.8) * arm.radius);
      const Vector3d size =
          arm.radius * Vector3d(rng.uniform(0.1, 0.4), rng.uniform(0.1, 0.4), rng.uniform(0.1, 0.6));
      const Pose X_WS{rotationAboutAxis(rng.uniform(-M_PI, M_PI), Vector3d::UnitZ()), at};
      task.robot.addObstacle({.type = ShapeType::kBox, .extent = size}, X_WS, fmt::format("box {}", i));
    }
    const Model& model = task.robot.model();
    const ContactModel contacts(model);
    for (int pair = 0; pair < 20; ++pair) {
      task.start = randomPosture(model, rng), task.goal = randomPosture(model, rng);
      if (isClear(model, contacts, task.start) && isClear(model, contacts, task.goal) &&
          motionClearance(model, contacts, task.start, task.goal, 1e-3) < 0)
        return task;
    }
  }
  throw std::logic_error("no task for " + arm.name);
}

class PlansSeenByFcl : public testing::TestWithParam<Arm> {};

TEST_P(PlansSeenByFcl, AreClearInAllPostures) {
  if (!std::filesystem::exists(GetParam().file)) GTEST_SKIP() << "needs the package dart-doc";
  Rng rng(11);
  int found = 0;
  for (int round = 0; round < rounds(1, 3); ++round) {
    Task task = drawTask(GetParam(), rng);
    task.robot.setJointAngles(task.start);
    const Move move = moveTo(task.robot, task.goal, {.clearance = kClearance, .timeLimit = 5});
    if (!move.isFound) {
      fmt::print("{}: {}\n", GetParam().name, move.message);
      continue;
    }
    ++found;
    Judge judge(task.robot.model());
    ASSERT_GT(judge.triangles(), 1000u);
    const std::vector<RecordedPosture> way = task.robot.recording().evenly(1'000'000);
    double least = INFINITY;
    std::size_t postures = 0;
    for (std::size_t row = 1; row < way.size(); ++row) {
      for (int part = 0; part < 4; ++part, ++postures)
        least = judge.distance(way[row - 1].q + part / 4. * (way[row].q - way[row - 1].q), least);
    }
    fmt::print("{}: {} triangles, {} postures, clearance {:.4f} m by us, {:.4f} m by FCL\n", GetParam().name,
               judge.triangles(), postures, move.clearance, least);
    // Rings around joints are only drawn, and stick out by up to 4 mm.
    EXPECT_GT(least, move.clearance - 4e-3);
    EXPECT_GT(least, 0.5 * kClearance);
    // The straight way is seen to be blocked.
    double straight = INFINITY;
    for (int i = 0; i <= 200; ++i)
      straight = judge.distance(task.start + i / 200. * (task.goal - task.start), straight);
    EXPECT_LT(straight, kClearance);
  }
  EXPECT_GT(found, 0);
}

INSTANTIATE_TEST_SUITE_P(
    Arms, PlansSeenByFcl,
    testing::Values(
        Arm{"arm6dof", sourcePath("data/robots/arm6dof/arm6dof.urdf"), {0, 0, 0.1}, 0.7},
        Arm{"arm7dof", sourcePath("data/robots/arm7dof/arm7dof.urdf"), {0, 0, 0.35}, 0.7},
        Arm{"arm7offset", sourcePath("data/robots/arm7offset/arm7offset.urdf"), {0, 0, 0.35}, 0.7},
        Arm{"arm_with_gripper", sourcePath("data/scenes/pick.ors"), {0, 0, 1.1}, 0.7},
        Arm{"kr5", "/usr/share/doc/dart/data/urdf/KR5/KR5 sixx R650.urdf", {0, 0, 0.35}, 0.6},
        Arm{"two_arms", sourcePath("tests/collision/two_arms.ors"), {0.3, 0, 0.9}, 0.9, sourcePath(".")}),
    [](const auto& i) { return i.param.name; });

}  // namespace rex::plans_seen_by_fcl_test
