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

#include "base/rng.h"
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

// A joint as its maker publishes it: Denavit and Hartenberg's parameters, the range in rad, rad/s and Nm.
struct PublishedJoint {
  double a, alpha, d, lower, upper, velocity, effort;
};

struct PublishedArm {
  std::string name;
  bool isCraig = false;  // a and alpha lie before the joint, as Craig has them, and not behind it
  double flange = 0;     // from the last frame to the tool
  std::vector<PublishedJoint> joints;
};

constexpr double kRight = M_PI / 2, kTurn = 2 * M_PI;

const PublishedArm kPublished[] = {{.name = "arm6dof",
                                    .joints = {{0, kRight, 0.089159, -kTurn, kTurn, M_PI, 150},
                                               {-0.425, 0, 0, -kTurn, kTurn, M_PI, 150},
                                               {-0.39225, 0, 0, -M_PI, M_PI, M_PI, 150},
                                               {0, kRight, 0.10915, -kTurn, kTurn, M_PI, 28},
                                               {0, -kRight, 0.09465, -kTurn, kTurn, M_PI, 28},
                                               {0, 0, 0.0823, -kTurn, kTurn, M_PI, 28}}},
                                   {.name = "arm7offset",
                                    .isCraig = true,
                                    .flange = 0.107,
                                    .joints = {{0, 0, 0.333, -2.8973, 2.8973, 2.175, 87},
                                               {0, -kRight, 0, -1.7628, 1.7628, 2.175, 87},
                                               {0, kRight, 0.316, -2.8973, 2.8973, 2.175, 87},
                                               {0.0825, kRight, 0, -3.0718, -0.0698, 2.175, 87},
                                               {-0.0825, -kRight, 0.384, -2.8973, 2.8973, 2.61, 12},
                                               {0, kRight, 0, -0.0175, 3.7525, 2.61, 12},
                                               {0.088, kRight, 0, -2.8973, 2.8973, 2.61, 12}}}};

Eigen::Isometry3d toolOf(const PublishedArm& arm, const Eigen::VectorXd& q) {
  using Eigen::AngleAxisd, Eigen::Isometry3d, Eigen::Translation3d, Eigen::Vector3d;
  Isometry3d X = Isometry3d::Identity();
  for (std::size_t i = 0; i < arm.joints.size(); ++i) {
    const PublishedJoint& joint = arm.joints[i];
    const Isometry3d link = Translation3d(joint.a, 0, 0) * AngleAxisd(joint.alpha, Vector3d::UnitX());
    const Isometry3d turn =
        Translation3d(0, 0, joint.d) * AngleAxisd(q[static_cast<Eigen::Index>(i)], Vector3d::UnitZ());
    X = arm.isCraig ? X * link * turn : X * turn * link;
  }
  return X * Translation3d(0, 0, arm.flange);
}

TEST(OwnArms, AreAsTheirMakersPublish) {
  for (const PublishedArm& arm : kPublished) {
    SCOPED_TRACE(arm.name);
    const Model model = compile(readScene(fileOf(arm.name)).spec);
    ASSERT_EQ(model.nq(), static_cast<int>(arm.joints.size()));
    for (const Joint& joint : model.joints()) {
      if (joint.nv != 1) continue;
      const PublishedJoint& published = arm.joints[static_cast<std::size_t>(joint.qIndex)];
      EXPECT_NEAR(model.lowerLimits()[joint.qIndex], published.lower, 1e-5) << joint.name;
      EXPECT_NEAR(model.upperLimits()[joint.qIndex], published.upper, 1e-5) << joint.name;
      EXPECT_NEAR(joint.maxVelocity, published.velocity, 1e-5) << joint.name;
      EXPECT_EQ(joint.maxEffort, published.effort) << joint.name;
    }
    Rng rng(8);
    for (int round = 0; round < 20; ++round) {
      const Eigen::VectorXd q =
          round == 0 ? Eigen::VectorXd::Zero(model.nq()) : rng.uniformVector(model.nq(), -M_PI, M_PI);
      const Pose X_WT = forwardKinematics(model, q)[model.body("tool")];
      const Eigen::Isometry3d wanted = toolOf(arm, q);
      EXPECT_LT((X_WT.p - wanted.translation()).norm(), 1e-8);
      EXPECT_LT((X_WT.R - wanted.linear()).norm(), 1e-8);
    }
  }
}

// The maker's own file of the Panda, which has a base and joints of other names.
TEST(OwnArms, MoveAsThePanda) {
  const fs::path file = sharedPath("data/urdf/panda_arm_hand.urdf");
  if (!fs::exists(file)) GTEST_SKIP() << "no " << file;
  const Model panda = compile(readScene(file, {.allowMissingMeshes = true}).spec),
              ours = compile(readScene(fileOf("arm7offset")).spec);
  Rng rng(9);
  for (int round = 0; round < 20; ++round) {
    Eigen::VectorXd q = Eigen::VectorXd::Zero(panda.nq());
    q.head(7) = rng.uniformVector(7, -2, 2);
    const Pose X_WT = forwardKinematics(ours, q.head(7))[ours.body("tool")],
               wanted = forwardKinematics(panda, q)[panda.body("panda_link8")];
    EXPECT_LT((X_WT.p - wanted.p).norm(), 1e-8);
    EXPECT_LT((X_WT.R - wanted.R).norm(), 1e-8);
  }
  EXPECT_EQ(panda.lowerLimits().head(7), ours.lowerLimits());
  EXPECT_EQ(panda.upperLimits().head(7), ours.upperLimits());
}

TEST(OwnRobotsFolder, HasNoRobotThatNobodyTests) {
  std::vector<std::string> tested = {"balancer"}, found;  // which has no motors to hold it
  for (const Own& robot : kOwn) tested.push_back(robot.name);
  for (const auto& entry : fs::directory_iterator(sourcePath("data/robots")))
    if (entry.is_directory()) found.push_back(entry.path().filename().string());
  EXPECT_THAT(found, testing::UnorderedElementsAreArray(tested));
}

}  // namespace rex::own_robots_test
