#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "base/rng.h"
#include "course/course.h"
#include "dynamics/energy.h"
#include "dynamics/equations_of_motion.h"
#include "dynamics/stepper.h"
#include "support/expect_error.h"

namespace rex::simulator_dynamics_test {

class SimulatorOfScene : public testing::TestWithParam<const char*> {};

// Golden numbers are those of the library; here it is the right functions, state and gravity.
TEST_P(SimulatorOfScene, HasTheDynamicsOfTheLibrary) {
  Simulator S(GetParam());
  const int n = S.getJointDimension();
  ASSERT_GT(n, 0);
  Rng rng(73);
  const State state{rng.normalVector(n), rng.normalVector(n)};
  const Eigen::VectorXd u = rng.normalVector(n);
  for (const bool falls : {true, false}) {
    S.setDynamicGravity(falls);
    S.setJointAnglesAndVels(state.q, state.v);
    const Eigen::Vector3d gravity_W = falls ? earthGravity() : Eigen::Vector3d::Zero();
    Eigen::MatrixXd M;
    Eigen::VectorXd F;
    S.getDynamics(M, F);
    EXPECT_EQ(M, massMatrix(S.model(), state.q));
    EXPECT_EQ(F, biasForces(S.model(), state.q, state.v, gravity_W));
    EXPECT_EQ(S.getEnergy(), energy(S.model(), state.q, state.v, gravity_W).total());

    State next = state;
    Stepper(S.model(), {.gravity_W = gravity_W}).step(next, u, 0.01);
    S.stepDynamics(u, 0.01);
    EXPECT_EQ(S.getJointAngles(), next.q);
    EXPECT_EQ(S.getJointVels(), next.v);
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, SimulatorOfScene, testing::Values("man", "pegArm", "arm3", "pegInAHole"),
                         [](const auto& scene) { return std::string(scene.param); });

const Eigen::VectorXd kNoForce = Eigen::Vector3d::Zero();

TEST(SimulatorDynamics, KeepsEnergyAndRecordsItsWay) {
  Simulator S("pegArm");
  S.clearRecording();
  const double before = S.getEnergy();
  for (int i = 0; i < 1000; ++i) S.stepDynamics(kNoForce, 0.001);
  EXPECT_NEAR(S.getEnergy(), before, 1e-8);
  EXPECT_GT(S.getJointVels().norm(), 1);
  EXPECT_EQ(S.recording().count(), 1000u);
  EXPECT_EQ(S.kinematicsPos("peg"), Simulator(S.description()).kinematicsPos("peg")) << "bodies move along";
}

// What holds an arm is F at rest.
TEST(SimulatorDynamics, StaysWhereItIsHeld) {
  Simulator S("pegArm");
  S.setJointAngles(Eigen::Vector3d(.4, -.8, .3));
  Eigen::MatrixXd M;
  Eigen::VectorXd F;
  S.getDynamics(M, F);
  EXPECT_GT(F.norm(), 0.1);
  for (int i = 0; i < 100; ++i) S.stepDynamics(F, 0.01);
  EXPECT_LT((S.getJointAngles() - Eigen::Vector3d(.4, -.8, .3)).norm(), 1e-9);
}

TEST(SimulatorDynamics, AnglesAndVelocitiesAreSetTogether) {
  Simulator S("pegArm");
  Eigen::VectorXd q, v;
  S.getJointAnglesAndVels(q, v);
  EXPECT_EQ(v, kNoForce) << "at first at rest";
  S.setJointAnglesAndVels(Eigen::Vector3d(1, 2, 3), Eigen::Vector3d(4, 5, 6));
  S.setJointAngles(Eigen::Vector3d(3, 2, 1));
  S.getJointAnglesAndVels(q, v);
  EXPECT_EQ(q, Eigen::Vector3d(3, 2, 1));
  EXPECT_EQ(v, Eigen::Vector3d(4, 5, 6));
}

TEST(SimulatorDynamics, GravityCanBeTurnedOff) {
  Simulator S("pegArm");
  S.setJointAngles(Eigen::Vector3d(.4, -.8, .3));
  S.stepDynamics(kNoForce, 0.01);
  EXPECT_GT(S.getJointVels().norm(), 1e-3);
  S.setJointAnglesAndVels(Eigen::Vector3d(.4, -.8, .3), kNoForce);
  S.setDynamicGravity(false);
  for (int i = 0; i < 10; ++i) S.stepDynamics(kNoForce, 0.01);
  EXPECT_EQ(S.getJointVels(), kNoForce);
  EXPECT_EQ(S.getEnergy(), 0);
  S.setDynamicGravity(true);
  S.stepDynamics(kNoForce, 0.01);
  EXPECT_GT(S.getJointVels().norm(), 1e-3);
}

TEST(SimulatorDynamics, NoiseHasASeed) {
  const auto end = [](std::uint64_t seed, double noise) {
    Simulator S("pegArm");
    S.setSeed(seed);
    S.setDynamicSimulationNoise(noise);
    for (int i = 0; i < 20; ++i) S.stepDynamics(kNoForce, 0.01);
    return S.getJointVels();
  };
  EXPECT_EQ(end(0, .1), end(0, .1));
  EXPECT_NE(end(0, .1), end(1, .1));
  EXPECT_EQ(end(0, 0), end(1, 0));
  Simulator unseeded("pegArm");
  unseeded.setDynamicsSimulationNoise(.1);  // the script's other name
  for (int i = 0; i < 20; ++i) unseeded.stepDynamics(kNoForce, 0.01);
  EXPECT_EQ(unseeded.getJointVels(), end(0, .1));
}

// Of M v' = u + noise, at rest and without gravity, only the noise is left.
TEST(SimulatorDynamics, NoiseHasItsVariance) {
  Simulator S("pegArm");
  S.setDynamicGravity(false);
  S.setDynamicSimulationNoise(.5);
  const double tau = .04, variance = tau * .25;
  constexpr int kSteps = 1000;
  double squares = 0;
  for (int i = 0; i < kSteps; ++i) {
    S.setJointAnglesAndVels(kNoForce, kNoForce);
    S.stepDynamics(kNoForce, tau);
    squares += S.getJointVels().squaredNorm();
  }
  EXPECT_NEAR(squares / (3 * kSteps), variance, 4 * variance * std::sqrt(2. / (3 * kSteps)));
}

TEST(SimulatorDynamics, NoiseCanBeTurnedOffAgain) {
  Simulator S("pegArm"), quiet("pegArm");
  S.setDynamicSimulationNoise(.5);
  S.stepDynamics(kNoForce, .01);
  EXPECT_NE(S.getJointVels(), kNoForce);
  S.setDynamicSimulationNoise(0);
  S.setJointAnglesAndVels(kNoForce, kNoForce);
  S.stepDynamics(Eigen::Vector3d::Ones(), .01);
  quiet.stepDynamics(Eigen::Vector3d::Ones(), .01);
  EXPECT_EQ(S.getJointVels(), quiet.getJointVels());
}

TEST(SimulatorDynamics, CopiesGoTheirOwnWay) {
  Simulator S("pegArm");
  S.setDynamicSimulationNoise(.1);
  for (int i = 0; i < 5; ++i) S.stepDynamics(kNoForce, 0.01);
  Simulator copy = S, assigned("man");
  assigned = S;
  const Eigen::VectorXd before = S.getJointVels();
  copy.stepDynamics(kNoForce, 0.01);
  EXPECT_EQ(S.getJointVels(), before);
  assigned.stepDynamics(kNoForce, 0.01);
  S.stepDynamics(kNoForce, 0.01);
  EXPECT_NE(S.getJointVels(), before);
  EXPECT_EQ(S.getJointVels(), copy.getJointVels()) << "with the same noise";
  EXPECT_EQ(S.getJointVels(), assigned.getJointVels());
  S.setDynamicGravity(false);
  S.setSeed(9);
  copy.stepDynamics(kNoForce, 0.01);
  assigned.stepDynamics(kNoForce, 0.01);
  EXPECT_EQ(copy.getJointVels(), assigned.getJointVels()) << "what is set for one holds for it alone";
}

TEST(SimulatorDynamics, DescriptionsCarryIt) {
  Simulator S("pegArm");
  S.setJointAnglesAndVels(Eigen::Vector3d(1, 2, 3), Eigen::Vector3d(4, 5, 6));
  S.setDynamicSimulationNoise(.25);
  S.setDynamicGravity(false);
  S.setSeed(77);
  const SimulatorDescription description = S.description();
  EXPECT_EQ(description.v, Eigen::Vector3d(4, 5, 6));
  EXPECT_EQ(description.dynamicNoise, .25);
  EXPECT_FALSE(description.gravity);
  EXPECT_EQ(description.seed, 77u);
  Simulator copy(description);
  S.stepDynamics(kNoForce, .01);
  copy.stepDynamics(kNoForce, .01);
  EXPECT_EQ(copy.getJointVels(), S.getJointVels());

  SimulatorDescription broken = description;
  broken.v.resize(2);
  broken.v.setZero();
  EXPECT_REX_ERROR(Simulator(broken), "setJointAnglesAndVels: found a vector of size 2, wanted size 3");
  broken = description;
  broken.dynamicNoise = -1;
  EXPECT_REX_ERROR(Simulator(broken), "setDynamicSimulationNoise: found -1");
}

// Joints count anew, and so do their velocities.
TEST(SimulatorDynamics, AnAnchoredChainIsAtRest) {
  Simulator S("pegArm");
  S.setDynamicGravity(false);
  S.setDynamicSimulationNoise(.1);
  S.setJointAnglesAndVels(Eigen::Vector3d(.1, .2, .3), Eigen::Vector3d(1, 2, 3));
  S.stepDynamics(kNoForce, 0.01);
  const Eigen::Vector3d arm = S.kinematicsPos("arm1");
  S.anchorKinematicChainIn("peg");
  EXPECT_EQ(S.getJointVels(), kNoForce);
  EXPECT_LT((S.kinematicsPos("arm1") - arm).norm(), 1e-12);
  EXPECT_FALSE(S.description().gravity);
  EXPECT_EQ(S.description().dynamicNoise, .1);
  const Eigen::Vector3d peg = S.kinematicsPos("peg");
  for (int i = 0; i < 10; ++i) S.stepDynamics(Eigen::Vector3d::Ones(), 0.01);
  EXPECT_EQ(S.kinematicsPos("peg"), peg) << "it is what stands now";
  EXPECT_GT((S.kinematicsPos("arm1") - arm).norm(), 1e-3);
}

// A ball joint has four angles and three velocities.
TEST(SimulatorDynamics, BallJointsHaveAVelocityLess) {
  Simulator S(SimulatorDescription{.sceneName = "ball.ors",
                                   .sceneText = "body post { fixed }\n"
                                                "body bob { mass=2 }\n"
                                                "joint (post bob) { type=quatBall B=<T t(0 0 -.5)> }",
                                   .q = {}});
  ASSERT_EQ(S.getJointDimension(), 4);
  ASSERT_EQ(S.getJointVels().size(), 3);
  const Eigen::VectorXd q = S.getJointAngles();
  S.setJointAnglesAndVels(q, Eigen::Vector3d(.5, -.2, .3));
  const double before = S.getEnergy();
  Eigen::MatrixXd M;
  Eigen::VectorXd F;
  S.getDynamics(M, F);
  EXPECT_EQ(M.rows(), 3);
  EXPECT_EQ(F.size(), 3);
  for (int i = 0; i < 100; ++i) S.stepDynamics(kNoForce, 0.01);
  EXPECT_NEAR(S.getEnergy(), before, 1e-6);
  EXPECT_NEAR(S.getJointAngles().norm(), 1, 1e-12);
  EXPECT_GT((S.getJointAngles() - q).norm(), 0.01);
  EXPECT_REX_ERROR(S.setJointAnglesAndVels(q, q),
                   "setJointAnglesAndVels: found a vector of size 4, wanted size 3");
  EXPECT_REX_ERROR(S.stepDynamics(q, 0.01), "joint forces u: found a vector of size 4, wanted size 3");

  const Eigen::VectorXd turned = S.getJointAngles();
  EXPECT_REX_ERROR(S.setJointAngles(Eigen::Vector4d::Zero()), "quaternion");
  EXPECT_EQ(S.getJointAngles(), turned) << "a refused posture changes nothing";
}

class SimulatorDynamicsErrors : public testing::Test {
 protected:
  SimulatorDynamicsErrors() {
    S.setDynamicSimulationNoise(.1);
    S.setJointAnglesAndVels(Eigen::Vector3d(.1, .2, .3), Eigen::Vector3d(1, 2, 3));
  }
  // The error has that text, and goes without a trace.
  template <class Call>
  void expectError(const Call& call, const std::string& text) {
    Simulator untouched = S;
    EXPECT_REX_ERROR(call(), text);
    EXPECT_EQ(S.getJointAngles(), untouched.getJointAngles());
    EXPECT_EQ(S.getJointVels(), untouched.getJointVels());
    EXPECT_EQ(S.recording().count(), untouched.recording().count());
    Simulator after = S;
    after.stepDynamics(kNoForce, .01);
    untouched.stepDynamics(kNoForce, .01);
    EXPECT_EQ(after.getJointVels(), untouched.getJointVels());
  }

  Simulator S{"pegArm"};
};

TEST_F(SimulatorDynamicsErrors, OfSteps) {
  for (const double tau : {0., -.01, std::nan(""), std::numeric_limits<double>::infinity()})
    expectError([&] { S.stepDynamics(kNoForce, tau); }, "time step: found ");
  expectError([&] { S.stepDynamics(kNoForce, -.01); }, "wanted a positive, finite number of seconds");
  expectError([&] { S.stepDynamics(Eigen::Vector2d::Zero(), .01); },
              "joint forces u: found a vector of size 2, wanted size 3");
  expectError([&] { S.stepDynamics(Eigen::Vector3d(0, std::nan(""), 0), .01); },
              "joint forces u: number 1, of joint '");
}

TEST_F(SimulatorDynamicsErrors, OfAnglesAndVelocities) {
  expectError([&] { S.setJointAnglesAndVels(Eigen::Vector2d::Zero(), kNoForce); },
              "setJointAnglesAndVels: found a vector of size 2, wanted size 3");
  expectError([&] { S.setJointAnglesAndVels(kNoForce, Eigen::Vector2d::Zero()); },
              "setJointAnglesAndVels: found a vector of size 2, wanted size 3");
  expectError([&] { S.setJointAnglesAndVels(Eigen::Vector3d(0, 0, std::nan("")), kNoForce); },
              "setJointAnglesAndVels: angle 2: found nan, wanted a finite number");
  expectError([&] { S.setJointAnglesAndVels(kNoForce, Eigen::Vector3d(0, std::nan(""), 0)); },
              "setJointAnglesAndVels: velocity 1: found nan, wanted a finite number");
}

TEST_F(SimulatorDynamicsErrors, OfNoise) {
  for (const double noise : {-1., std::nan(""), std::numeric_limits<double>::infinity()}) {
    expectError([&] { S.setDynamicSimulationNoise(noise); }, "setDynamicSimulationNoise: found ");
    expectError([&] { S.setDynamicSimulationNoise(noise); }, "wanted a finite number, 0 or more");
  }
}

// It is large enough to overflow, and leaves no trace, not even in the sequence of random numbers.
TEST_F(SimulatorDynamicsErrors, OfNoiseWithoutBounds) {
  Simulator untouched = S;
  S.setDynamicSimulationNoise(1e308);
  EXPECT_REX_ERROR(S.stepDynamics(kNoForce, .01), "': its motion grows without bounds at ");
  EXPECT_EQ(S.getJointVels(), untouched.getJointVels());
  S.setDynamicSimulationNoise(.1);
  S.stepDynamics(kNoForce, .01);
  untouched.stepDynamics(kNoForce, .01);
  EXPECT_EQ(S.getJointVels(), untouched.getJointVels());
}

// Gains that feed the motion: the error comes with the time at which it was too much.
TEST_F(SimulatorDynamicsErrors, OfMotionsWithoutBounds) {
  S.setDynamicSimulationNoise(0);
  int steps = 0;
  std::string message;
  for (; steps < 10000 && message.empty(); ++steps) {
    try {
      S.stepDynamics(5 * S.getJointVels(), .1);
    } catch (const Error& error) {
      message = error.what();
    }
  }
  EXPECT_THAT(message, testing::HasSubstr("': its motion grows without bounds at "));
  std::string time = std::to_string(.1 * steps);
  time.resize(time.find('.') + 2);
  EXPECT_THAT(message, testing::HasSubstr(" at " + time)) << "one tenth more than what was simulated";
  EXPECT_TRUE(S.getJointVels().allFinite());
}

TEST(SimulatorDynamics, NamesTheBodyThatNeedsAMass) {
  Simulator S(
      SimulatorDescription{.sceneName = "bare.ors",
                           .sceneText = "body post { fixed }\nbody stick {}\njoint hinge (post stick) {}",
                           .q = {}});
  const Eigen::VectorXd u = Eigen::VectorXd::Zero(1);
  EXPECT_REX_ERROR(S.stepDynamics(u, .01), "moves no mass: wanted some: give body 'stick' a mass");
  EXPECT_EQ(S.getJointAngles()[0], 0);
}

}  // namespace rex::simulator_dynamics_test
