#include "kinematics/task_maps.h"

#include <limits>
#include <numbers>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "base/derivative_check.h"
#include "kinematics/center_of_mass.h"
#include "kinematics/jacobians.h"
#include "scene/state.h"
#include "support/expect_error.h"
#include "support/random_scene.h"

namespace rex::task_maps_test {

TaskValue valueAt(const TaskMap& map, const Model& model, const Eigen::VectorXd& q) {
  TaskValue value;
  map({model, q, forwardKinematics(model, q)}, value);
  return value;
}

struct NamedMap {
  std::string name;
  TaskMap map;
};

// Every map, between two bodies of a scene, with random parameters.
std::vector<NamedMap> allMaps(Rng& rng, const Model& model, BodyId body, BodyId a) {
  const auto vector = [&] { return Eigen::Vector3d(rng.normalVector(3)); };
  const Eigen::Vector3d p_BQ = vector(), p_AP = vector(), vector_B = vector(), vector_A = vector();
  const Quaternion nearest = rng.normalVector(4);
  const Pose X_WT = randomPose(rng);
  return {{"position", positionTask(body, p_BQ)},
          {"vector", vectorTask(body, vector_B)},
          {"quaternion", quaternionTask(body, nearest)},
          {"orientation", orientationTask(body, X_WT.R)},
          {"pose", poseTask(body, X_WT, p_BQ)},
          {"relative position", relativePositionTask(body, p_BQ, a, p_AP)},
          {"relative vector", relativeVectorTask(body, vector_B, a)},
          {"relative quaternion", relativeQuaternionTask(body, a, nearest)},
          {"alignment", alignmentTask(body, vector_B, vector_A)},
          {"relative alignment", relativeAlignmentTask(body, vector_B, a, vector_A)},
          {"joint limits", jointLimitsTask(0.3)},
          {"centre of mass", centerOfMassTask()},
          {"homing", homingTask(randomPositions(rng, model.nq()))}};
}

void expectDerivative(const NamedMap& named, const Model& model, const Eigen::VectorXd& q) {
  const VectorFunction alongV = [&](const Eigen::VectorXd& v) {
    return valueAt(named.map, model, integrate(model, q, v)).y;
  };
  const JacobianCheck check =
      checkJacobian(alongV, valueAt(named.map, model, q).J, Eigen::VectorXd::Zero(model.nv()), 1e-7);
  EXPECT_TRUE(check.ok) << named.name << ": " << check.message;
}

// A tree of every joint type, with limits and joints that mimic.
Model detailedModel(Rng& rng) {
  SceneSpec spec = randomScene(rng, 26);
  addDetails(rng, spec);
  return compile(spec);
}

class TaskMapDerivative : public testing::TestWithParam<double> {};

TEST_P(TaskMapDerivative, AgreesWithDifferences) {
  Rng rng(31);
  for (int i = 0; i < 6; ++i) {
    const Model model = i % 2 == 0 ? detailedModel(rng) : compile(randomScene(rng, 13));
    const int bodies = static_cast<int>(model.bodies().size());
    const Eigen::VectorXd q =
        integrate(model, model.initialPositions(), GetParam() * rng.normalVector(model.nv()));
    for (int pair = 0; pair < 5; ++pair) {
      const BodyId body{rng.index(bodies)}, a{rng.index(bodies)};
      for (const NamedMap& named : allMaps(rng, model, body, a)) expectDerivative(named, model, q);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(AtZeroTinyAndRandom, TaskMapDerivative, testing::Values(0., 1e-8, 1.));

// The error itself zero, tiny, and nearly half a turn.
TEST(OrientationTask, HasItsDerivativeNearTheTargetAndFarFromIt) {
  Rng rng(32);
  const Model model = compile(randomScene(rng, 12));
  const Eigen::VectorXd q = randomPositions(rng, model.nq());
  const BodyId body{12};
  const Eigen::Matrix3d R_WB = forwardKinematics(model, q)[body].R;
  for (const double angle : {0., 1e-8, 1e-3, 1., 3.1}) {
    const Eigen::Vector3d e = angle * Eigen::Vector3d(rng.normalVector(3)).normalized();
    const Eigen::Matrix3d R_WT = expSO3(-e) * R_WB;
    EXPECT_LT((valueAt(orientationTask(body, R_WT), model, q).y - e).norm(), 1e-7 + 1e-15 * angle) << angle;
    expectDerivative({"orientation", orientationTask(body, R_WT)}, model, q);
    expectDerivative({"pose", poseTask(body, {R_WT, Eigen::Vector3d::Zero()})}, model, q);
  }
}

TEST(PoseTask, IsPositionAboveOrientation) {
  Rng rng(33);
  const Model model = compile(randomScene(rng, 12));
  const Eigen::VectorXd q = randomPositions(rng, model.nq());
  const BodyId body{11};
  const Pose X_WT = randomPose(rng);
  const Eigen::Vector3d p_BQ(0.1, 0.2, 0.3);
  const TaskValue pose = valueAt(poseTask(body, X_WT, p_BQ), model, q);
  const TaskValue place = valueAt(positionTask(body, p_BQ), model, q);
  const TaskValue turn = valueAt(orientationTask(body, X_WT.R), model, q);
  EXPECT_EQ(pose.y.head<3>(), place.y - X_WT.p);
  EXPECT_EQ(pose.y.tail<3>(), turn.y);
  EXPECT_EQ(pose.J.topRows(3), place.J);
  EXPECT_EQ(pose.J.bottomRows(3), turn.J);
}

TEST(QuaternionTask, TakesTheQuaternionOnTheSideOfItsReference) {
  Rng rng(34);
  const Model model = compile(randomScene(rng, 12));
  for (int i = 0; i < 50; ++i) {
    const Eigen::VectorXd q = randomPositions(rng, model.nq());
    const BodyId body{1 + rng.index(12)};
    const Eigen::Matrix3d R_WB = forwardKinematics(model, q)[body].R;
    const Quaternion nearest = rng.normalVector(4);
    const TaskValue plain = valueAt(quaternionTask(body), model, q);
    const TaskValue chosen = valueAt(quaternionTask(body, nearest), model, q);
    EXPECT_GE(plain.y[0], 0);
    EXPECT_GE(chosen.y.dot(nearest), 0);
    EXPECT_LT((rotationFromQuaternion(chosen.y) - R_WB).norm(), 1e-14);
    // A unit quaternion keeps its length.
    EXPECT_LT((chosen.y.transpose() * chosen.J).norm(), 1e-14);
  }
}

TEST(RelativeTasks, EqualPosesInTheOtherBody) {
  Rng rng(35);
  const Model model = compile(randomScene(rng, 14));
  const Eigen::VectorXd q = randomPositions(rng, model.nq());
  const BodyPoses poses = forwardKinematics(model, q);
  const BodyId b{13}, a{7};
  const Pose X_AB = poses[a].inverse() * poses[b];
  const Eigen::Vector3d p_BQ(1, 2, 3), p_AP(-1, 0, 2), u(0.3, -2, 1);
  EXPECT_LT((valueAt(relativePositionTask(b, p_BQ, a, p_AP), model, q).y - (X_AB * p_BQ - p_AP)).norm(),
            1e-13);
  EXPECT_LT((valueAt(relativeVectorTask(b, u, a), model, q).y - X_AB.R * u).norm(), 1e-13);
  const Quaternion relative = valueAt(relativeQuaternionTask(b, a), model, q).y;
  EXPECT_LT((rotationFromQuaternion(relative) - X_AB.R).norm(), 1e-13);
  const double aligned = valueAt(relativeAlignmentTask(b, u, a, p_AP), model, q).y[0];
  EXPECT_NEAR(aligned, p_AP.dot(X_AB.R * u), 1e-13);
  // Relative to the world, it is the task itself.
  EXPECT_EQ(valueAt(relativePositionTask(b, p_BQ, kWorld, {0, 0, 0}), model, q).J,
            valueAt(positionTask(b, p_BQ), model, q).J);
}

TEST(AlignmentTask, IsOneWhereAlignedAndMinusOneWhereOpposite) {
  Rng rng(36);
  const Model model = compile(randomScene(rng, 12));
  const Eigen::VectorXd q = randomPositions(rng, model.nq());
  const BodyId body{12};
  const Eigen::Vector3d z_B = Eigen::Vector3d::UnitZ(), z_W = forwardKinematics(model, q)[body].R * z_B;
  EXPECT_NEAR(valueAt(alignmentTask(body, z_B, z_W), model, q).y[0], 1, 1e-15);
  EXPECT_NEAR(valueAt(alignmentTask(body, z_B, -z_W), model, q).y[0], -1, 1e-15);
  EXPECT_NEAR(valueAt(alignmentTask(body, z_B, z_W.unitOrthogonal()), model, q).y[0], 0, 1e-15);
}

// A hinge and a free body behind it, so that places in q and v differ after it.
Model limitedModel() {
  SceneSpec spec;
  for (const char* name : {"base", "ball", "arm"})
    spec.bodies.push_back({.name = name, .X_WB = {}, .mass = 1});
  spec.joints.push_back(
      {.name = "float", .parent = "base", .child = "ball", .type = JointType::kFree, .X_PF = {}, .X_MC = {}});
  spec.joints.push_back({.name = "hinge", .parent = "ball", .child = "arm", .X_PF = {}, .X_MC = {}});
  spec.joints[0].lower = Eigen::VectorXd::Constant(7, -1);
  spec.joints[0].upper = Eigen::VectorXd::Constant(7, 1);
  spec.joints[1].lower = Eigen::VectorXd::Constant(1, -1);
  spec.joints[1].upper = Eigen::VectorXd::Constant(1, 2);
  return compile(spec);
}

TEST(JointLimitsTask, CountsMarginsAtPlainCoordinatesOnly) {
  const Model model = limitedModel();
  ASSERT_EQ(model.nq(), 8);
  ASSERT_EQ(model.nv(), 7);
  Eigen::VectorXd q(8);
  q << 0, 0.95, -1.2, 1, 0, 0, 0, 2;  // 0.05 from a limit; 0.2 beyond one; a quaternion; on one
  const TaskValue value = valueAt(jointLimitsTask(0.1), model, q);
  EXPECT_NEAR(value.y[0], 0.5 + 3 + 1, 1e-14);
  Eigen::RowVectorXd J(7);
  J << 0, 10, -10, 0, 0, 0, 10;
  EXPECT_EQ(value.J, J);
}

TEST(HomingTask, IsTheWayFromHome) {
  Rng rng(37);
  const Model model = limitedModel();
  const Eigen::VectorXd home = randomPositions(rng, 8), q = randomPositions(rng, 8);
  const TaskValue value = valueAt(homingTask(home), model, q);
  EXPECT_EQ(value.y, difference(model, home, q));
  EXPECT_EQ(valueAt(homingTask(home), model, integrate(model, home, Eigen::VectorXd::Zero(7))).y.norm(), 0);
  EXPECT_EQ(value.y[6], q[7] - home[7]);
}

TEST(CenterOfMassTask, IsTheCentreOfMass) {
  Rng rng(38);
  const Model model = compile(randomScene(rng, 12));
  const BodyPoses poses = forwardKinematics(model, model.initialPositions());
  EXPECT_EQ(valueAt(centerOfMassTask(), model, model.initialPositions()).y, centerOfMass(model, poses));
}

TEST(RowsOf, AreThoseOfTheMap) {
  const Model model = limitedModel();
  const TaskMap whole = homingTask(model.initialPositions());
  const Eigen::VectorXd q = integrate(model, model.initialPositions(), Eigen::VectorXd::LinSpaced(7, .1, .7));
  const TaskValue all = valueAt(whole, model, q), some = valueAt(taskRows(whole, 2, 3), model, q);
  EXPECT_EQ(some.y, all.y.segment(2, 3));
  EXPECT_EQ(some.J, all.J.middleRows(2, 3));
  EXPECT_REX_ERROR(valueAt(taskRows(whole, 5, 3), model, q),
                   "rows of a map: found a value of 7 numbers, wanted at least 8");
  EXPECT_REX_ERROR(taskRows(whole, -1, 3), "first row of a map: found -1");
  EXPECT_REX_ERROR(taskRows(whole, 0, -3), "rows of a map: found -3");
}

TEST(TaskMaps, RefuseBadArguments) {
  const BodyId body{1};
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  EXPECT_REX_ERROR(quaternionTask(body, Quaternion::Zero()), "quaternion: found (0, 0, 0, 0)");
  EXPECT_REX_ERROR(relativeQuaternionTask(body, body, {kInfinity, 0, 0, 0}),
                   "quaternion: found (inf, 0, 0, 0)");
  EXPECT_REX_ERROR(jointLimitsTask(0), "margin of joint limits: found 0, wanted a positive, finite number");
  EXPECT_REX_ERROR(jointLimitsTask(kInfinity),
                   "margin of joint limits: found inf, wanted a positive, finite number");
  const Model model = limitedModel();
  EXPECT_REX_ERROR(valueAt(homingTask(Eigen::VectorXd::Zero(7)), model, model.initialPositions()),
                   "home posture: found a vector of size 7, wanted size 8");
  SceneSpec ghost;
  ghost.name = "ghost.ors";
  ghost.bodies = {{.name = "a", .X_WB = {}}};
  EXPECT_REX_ERROR(valueAt(centerOfMassTask(), compile(ghost), {}), "centre of mass of scene 'ghost.ors'");
}

}  // namespace rex::task_maps_test
