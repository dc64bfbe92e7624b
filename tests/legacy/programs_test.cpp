// Programs in the style of older course material, one for each exercise folder of the script. What they end
// with is compared with what the exercise's own numbers say.
#include <filesystem>
#include <fstream>
#include <vector>

#include <gtest/gtest.h>

#include "legacy/legacy.h"
#include "support/expect_error.h"
#include "support/fresh_folder.h"
#include "support/needs_gnuplot.h"
#include "support/needs_osmesa.h"

namespace {

// 12.3.2: errors of full steps are known, .1750, .0297, .0015 and 4e-6.
TEST(Program01, ReachesWithTheRightHand) {
  Simulator S("man.ors");
  arr q, y, y_target = ARR(-0.2, -0.4, 1.1), J, W;
  W.setDiag(1., S.getJointDimension());
  S.getJointAngles(q);
  arr errors;
  for (uint i = 0; i < 4; i++) {
    S.kinematicsPos(y, "handR");
    S.jacobianPos(J, "handR");
    q += inverse(~J * J + 1e-4 * W) * ~J * (y_target - y);
    S.setJointAngles(q);
    S.kinematicsPos(y, "handR");
    errors.append(length(y - y_target));
  }
  EXPECT_LT(maxDiff(errors, ARR(.1750, .0297, .0015, 4e-6)), 6e-5) << errors;
}

TEST(Program01, KnowsPointsAndVectorsOfABody) {
  Simulator S("man.ors");
  arr origin, point, direction, J, rel = ARR(0, 0, .1), x = ARR(1, 0, 0);
  S.kinematicsPos(origin, "handL");
  S.kinematicsPos(point, "handL", &rel);
  S.kinematicsVec(direction, "handL");
  EXPECT_LT(maxDiff(point, origin + .1 * direction), 1e-12);
  S.jacobianPos(J, "handL", &rel);
  EXPECT_EQ(J.d0, 3u);
  EXPECT_EQ(J.d1, S.getJointDimension());
  S.kinematicsVec(point, "handL", &x);
  EXPECT_NEAR(scalarProduct(point, direction), 0, 1e-12);
  S.jacobianVec(J, "handL", &x);
  EXPECT_LT(length(~J * point), 1.);  // a unit vector turns at right angles to itself
  arr com;
  S.kinematicsCOM(com);
  S.jacobianCOM(J);
  EXPECT_EQ(com.N, 2u);
  EXPECT_EQ(J.d0, 2u);
  arr wrong = ARR(1, 2);
  EXPECT_REX_ERROR(S.kinematicsPos(point, "handL", &wrong), "rel");
}

// Two tasks: the peg goes to the hole, and nothing touches.
TEST(Program02, PutsThePegIntoTheHole) {
  Simulator S("pegInAHole.ors");
  S.setContactMargin(.02);
  arr q, y, J, W, Phi, PhiJ;
  W.setDiag(1., S.getJointDimension());
  S.getJointAngles(q);
  arr hole, start;
  S.kinematicsPos(hole, "hole");
  S.kinematicsPos(start, "peg");
  for (uint i = 0; i < 1000; i++) {
    Phi.clear();
    PhiJ.clear();
    S.kinematicsPos(y, "peg");
    S.jacobianPos(J, "peg");
    Phi.append(10. * (y - start - (i + 1) / 1000. * (hole - start)));
    PhiJ.append(10. * J);
    S.kinematicsContacts(y);
    S.jacobianContacts(J);
    Phi.append(100. * y);
    PhiJ.append(100. * J);
    q -= inverse(~PhiJ * PhiJ + W) * ~PhiJ * Phi;
    S.setJointAngles(q);
  }
  S.kinematicsPos(y, "peg");
  EXPECT_LT(length(y - hole), .1 * length(start - hole));
}

// 12.6.2: computed torque holds the arm after a kick.
TEST(Program03, HoldsTheArmSteady) {
  Simulator S("pegArm.ors");
  arr q, qdot, M, F, u;
  double lambda = .2, xi = 1;
  for (uint t = 0; t < 300; t++) {
    if (t == 100) {
      S.getJointAnglesAndVels(q, qdot);
      qdot += 1.;
      S.setJointAnglesAndVels(q, qdot);
    }
    S.getJointAnglesAndVels(q, qdot);
    S.getDynamics(M, F);
    u = M * (-1. / MT::sqr(lambda) * q - 2. * xi / lambda * qdot) + F;
    S.stepDynamics(u, .01);
  }
  S.getJointAnglesAndVels(q, qdot);
  EXPECT_LT(length(q), 2e-3);
}

TEST(Program03, KeepsTheEnergyOfTheFreeSwing) {
  Simulator S("pegArm.ors");
  S.setDynamicSimulationNoise(0);
  arr q, u;
  S.getJointAngles(q);
  q = .5;
  S.setJointAngles(q);
  u.resize(q.N);
  const double energy = S.getEnergy();
  for (uint t = 0; t < 100; t++) S.stepDynamics(u, .001);
  EXPECT_NEAR(S.getEnergy(), energy, 1e-5);
  S.setDynamicGravity(false);
  S.setDynamicsSimulationNoise(1);
  S.stepDynamics(u, .01);
  EXPECT_GT(fabs(S.getEnergy() - energy), 1e-3);
}

// 12.7.1: a tree grows through the joint space; every node keeps clear of the world, one step from its
// parent.
TEST(Program04, GrowsATree) {
  Simulator S("pegInAHole.ors");
  S.setContactMargin(.02);
  rnd.seed(1);
  const double stepSize = .1;
  arr nodes, parents, q, y,
      q_target = ARR(0.945499, 0.431195, -1.97155, 0.623969, 2.22355, -0.665206, -1.48356);
  nodes.append(~q_target);
  parents.append(0);
  for (uint i = 0; i < 3000; i++) {
    if (rnd.uni() < .1)
      q = zeros(7);
    else {
      q.resize(7);
      rndUniform(q, -2 * M_PI, 2 * M_PI);
    }
    uint nearest = 0;
    for (uint k = 1; k < nodes.d0; k++)
      if (sqrDistance(nodes[k], q) < sqrDistance(nodes[nearest], q)) nearest = k;
    q = nodes[nearest] + stepSize / length(q - nodes[nearest]) * (q - nodes[nearest]);
    S.setJointAngles(q);
    S.kinematicsContacts(y);
    if (y(0) < .5) {
      nodes.append(q);
      parents.append(nearest);
    }
  }
  ASSERT_GT(nodes.d0, 20u);
  for (uint k = 1; k < nodes.d0; k++)
    ASSERT_NEAR(length(nodes[k] - nodes[uint(parents(k))]), stepSize, 1e-12);
}

// 12.9.1: particles that are weighted by what the car sees stay with it, others lose it.
double particleFilterError(bool weigh) {
  CarSimulator S;
  rnd.seed(2);
  arr particles(100, 3), truth, y, y_particle, u = ARR(.1, .2);
  double error = 0;
  for (uint t = 0; t < 100; t++) {
    S.step(u);
    S.getRealNoisyObservation(y);
    arr weights(particles.d0);
    for (uint i = 0; i < particles.d0; i++) {
      arr x = particles[i];
      x += ARR(u(0) * cos(x(2)), u(0) * sin(x(2)), u(0) / 2. * tan(u(1)));
      rndGauss(x, .03, true);
      particles[i]() = x;
      S.getMeanObservationAtState(y_particle, x);
      weights(i) = weigh ? exp(-.5 * sqrDistance(y, y_particle) / MT::sqr(.5)) : 1;
    }
    weights /= sum(weights);
    arr drawn(particles.d0, 3);
    double position = rnd.uni(), passed = weights(0);
    for (uint i = 0, k = 0; i < particles.d0; i++) {
      while (passed * particles.d0 < position + i && k + 1 < weights.N) passed += weights(++k);
      drawn[i] = particles[k];
    }
    particles = drawn;
    S.getState(truth);
    error += length(~particles * (1. / particles.d0 * (zeros(particles.d0) + 1.)) - truth) / 100;
  }
  return error;
}

TEST(Program05, FollowsTheCarByWhatItSees) {
  const double seeing = particleFilterError(true), blind = particleFilterError(false);
  EXPECT_LT(seeing, .3);
  EXPECT_GT(blind, 2 * seeing);
}

// 12.9.2 and 12.13.1, one filter on the car and one with the landmarks in its state.
TEST(Program06, FollowsTheCarByAKalmanFilter) {
  CarSimulator S;
  arr x = zeros(3), P = .1 * eye(3), A = eye(3), Q = MT::sqr(.03) * eye(3), C, y, y_mean, truth,
      u = ARR(.1, .2);
  double error = 0;
  for (uint t = 0; t < 100; t++) {
    S.step(u);
    S.getRealNoisyObservation(y);
    A(0, 2) = -u(0) * sin(x(2));
    A(1, 2) = u(0) * cos(x(2));
    x += ARR(u(0) * cos(x(2)), u(0) * sin(x(2)), u(0) / 2. * tan(u(1)));
    P = A * P * ~A + Q;
    S.getObservationJacobian(C, x);
    S.getMeanObservationAtState(y_mean, x);
    arr K = P * ~C * inverse(C * P * ~C + MT::sqr(.5) * eye(y.N));
    x += K * (y - y_mean);
    P = P - K * C * P;
    S.getState(truth);
    error += length(x - truth) / 100;
  }
  EXPECT_LT(error, .25);
}

TEST(Program06, KnowsHowObservationsDependOnLandmarks) {
  CarSimulator S;
  arr landmarks, stacked, C, c, J, y, y_there, x = ARR(1, 2, .3);
  S.getLandmarks(landmarks);
  for (uint i = 0; i < landmarks.d0; i++) stacked.append(landmarks[i]);
  S.getMeanObservationAtState(y, x);
  S.getMeanObservationAtStateAndLandmarks(y_there, x, stacked);
  EXPECT_LT(maxDiff(y, y_there), 1e-12);
  S.getLinearObservationModelAtState(C, c, x);
  EXPECT_LT(maxDiff(y, C * stacked + c), 1e-12);
  S.getObservationJacobianAtStateAndLandmarks(J, x, stacked);
  EXPECT_EQ(J.d0, y.N);
  EXPECT_EQ(J.d1, 3 + stacked.N);
  for (uint i = 0; i < C.d0; i++)
    for (uint j = 0; j < C.d1; j++) EXPECT_NEAR(J(i, 3 + j), C(i, j), 1e-12);
}

// 12.11: the published equation, iterated; the gains are those of the errata, and hold the pole.
TEST(Program07, BalancesTheCartPole) {
  double g = 9.8, c1 = .5, c2 = .5, l = 4. / 3 - c2;
  arr A(4, 4), B(4, 1), Q = diag(ARR(1, 0, 1, 0)), P, K;
  A(0, 1) = A(2, 3) = 1;
  A(1, 2) = -c2 * g / l;
  A(3, 2) = g / l;
  B(1, 0) = c1 + c1 * c2 / l;
  B(3, 0) = -c1 / l;
  P = Q;
  for (uint k = 0; k < 200000; k++) P += 1e-3 * (~A * P + P * A - P * B * ~B * P + Q);
  K = ~B * P;
  EXPECT_LT(maxDiff(-1. * K[0], ARR(1, 2.60879, 52.9484, 16.5952)), 1e-3) << K;
  CartPole S;
  for (uint t = 0; t < 1000; t++) {
    S.step(-(K * S.x).scalar());
    ASSERT_LT(fabs(S.x(2)), 1.) << t;
  }
}

// 12.12: the model of the racer agrees with its motion.
TEST(Program09, KnowsTheDynamicsOfTheRacer) {
  Racer R;
  arr M, F, B, y;
  R.getDynamics(M, F, B);
  const double u = .01;
  const arr acceleration = inverse(M) * (u * B - F);
  R.getObservation(y);
  EXPECT_EQ(y.N, 4u);
  arr rates;
  for (uint run = 0; run < 400; run++) {  // noise has no mean
    R.q = ARR(0, .01);
    R.q_dot = zeros(2);
    R.stepDynamics(u);
    rates.append(~R.q_dot);
  }
  const arr mean = ~rates * ((zeros(400) + 1.) / 400.);
  EXPECT_LT(maxDiff(mean, .01 * acceleration), 4 * .01 / 20 + .02 * length(acceleration) * .01);
}

class PicturesOfPrograms : public ::testing::Test {
 protected:
  void SetUp() override { std::filesystem::current_path(rex::freshFolderOfTest("legacy")); }
  void TearDown() override { std::filesystem::current_path(before_); }

  std::filesystem::path before_ = std::filesystem::current_path();
};

// 12.5.1: the critically damped point mass is at its goal after ten time constants, and is drawn.
TEST_F(PicturesOfPrograms, ShowThePointMass) {
  REX_NEEDS_GNUPLOT();
  arr q_trajectory, both;
  double q = 0, q_dot = 0, m = 3.456, lambda = .1, tau = .01;
  for (uint t = 0; t < 100; t++) {
    double u = m / MT::sqr(lambda) * (1 - q) - 2 * m / lambda * q_dot;
    q += tau * q_dot;
    q_dot += tau * u / m;
    q_trajectory.append(q);
    both.append(~ARR(tau * t, q));
  }
  EXPECT_NEAR(q_trajectory.last(), 1, 1e-3);
  gnuplot(q_trajectory);
  MT::wait();
  gnuplot(both);
  gnuplot(eye(3));
  MT::wait(1.);
  for (const char* name : {"gnuplot.png", "gnuplot-2.png", "gnuplot-3.png"})
    EXPECT_GT(std::filesystem::file_size(name), 2000u) << name;
  EXPECT_REX_ERROR(gnuplot(arr()), "nothing to draw");
}

TEST_F(PicturesOfPrograms, ShowWhatWindowsShowed) {
  REX_NEEDS_OSMESA();
  Simulator S("pegArm.ors");
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  for (uint i = 0; i < 23; i++) S.watch(i == 0, i == 0 ? "start" : nullptr);
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "start\n");
  EXPECT_EQ(testing::internal::GetCapturedStderr(),
            "watch: 20 pictures have been drawn; later calls draw none\n");
  EXPECT_GT(std::filesystem::file_size("watch-01.png"), 2000u);
  EXPECT_TRUE(std::filesystem::exists("watch-20.png"));
  EXPECT_FALSE(std::filesystem::exists("watch-21.png"));
}

TEST(Parameters, ComeFromTheCommandLine) {
  std::vector<std::string> words{"x.exe", "-mode", "3", "-tau", ".5", "-name", "arm", "-loud", "0", "-last"};
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  MT::initCmdLine(int(argv.size()), argv.data());
  EXPECT_EQ(MT::getParameter<int>("mode", 2), 3);
  EXPECT_EQ(MT::getParameter<int>("other", 2), 2);
  EXPECT_EQ(MT::getParameter<double>("tau", 1), .5);
  EXPECT_EQ(MT::getParameter<std::string>("name", "none"), "arm");
  EXPECT_FALSE(MT::getParameter<bool>("loud", true));
  EXPECT_REX_ERROR(MT::getParameter<int>("tau", 1), "parameter -tau: found '.5', wanted a whole number");
  EXPECT_REX_ERROR(MT::getParameter<double>("name", 1), "parameter -name: found 'arm', wanted a number");
  EXPECT_REX_ERROR(MT::getParameter<int>("last", 1),
                   "parameter -last: found nothing after it, wanted its value");
}

TEST(Helpers, AreThere) {
  EXPECT_EQ(MT::sqr(-3), 9);
  EXPECT_EQ(MT::sign(-2), -1);
  EXPECT_EQ(MT::sign(0), 0);
  SearchCMA cma;
  arr samples, values, best, mean;
  cma.init(ARR(1, 1), -1, -1, .3);
  for (uint t = 0; t < 60; t++) {
    cma.step(samples, values);
    for (uint i = 0; i < samples.d0; i++) values(i) = sumOfSqr(samples[i]);
  }
  cma.getBestSample(best);
  cma.getMean(mean);
  EXPECT_LT(length(best), 1e-3);
  EXPECT_LT(length(mean), 1e-2);
}

}  // namespace
