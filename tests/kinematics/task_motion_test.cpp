#include "kinematics/task_motion.h"

#include <gtest/gtest.h>

#include "formats/ors_reader.h"
#include "kinematics/task_maps.h"
#include "scene/state.h"
#include "support/expect_error.h"
#include "support/paths.h"
#include "support/random_scene.h"

namespace rex::task_motion_test {

TEST(InterpolatePostures, GoesStraightWithTheProfile) {
  Rng rng(51);
  const Model model = compile(randomScene(rng, 12));
  const Eigen::VectorXd q0 =
      integrate(model, randomPositions(rng, model.nq()), Eigen::VectorXd::Zero(model.nv()));
  const Eigen::VectorXd qT = randomPositions(rng, model.nq());
  const MotionProfile profile{.shape = ProfileShape::kMinimumJerk};
  const Eigen::MatrixXd Q = interpolatePostures(model, q0, qT, 10, profile);
  ASSERT_EQ(Q.cols(), 11);
  EXPECT_LT((Q.col(0) - q0).norm(), 1e-14);
  EXPECT_LT(difference(model, Q.col(10), qT).norm(), 1e-13);
  const Eigen::VectorXd way = difference(model, q0, qT);
  for (int t = 0; t <= 10; ++t) {
    const double share = profileAt(profile, t / 10.).position;
    EXPECT_LT((difference(model, q0, Q.col(t)) - share * way).norm(), 1e-12 * (1 + way.norm()));
  }
}

TEST(InterpolateValues, GoesStraightWithTheProfile) {
  const Eigen::MatrixXd Y = interpolateValues(Eigen::Vector2d(1, 2), Eigen::Vector2d(3, -2), 4);
  ASSERT_EQ(Y.cols(), 5);
  EXPECT_EQ(Y.col(0), Eigen::Vector2d(1, 2));
  EXPECT_EQ(Y.col(4), Eigen::Vector2d(3, -2));
  EXPECT_LT((Y.col(2) - Eigen::Vector2d(2, 0)).norm(), 1e-15);
  const double quarter = 0.5 * (1 - std::sqrt(0.5));  // sine profile, slide 2:40
  EXPECT_LT((Y.col(1) - Eigen::Vector2d(1 + 2 * quarter, 2 - 4 * quarter)).norm(), 1e-15);
}

// The hand of the humanoid, and a way of 20 cm.
struct Reach {
  Model model = compile(readOrs(sourcePath("data/robots/man.ors")).spec);
  Eigen::VectorXd q0 = model.initialPositions();
  BodyId hand = model.body("handR");
  Eigen::Vector3d y0 = forwardKinematics(model, q0)[hand].p;
  Task task{.name = "hand", .map = positionTask(hand), .precision = 1e4};
  Eigen::MatrixXd way(int steps) const {
    return interpolateValues(y0, y0 + Eigen::Vector3d(0.1, -0.1, 0.15), steps);
  }
};

TEST(FollowTask, FollowsTheCloserTheSmallerItsSteps) {
  const Reach reach;
  double before = 1;
  for (const int steps : {5, 20, 80}) {
    const FollowedTask motion = followTask(reach.model, reach.task, reach.way(steps), reach.q0);
    ASSERT_EQ(motion.Q.cols(), steps + 1);
    EXPECT_EQ(motion.Q.col(0), reach.q0);
    EXPECT_LT(motion.errors.maxCoeff(), before / 2);
    before = motion.errors.maxCoeff();
    for (int t = 0; t <= steps; ++t) {
      const Eigen::Vector3d p = forwardKinematics(reach.model, motion.Q.col(t))[reach.hand].p;
      EXPECT_NEAR(motion.errors[t], (p - reach.way(steps).col(t)).cwiseAbs().maxCoeff(), 1e-14);
    }
  }
}

// Exercise 4.2: a circle drifts in joint space unless the robot also stays close to its posture.
TEST(FollowTask, StaysCloseToHomeIfThatIsATaskToo) {
  const Reach reach;
  Eigen::MatrixXd Y(3, 400);
  for (int t = 0; t < Y.cols(); ++t)
    Y.col(t) = reach.y0 + 0.1 * Eigen::Vector3d(std::cos(t / 20.) - 1, 0, std::sin(t / 20.));
  const Task home{.name = "home", .map = homingTask(reach.q0), .precision = 1, .tolerance = kNoTolerance};
  const FollowedTask drifting = followTask(reach.model, reach.task, Y, reach.q0);
  const FollowedTask homing = followTask(reach.model, reach.task, Y, reach.q0, {home});
  const auto farthest = [&](const Eigen::MatrixXd& Q) {
    return (Q.colwise() - reach.q0).colwise().norm().maxCoeff();
  };
  EXPECT_LT(farthest(homing.Q), 0.9 * farthest(drifting.Q));
  EXPECT_LT(homing.errors.maxCoeff(), 0.01);
}

TEST(FollowTask, WeighsJointsByTheMetric) {
  const Reach reach;
  Eigen::VectorXd weights = Eigen::VectorXd::Ones(reach.model.nv());
  weights[0] = 1e8;
  const FollowedTask stiff =
      followTask(reach.model, reach.task, reach.way(20), reach.q0, {}, weights.asDiagonal());
  EXPECT_LT((stiff.Q.row(0).array() - reach.q0[0]).abs().maxCoeff(), 1e-6);
  const FollowedTask free = followTask(reach.model, reach.task, reach.way(20), reach.q0);
  EXPECT_GT((free.Q.row(0).array() - reach.q0[0]).abs().maxCoeff(), 1e-3);
}

TEST(FollowTask, StopsAtLimits) {
  SceneSpec spec;
  for (const char* name : {"base", "sled"}) spec.bodies.push_back({.name = name, .X_WB = {}});
  spec.joints.push_back({.name = "rail",
                         .parent = "base",
                         .child = "sled",
                         .type = JointType::kSlider,
                         .X_PF = {},
                         .X_MC = {}});
  spec.joints[0].lower = Eigen::VectorXd::Constant(1, -1);
  spec.joints[0].upper = Eigen::VectorXd::Constant(1, 0.3);
  const Model model = compile(spec);
  const Task task{.name = "sled", .map = positionTask(model.body("sled")), .precision = 1e6};
  const Eigen::MatrixXd Y = interpolateValues(Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(1, 0, 0), 10);
  const FollowedTask motion = followTask(model, task, Y, Eigen::VectorXd::Zero(1));
  EXPECT_EQ(motion.Q(0, 10), 0.3);
  EXPECT_NEAR(motion.errors[10], 0.7, 1e-12);
}

TEST(TaskMotion, RefusesBadArguments) {
  const Reach reach;
  EXPECT_REX_ERROR(interpolatePostures(reach.model, reach.q0, reach.q0, 0),
                   "steps of a motion: found 0, wanted at least 1");
  EXPECT_REX_ERROR(interpolateValues(reach.y0, reach.y0, -1),
                   "steps of a motion: found -1, wanted at least 1");
  EXPECT_REX_ERROR(interpolateValues(reach.y0, Eigen::Vector2d(1, 2), 3),
                   "last task value yT: found a vector of size 2, wanted size 3");
  EXPECT_REX_ERROR(interpolatePostures(reach.model, reach.q0, Eigen::Vector2d(1, 2), 3),
                   "joint positions q1: found a vector of size 2");
  EXPECT_REX_ERROR(followTask(reach.model, reach.task, Eigen::MatrixXd::Zero(2, 4), reach.q0),
                   "task 'hand': target: found 2 numbers, wanted 3, as its map gives");
  EXPECT_REX_ERROR(
      followTask(reach.model, reach.task, reach.way(2), reach.q0, {}, Eigen::Matrix2d::Identity()),
      "metric W: found 2 x 2");
  const Eigen::MatrixXd noTargets(3, 0);
  EXPECT_EQ(followTask(reach.model, reach.task, noTargets, reach.q0).Q.cols(), 0);
  EXPECT_REX_ERROR(followTask(reach.model, reach.task, noTargets, Eigen::Vector2d(1, 2)),
                   "start posture q0: found a vector of size 2, wanted size ");
  EXPECT_REX_ERROR(
      followTask(reach.model, reach.task, noTargets, reach.q0, {}, -Eigen::MatrixXd::Identity(29, 29)),
      "metric W: ");
}

}  // namespace rex::task_motion_test
