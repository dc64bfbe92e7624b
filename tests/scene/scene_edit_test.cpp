#include "scene/scene_edit.h"

#include <array>

#include <gtest/gtest.h>

#include "kinematics/forward_kinematics.h"
#include "support/expect_error.h"
#include "support/random_scene.h"

namespace rex::scene_edit_test {

BodyPoses initialPoses(const SceneSpec& spec) {
  const Model model = compile(spec);
  return forwardKinematics(model, model.initialPositions());
}

void expectSamePlaces(const SceneSpec& one, const SceneSpec& other, double tolerance = 1e-12) {
  const Model a = compile(one), b = compile(other);
  const BodyPoses inA = initialPoses(one), inB = initialPoses(other);
  ASSERT_EQ(a.bodies().size(), b.bodies().size());
  for (const BodySpec& body : one.bodies)
    EXPECT_TRUE(isApprox(inA[a.body(body.name)], inB[b.body(body.name)], tolerance)) << body.name;
}

SceneSpec randomPosture(Rng& rng, int bodies) {
  const SceneSpec spec = randomScene(rng, bodies);
  return atPositions(spec, randomPositions(rng, compile(spec).nq()));
}

// b0 -first- b1 -second- b2, and b3 on b1; second mimics first.
SceneSpec smallTree() {
  SceneSpec spec;
  spec.name = "tree";
  for (const char* name : {"b0", "b1", "b2", "b3"}) spec.bodies.push_back({.name = name, .X_WB = {}});
  spec.joints = {
      {.name = "first", .parent = "b0", .child = "b1", .X_PF = translation(1, 0, 0), .X_MC = {}},
      {.name = "second",
       .parent = "b1",
       .child = "b2",
       .X_PF = translation(0, 1, 0),
       .X_MC = {},
       .mimic = "first"},
      {.name = "third", .parent = "b1", .child = "b3", .type = JointType::kBall, .X_PF = {}, .X_MC = {}}};
  return spec;
}

TEST(AtPositions, MakesAPostureTheInitialOne) {
  Rng rng(1);
  const SceneSpec spec = randomScene(rng, 25);
  const Model model = compile(spec);
  const Eigen::VectorXd q = randomPositions(rng, model.nq());
  EXPECT_EQ(compile(atPositions(spec, q)).initialPositions(), q);
  EXPECT_REX_ERROR(atPositions(spec, Eigen::VectorXd::Zero(2)),
                   "joint positions q: found a vector of size 2");
}

TEST(InitialPose, IsThatOfForwardKinematics) {
  Rng rng(2);
  const SceneSpec spec = randomPosture(rng, 30);
  const Model model = compile(spec);
  const BodyPoses poses = initialPoses(spec);
  for (const BodySpec& body : spec.bodies)
    EXPECT_TRUE(isApprox(initialPose(spec, body.name), poses[model.body(body.name)], 1e-12));
  SceneSpec mimic = smallTree();
  mimic.joints[0].q0 = Eigen::VectorXd::Constant(1, 0.4);
  mimic.joints[1].mimicRatio = -2;
  mimic.joints[1].mimicOffset = 0.1;
  EXPECT_TRUE(isApprox(initialPose(mimic, "b2"), initialPoses(mimic)[compile(mimic).body("b2")], 1e-14));
  EXPECT_REX_ERROR(initialPose(spec, "b99"), "scene 'random' has no body 'b99'");
}

TEST(InitialPose, SaysWhichCoordinatesAreWrong) {
  SceneSpec spec = smallTree();
  spec.joints[0].mimic = "second";
  EXPECT_REX_ERROR(initialPose(spec, "b2"),
                   "joint 'first': mimic: found 'second', wanted a joint that mimics no other and has "
                   "as many coordinates");
  spec.joints[0].mimic = "first";
  EXPECT_REX_ERROR(initialPose(spec, "b1"), "joint 'first': mimic: found 'first'");
  spec.joints[0].mimic = "nobody";
  EXPECT_REX_ERROR(initialPose(spec, "b1"), "joint 'first': mimic: found 'nobody'");
  spec = smallTree();
  spec.joints[1].type = JointType::kBall;
  EXPECT_REX_ERROR(initialPose(spec, "b2"), "joint 'second': mimic: found 'first'");
  spec.joints[2].q0 = Eigen::Vector2d(1, 0);
  EXPECT_REX_ERROR(initialPose(spec, "b3"), "joint 'third': initial coordinates: found 2 numbers, wanted 4");
}

TEST(ReconfigureRoot, LeavesAllBodiesWhereTheyStand) {
  Rng rng(3);
  for (int round = 0; round < 40; ++round) {
    const SceneSpec spec = randomPosture(rng, 15);
    const std::string root = "b" + std::to_string(rng.index(15));
    const SceneSpec turned = reconfigureRoot(spec, root);
    expectSamePlaces(spec, turned);
    const Model model = compile(turned);
    EXPECT_EQ(model[model.body(root)].joint, kNoJoint);
    expectSamePlaces(spec, reconfigureRoot(turned, "b0"));
  }
}

// Each joint still moves its two bodies against each other in the same way, by the same value.
TEST(ReconfigureRoot, KeepsTheValueOfJointsOfOneCoordinate) {
  Rng rng(4);
  SceneSpec spec = randomScene(rng, 12);
  for (std::size_t j = 0; j < spec.joints.size(); ++j)
    spec.joints[j].type = std::array{JointType::kHinge, JointType::kSlider, JointType::kScrew}[j % 3];
  for (int round = 0; round < 20; ++round) {
    const SceneSpec turned = reconfigureRoot(spec, "b" + std::to_string(rng.index(12)));
    const Model before = compile(spec), after = compile(turned);
    const Eigen::VectorXd q = randomPositions(rng, before.nq());
    Eigen::VectorXd same(after.nq());
    for (const Joint& joint : after.joints())
      for (const Joint& old : before.joints())
        if (old.name == joint.name) same[joint.qIndex] = q[old.qIndex];
    const BodyPoses were = forwardKinematics(before, q), are = forwardKinematics(after, same);
    for (const JointSpec& joint : spec.joints) {
      const auto between = [&](const Model& model, const BodyPoses& poses) {
        return poses[model.body(joint.parent)].inverse() * poses[model.body(joint.child)];
      };
      EXPECT_TRUE(isApprox(between(before, were), between(after, are), 1e-12));
    }
  }
}

TEST(ReconfigureRoot, TurnsLimitsRound) {
  for (const JointType type : {JointType::kPlanarXYPhi, JointType::kPlanarPhiXY, JointType::kUniversal,
                               JointType::kTranslation3, JointType::kPlanarXY, JointType::kHinge}) {
    Rng rng(5);
    SceneSpec spec;
    spec.bodies = {{.name = "a", .X_WB = {}}, {.name = "b", .X_WB = {}}};
    spec.joints = {{.name = "j",
                    .parent = "a",
                    .child = "b",
                    .type = type,
                    .X_PF = randomPose(rng),
                    .X_MC = randomPose(rng)}};
    const int n = positionCount(type);
    spec.joints[0].lower = rng.uniformVector(n, -1, 0);
    spec.joints[0].upper = rng.uniformVector(n, 0, 1);
    for (const bool atUpper : {false, true}) {
      spec.joints[0].q0 = atUpper ? spec.joints[0].upper : spec.joints[0].lower;
      const JointSpec turned = reconfigureRoot(spec, "b").joints[0];
      for (int i = 0; i < n; ++i)
        EXPECT_TRUE(turned.q0[i] == turned.lower[i] || turned.q0[i] == turned.upper[i]);
      EXPECT_TRUE((turned.lower.array() < turned.upper.array()).all());
    }
  }
}

TEST(ReconfigureRoot, TurnsALimitOfOneSideRound) {
  SceneSpec spec = smallTree();
  spec.joints[2].type = JointType::kPlanarXY;
  spec.joints[2].lower = Eigen::Vector2d(-1, -2);
  const JointSpec turned = reconfigureRoot(spec, "b3").joints[2];
  EXPECT_EQ(turned.lower, Eigen::Vector2d::Constant(-std::numeric_limits<double>::infinity()));
  EXPECT_EQ(turned.upper, Eigen::Vector2d(1, 2));
  spec.joints[2].lower.setConstant(3, -1);
  EXPECT_REX_ERROR(reconfigureRoot(spec, "b3"), "joint 'third': limits: found 3 numbers, wanted 2");
}

TEST(ReconfigureRoot, SaysWhatCannotBeTurned) {
  SceneSpec spec = smallTree();
  EXPECT_REX_ERROR(reconfigureRoot(spec, "b4"), "scene 'tree' has no body 'b4' (did you mean");
  spec.joints[2].type = JointType::kFree;
  spec.joints[2].lower = Eigen::VectorXd::Constant(7, -1);
  spec.joints[2].upper = Eigen::VectorXd::Constant(7, 1);
  EXPECT_REX_ERROR(reconfigureRoot(spec, "b3"),
                   "joint 'third': cannot be reversed: found limits of a free joint, wanted none");
  spec.joints[2].lower.resize(0);
  spec.joints[2].upper.resize(0);
  spec.joints[2].stiffness = 1;
  EXPECT_REX_ERROR(
      reconfigureRoot(spec, "b3"),
      "joint 'third': cannot be reversed: found an armature or a spring of a free joint, wanted none");
  spec.joints[2].stiffness = 0;
  spec.joints[0].parent = "world";
  EXPECT_REX_ERROR(reconfigureRoot(spec, "b1"),
                   "joint 'first': cannot be reversed: found a joint of the world");
  spec = smallTree();
  spec.joints[0].type = spec.joints[1].type = JointType::kBall;
  EXPECT_REX_ERROR(reconfigureRoot(spec, "b1"),
                   "joint 'first': cannot be reversed: found a mimic with several coordinates");
}

TEST(InitialPose, RefusesLoops) {
  SceneSpec loop = smallTree();
  loop.joints.push_back({.name = "back", .parent = "b2", .child = "b0", .X_PF = {}, .X_MC = {}});
  EXPECT_REX_ERROR(initialPose(loop, "b2"), "loop: found joints that lead back to it, wanted a tree");
}

}  // namespace rex::scene_edit_test
