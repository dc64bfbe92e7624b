#include <cmath>

#include "course/recording.h"
#include "course/simulator.h"
#include "support/expect_error.h"

namespace rex::simulator_physics_test {

// A ball of 1 kg and 0.1 m above the ground, free to move.
SimulatorDescription ballOverGround() {
  return {.sceneName = "ball.ors",
          .sceneText =
              "shape ground { rel=<T t(0 0 -0.5)> type=ST_box size=[10 10 1 0] contact }\n"
              "body root {}\n"
              "body ball { mass=1 type=ST_sphere size=[0 0 0 0.1] contact }\n"
              "joint drop (root ball) { type=transZ q=1 }\n",
          .q = {}};
}

// A box of 1 kg that lies on the ground, free to slide along x and to rise.
SimulatorDescription boxOnGround() {
  return {.sceneName = "box.ors",
          .sceneText =
              "shape ground { rel=<T t(0 0 -0.5)> type=ST_box size=[10 10 1 0] contact }\n"
              "body root {}\n"
              "body rail { mass=0.01 }\n"
              "body box { mass=0.99 type=ST_box size=[0.2 0.2 0.2 0] contact }\n"
              "joint slide (root rail) { type=transX }\n"
              "joint rise (rail box) { type=transZ q=0.1 }\n",
          .q = {}};
}

TEST(SimulatorPhysics, FallsAndLies) {
  Simulator S(ballOverGround());
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(1);
  const double height = S.kinematicsPos("ball").z();
  ASSERT_GT(height, 0.5);
  S.stepPhysics(none, 0.1);
  EXPECT_NEAR(S.kinematicsPos("ball").z(), height - 9.81 * 0.01 / 2, 9.81 * 0.1 * 1e-3);
  for (int i = 0; i < 20; ++i) S.stepPhysics(none, 0.1);
  EXPECT_NEAR(S.kinematicsPos("ball").z(), 0.1, 1e-3);
  EXPECT_NEAR(S.getJointVels()[0], 0, 1e-6);
  EXPECT_EQ(S.recording().count(), 22u);
}

TEST(SimulatorPhysics, FeelsForcesAndGravity) {
  Simulator S(ballOverGround());
  const double height = S.kinematicsPos("ball").z();
  S.stepPhysics(Eigen::VectorXd::Constant(1, 9.81), 0.5);
  EXPECT_NEAR(S.kinematicsPos("ball").z(), height, 1e-9);
  S.setDynamicGravity(false);
  S.stepPhysics(Eigen::VectorXd::Constant(1, 2), 0.5);
  EXPECT_NEAR(S.getJointVels()[0], 1, 1e-9);
}

TEST(SimulatorPhysics, CopiesGoTheirOwnWay) {
  Simulator S(ballOverGround());
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(1);
  S.stepPhysics(none, 0.2);
  Simulator copy = S;
  S.stepPhysics(none, 0.1);
  EXPECT_GT(copy.kinematicsPos("ball").z(), S.kinematicsPos("ball").z());
  copy.stepPhysics(none, 0.1);
  EXPECT_EQ(copy.getJointAngles(), S.getJointAngles());
  copy.setJointAngles(Eigen::VectorXd::Zero(1));
  copy.stepPhysics(none, 1e-3);
  EXPECT_NEAR(copy.getJointAngles()[0], 0, 0.01);
}

// A copy finds the contact forces anew: copies are equal to the bit, and nearly so to the original.
TEST(SimulatorPhysics, CopiesInContactGoOnAlike) {
  Simulator S(boxOnGround());
  const Eigen::VectorXd push = Eigen::Vector2d(7, 0);  // more than 0.6 m g
  S.stepPhysics(push, 0.2);
  ASSERT_GT(S.getJointVels()[0], 0.1);
  Simulator first = S, second = S;
  for (Simulator* one : {&S, &first, &second}) one->stepPhysics(push, 0.2);
  EXPECT_EQ(first.getJointAngles(), second.getJointAngles());
  EXPECT_EQ(first.getJointVels(), second.getJointVels());
  EXPECT_LT((first.getJointAngles() - S.getJointAngles()).norm(), 1e-4);
  EXPECT_LT((first.getJointVels() - S.getJointVels()).norm(), 1e-3);
}

TEST(SimulatorPhysics, RubsWithSixTenthsAndDoesNotBounce) {
  Simulator S(boxOnGround());
  S.stepPhysics(Eigen::Vector2d(5.5, 0), 1);
  EXPECT_NEAR(S.getJointAngles()[0], 0, 1e-3);
  S.stepPhysics(Eigen::Vector2d(7, 0), 1);
  EXPECT_NEAR(S.getJointVels()[0], 7 - 0.6 * 0.99 * 9.81, 1e-3);
  S.setJointAnglesAndVels(Eigen::Vector2d(0, 0.3), Eigen::Vector2d::Zero());
  double highest = 0;
  for (int i = 0; i < 50; ++i) {
    S.stepPhysics(Eigen::Vector2d::Zero(), 0.01);
    if (i > 25) highest = std::max(highest, S.getJointAngles()[1] - 0.1);  // it lies after 0.2 s
  }
  EXPECT_LT(highest, 1e-3);
  EXPECT_NEAR(S.kinematicsPos("box").z(), 0.1, 1e-3);
}

TEST(SimulatorPhysics, RefusesBallsThatMimic) {
  Simulator S(SimulatorDescription{.sceneName = "eyes.ors",
                                   .sceneText = "body left { mass=1 type=ST_box size=[0.1 0.1 0.1 0] }\n"
                                                "body right { mass=1 type=ST_box size=[0.1 0.1 0.1 0] }\n"
                                                "body head {}\n"
                                                "joint one (head left) { type=quatBall }\n"
                                                "joint two (head right) { mimic=one }\n",
                                   .q = {}});
  EXPECT_REX_ERROR(S.stepPhysics(Eigen::VectorXd::Zero(3), 0.1),
                   "joint 'two': found a ball joint that mimics");
  EXPECT_REX_ERROR(S.stepPhysics(Eigen::VectorXd::Zero(3), 0.1),
                   "without contact it can be simulated (stepD");
}

TEST(SimulatorPhysics, RefusesWrongNumbersAndStays) {
  Simulator S(ballOverGround());
  const Eigen::VectorXd q = S.getJointAngles(), none = Eigen::VectorXd::Zero(1);
  EXPECT_REX_ERROR(S.stepPhysics(Eigen::VectorXd::Zero(2), 0.1),
                   "stepPhysics: joint forces u: found a vector of");
  for (const double tau : {0.0, -1.0, 1001.0, std::nan("")})
    EXPECT_REX_ERROR(S.stepPhysics(none, tau), "physics: time step: found");
  EXPECT_REX_ERROR(S.stepPhysics(Eigen::VectorXd::Constant(1, std::nan("")), 0.1),
                   "joint 'drop': target: found nan");
  EXPECT_REX_ERROR(S.stepPhysics(Eigen::VectorXd::Constant(1, 1e12), 0.1), "joint 'drop' at 0.001 s");
  EXPECT_EQ(S.getJointAngles(), q);
}

}  // namespace rex::simulator_physics_test
