// Our own robots from data/robots: each has named postures, stays in them on its motors, and finds its way
// from one to the next.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <ostream>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "collision/motion_clearance.h"
#include "course/motion.h"
#include "course/recording.h"
#include "course/simulator.h"
#include "formats/scene_file.h"
#include "geometry/pose.h"
#include "geometry/shape.h"
#include "kinematics/forward_kinematics.h"
#include "physics/physics_world.h"
#include "physics/small_scenes.h"
#include "scene/model.h"
#include "support/paths.h"
#include "support/rounds.h"

namespace rex::own_robots_test {

namespace fs = std::filesystem;
using ::testing::IsEmpty;

struct Own {
  std::string name;
  std::string tip;  // what reaches
  bool walks = false;
};

void PrintTo(const Own& robot, std::ostream* out) { *out << robot.name; }

const std::vector<Own> kOwn = {{"arm6dof", "tool"},
                               {"arm7dof", "tool"},
                               {"arm7offset", "tool"},
                               {"gripper", "left_finger"},
                               {"hand", "index_tip"},
                               {"humanoid", "left_hand", true},
                               {"humanoid_hands", "right_index_tip", true},
                               {"quadruped", "front_left_foot", true}};
// Between fingers beside each other.
constexpr double kClearance = 0.002;

fs::path fileOf(const std::string& name) { return sourcePath("data/robots") / name / (name + ".urdf"); }

class OwnRobots : public testing::TestWithParam<Own> {
 protected:
  const fs::path file_ = fileOf(GetParam().name);
  const SceneFile scene_ = readScene(file_, {.freeBase = GetParam().walks});
};

TEST_P(OwnRobots, LoadWithoutANote) {
  for (const Diagnostic& note : scene_.notes) ADD_FAILURE() << toString(note);
  const Model model = compile(scene_.spec);
  ASSERT_GE(model.postures().size(), 2u);
  EXPECT_EQ(model.postures()[0].name, "state:home");
  for (const NamedPosture& one : model.postures()) {
    EXPECT_TRUE((one.q.array() >= model.lowerLimits().array()).all()) << one.name;
    EXPECT_TRUE((one.q.array() <= model.upperLimits().array()).all()) << one.name;
  }
  for (const Joint& joint : model.joints()) {
    if (joint.nv != 1 || joint.mimics) continue;
    EXPECT_LT(joint.maxEffort, 1e3) << joint.name;
  }
}

// Exact for balls, and for boxes and cylinders that are not tilted.
double lowestPoint(const Model& model, const Eigen::VectorXd& q) {
  const BodyPoses poses = forwardKinematics(model, q);
  double lowest = 0;
  for (const ModelShape& shape : model.shapes()) {
    if (!shape.contact) continue;
    const Pose X_WS = poses[shape.body] * shape.X_BS;
    const bool isBall = shape.shape.type == ShapeType::kSphere;
    const double below = isBall ? shape.shape.radius : X_WS.R.row(2).cwiseAbs().dot(halfBounds(shape.shape));
    lowest = std::min(lowest, X_WS.p.z() - below);
  }
  return lowest;
}

TEST_P(OwnRobots, StayInTheirPostures) {
  const Model alone = compile(scene_.spec);
  for (const NamedPosture& posture : alone.postures()) {
    SCOPED_TRACE(posture.name);
    SceneSpec spec = scene_.spec;
    if (GetParam().walks) addGround(spec, translation(0, 0, lowestPoint(alone, posture.q)));
    const Model model = compile(spec);
    PhysicsWorld world(model);
    State state = initialState(model);
    state.q = posture.q;
    world.setState(state);
    std::vector<Motor> motors(static_cast<std::size_t>(model.nv()));
    for (const Joint& joint : model.joints()) {
      if (joint.mimics || joint.nv != 1) continue;
      motors[static_cast<std::size_t>(joint.vIndex)] = {
          .kind = Motor::Kind::kPosition, .target = posture.q[joint.qIndex], .maxForce = joint.maxEffort};
    }
    world.setMotors(motors);
    double farthest = 0, moved = 0;
    for (int i = 0; i < 1000 * rounds(1, 5); ++i) {
      world.step(1e-3);
      const Eigen::VectorXd offset = world.state().q - posture.q;
      farthest = std::max(farthest, offset.lpNorm<Eigen::Infinity>());
      moved = std::max(moved, GetParam().walks ? offset.head(3).norm() : 0);
    }
    fmt::print("{} {}: {:.2g} m and {:.2g} rad away\n", GetParam().name, posture.name, moved, farthest);
    EXPECT_LT(farthest, 2e-3);
    EXPECT_LT(world.state().v.norm(), 1e-2);
  }
}

TEST_P(OwnRobots, FindAWayFromHomeToAnyPosture) {
  Simulator S(file_.string(), {.posture = "state:home"});
  const Model model = compile(readScene(file_).spec);
  const ContactModel contacts(model);
  for (const NamedPosture& goal : model.postures()) {
    SCOPED_TRACE(goal.name);
    const Eigen::VectorXd start = S.getJointAngles();
    const Move move = moveTo(S, goal.q, {.clearance = kClearance});
    ASSERT_TRUE(move.isFound) << move.message;
    EXPECT_LT((S.getJointAngles() - goal.q).norm(), 1e-9);
    EXPECT_GE(move.duration, (goal.q - start).norm() > 0 ? 0.1 : 0);
    EXPECT_GE(move.clearance, 0.5 * kClearance);
  }
}

TEST_P(OwnRobots, ReachWhereTheirPosturesHaveThem) {
  Simulator S(file_.string(), {.posture = "state:home"});
  const Model model = compile(readScene(file_).spec);
  const BodyId tip = model.body(GetParam().tip);
  for (const NamedPosture& goal : model.postures()) {
    SCOPED_TRACE(goal.name);
    const Pose X_WB = forwardKinematics(model, goal.q)[tip];
    const ReachedPosture reached = S.inverseKinematics(GetParam().tip, X_WB);
    ASSERT_TRUE(reached.isReached) << reached.message;
    const Pose found = forwardKinematics(model, reached.q)[tip];
    EXPECT_LT((found.p - X_WB.p).norm(), 2e-6);
    EXPECT_LT((found.R - X_WB.R).norm(), 4e-6);
  }
}

INSTANTIATE_TEST_SUITE_P(Ours, OwnRobots, testing::ValuesIn(kOwn),
                         [](const auto& i) { return i.param.name; });

// The published tables, multiplied.
TEST(OwnArms, HaveTheLengthsThatTheirMakersPublish) {
  const auto toolAt = [](const std::string& name, const Eigen::VectorXd& q) {
    const Model model = compile(readScene(fileOf(name)).spec);
    return forwardKinematics(model, q)[model.body("tool")].p;
  };
  EXPECT_LT(
      (toolAt("arm6dof", Eigen::VectorXd::Zero(6)) - Eigen::Vector3d(-0.81725, -0.19145, -0.005491)).norm(),
      1e-6);
  EXPECT_LT((toolAt("arm7offset", Eigen::VectorXd::Zero(7)) - Eigen::Vector3d(0.088, 0, 0.926)).norm(), 1e-6);
}

TEST(OwnRobotsFolder, HasNoRobotThatNobodyTests) {
  std::vector<std::string> tested = {"balancer"}, found;  // which has no motors to hold it
  for (const Own& robot : kOwn) tested.push_back(robot.name);
  for (const auto& entry : fs::directory_iterator(sourcePath("data/robots")))
    if (entry.is_directory()) found.push_back(entry.path().filename().string());
  EXPECT_THAT(found, testing::UnorderedElementsAreArray(tested));
}

}  // namespace rex::own_robots_test
