#include "estimation/motion_model.h"

#include <cmath>
#include <string>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "base/derivative_check.h"
#include "base/rng.h"
#include "estimation/kalman_filter.h"
#include "support/expect_error.h"
#include "systems/mobile_bases.h"
#include "systems/planar_quadrotor.h"

namespace rex::motion_model_test {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::VectorXd;

struct Robot {
  std::string name;
  MotionModel model;
  double largestControl;
};

std::vector<Robot> robots() {
  return {{"differential drive", motionModel(DifferentialDrive{}), 20},
          {"omnidirectional", motionModel(OmnidirectionalBase{}), 20},
          {"slipping unicycle", motionModel(SlippingUnicycle{}), 2},
          {"car", motionModel(Car{2}), .8},
          {"trailer", motionModel(CarWithTrailer{{2}, 2}), .8},
          {"quadrotor", motionModel(PlanarQuadrotor{}), 4}};
}

// The second opinion on motions: what the laws of each robot say about x', written out here, in small steps
// of Runge and Kutta.
VectorXd velocityOf(const std::string& name, const VectorXd& x, const VectorXd& u) {
  const auto inWorld = [&](double ahead, double left, double turn) {
    return Vector3d(ahead * std::cos(x[2]) - left * std::sin(x[2]),
                    ahead * std::sin(x[2]) + left * std::cos(x[2]), turn);
  };
  if (name == "differential drive") return inWorld(.05 * (u[0] + u[1]) / 2, 0, .05 * (u[1] - u[0]) / .3);
  if (name == "slipping unicycle") return inWorld(.9 * u[0], -.1 * .9 * u[0] * u[1], u[1]);
  if (name == "car") return inWorld(u[0], 0, u[0] / 2 * std::tan(u[1]));
  if (name == "trailer") {
    VectorXd rate(4);
    rate << inWorld(u[0], 0, u[0] / 2 * std::tan(u[1])), u[0] / 2 * std::sin(x[2] - x[3]);
    return rate;
  }
  if (name == "omnidirectional") {
    // The rolling speed of each wheel is that of its contact point along the way it rolls.
    Eigen::Matrix3d rolling;
    for (int i = 0; i < 3; ++i) {
      const double a = M_PI / 3 + i * 2 * M_PI / 3;
      const Vector2d contact = .2 * Vector2d(std::cos(a), std::sin(a)), rolls(-std::sin(a), std::cos(a));
      rolling.row(i) << rolls[0], rolls[1], rolls.dot(Vector2d(-contact[1], contact[0]));
    }
    const Vector3d twist = rolling.inverse() * (.05 * u);
    return inWorld(twist[0], twist[1], twist[2]);
  }
  VectorXd rate(6);
  rate << x.tail<3>(), -(u[0] + u[1]) / .5 * std::sin(x[2]), (u[0] + u[1]) / .5 * std::cos(x[2]) - 9.81,
      .15 * (u[1] - u[0]) / .005;
  return rate;
}

VectorXd integrated(const std::string& name, VectorXd x, const VectorXd& u, double seconds) {
  constexpr int kSteps = 2000;
  const double h = seconds / kSteps;
  for (int i = 0; i < kSteps; ++i) {
    const VectorXd k1 = velocityOf(name, x, u), k2 = velocityOf(name, x + h / 2 * k1, u),
                   k3 = velocityOf(name, x + h / 2 * k2, u), k4 = velocityOf(name, x + h * k3, u);
    x += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
  }
  return x;
}

TEST(MotionModel, MovesAsTheLawsOfTheRobotSay) {
  Rng rng(1);
  for (const Robot& robot : robots()) {
    SCOPED_TRACE(robot.name);
    for (int i = 0; i < 6; ++i) {
      const VectorXd x = rng.uniformVector(robot.model.states, -2, 2);
      const VectorXd u = rng.uniformVector(robot.model.controls, -robot.largestControl, robot.largestControl);
      const VectorXd next = meanAfter(robot.model, x, u, .7);
      EXPECT_LT((next - integrated(robot.name, x, u, .7)).norm(), 1e-8 * (1 + next.norm()));
      // Two motions one after the other are one.
      const VectorXd half = meanAfter(robot.model, meanAfter(robot.model, x, u, .3), u, .4);
      EXPECT_LT((half - next).norm(), 1e-11 * (1 + next.norm()));
      EXPECT_EQ(meanAfter(robot.model, x, u, 0), x);
    }
  }
}

TEST(MotionModel, HasJacobiansLikeDifferences) {
  Rng rng(2);
  for (const Robot& robot : robots()) {
    SCOPED_TRACE(robot.name);
    const MotionModel& model = robot.model;
    MotionModel bare = model;
    bare.A = bare.B = {};
    for (const double scale : {0., 1e-8, .05, 1., 1.}) {
      const VectorXd x = scale * rng.uniformVector(model.states, -2, 2);
      const VectorXd u =
          scale * rng.uniformVector(model.controls, -robot.largestControl, robot.largestControl);
      const StepJacobians at = stepJacobians(model, x, u, .4);
      const JacobianCheck A =
          checkJacobian([&](const VectorXd& y) { return model.f(y, u, .4); }, at.A, x, 1e-8);
      const JacobianCheck B =
          checkJacobian([&](const VectorXd& v) { return model.f(x, v, .4); }, at.B, u, 1e-8);
      EXPECT_TRUE(A.ok) << A.message << " at scale " << scale;
      EXPECT_TRUE(B.ok) << B.message << " at scale " << scale;
      EXPECT_LT((stepJacobians(bare, x, u, .4).A - at.A).norm(), 1e-7);
      EXPECT_LT((stepJacobians(bare, x, u, .4).B - at.B).norm(), 1e-7);
    }
  }
}

TEST(DifferentialDrive, DrivesArcsAroundItsCentre) {
  const DifferentialDrive base{.wheelRadius = .1, .track = .5};
  const MotionModel model = motionModel(base);
  const Vector3d x(1, 2, .3);
  const double left = 4, right = 7, seconds = 1.5;
  // The centre lies on the axle, at the distance track / 2 (r + l) / (r - l).
  const double radius = base.track / 2 * (right + left) / (right - left);
  const Vector2d centre = x.head<2>() + radius * Vector2d(-std::sin(x[2]), std::cos(x[2]));
  const double turn = base.wheelRadius * (right - left) / base.track * seconds;
  const Vector2d end = centre + Eigen::Rotation2Dd(turn) * (x.head<2>() - centre);
  const VectorXd next = meanAfter(model, x, Vector2d(left, right), seconds);
  EXPECT_LT((next - Vector3d(end.x(), end.y(), x[2] + turn)).norm(), 1e-14);
  EXPECT_LT((meanAfter(model, x, Vector2d(-3, 3), 1) - Vector3d(1, 2, .3 + .1 * 6 / .5)).norm(), 1e-15);
  EXPECT_LT(
      (meanAfter(model, x, Vector2d(5, 5), 2) - Vector3d(1 + std::cos(.3), 2 + std::sin(.3), .3)).norm(),
      1e-15);
}

// Driven around for long, backward too, where the trailer folds and may turn over.
TEST(CarWithTrailer, FollowsItsCarForLong) {
  const MotionModel model = motionModel(CarWithTrailer{{2}, 2});
  Rng rng(4);
  for (int i = 0; i < 6; ++i) {
    const VectorXd x = rng.uniformVector(4, -2, 2);
    const Vector2d u((i % 2 == 0 ? 1 : -1) * rng.uniform(.5, 1), rng.uniform(-1.2, 1.2));
    EXPECT_LT((meanAfter(model, x, u, 12) - integrated("trailer", x, u, 12)).norm(), 1e-6) << i;
  }
}

TEST(PlanarQuadrotor, HoversAndKeepsItsEnergy) {
  const PlanarQuadrotor quadrotor;
  const MotionModel model = motionModel(quadrotor);
  VectorXd x = VectorXd::Zero(6);
  x[1] = 2;
  EXPECT_LT((meanAfter(model, x, hoverThrusts(quadrotor), 3) - x).norm(), 1e-13);
  x << 0, 2, .4, 1, 3, 5;
  const VectorXd fallen = meanAfter(model, x, Vector2d(0, 0), .8);
  EXPECT_NEAR(totalEnergy(quadrotor, fallen), totalEnergy(quadrotor, x), 1e-12);
  EXPECT_NEAR(fallen[1], 2 + 3 * .8 - 9.81 / 2 * .64, 1e-13);
  // What the rotors do to it is their power over time, by Simpson's rule.
  const Vector2d u(2, 2.1);
  constexpr int kSteps = 200;
  const double seconds = .5, h = seconds / kSteps;
  double work = 0;
  for (int i = 0; i <= kSteps; ++i) {
    const VectorXd at = meanAfter(model, x, u, i * h);
    const double power = u.sum() * (-std::sin(at[2]) * at[3] + std::cos(at[2]) * at[4]) +
                         quadrotor.arm * (u[1] - u[0]) * at[5];
    work += h / 3 * power * (i == 0 || i == kSteps ? 1 : i % 2 == 1 ? 4 : 2);
  }
  EXPECT_NEAR(totalEnergy(quadrotor, meanAfter(model, x, u, seconds)) - totalEnergy(quadrotor, x), work,
              1e-7);
}

// One noise, three ways: drawn by the simulator, moved by particles, and predicted by the Kalman filter,
// which is exact to first order.
TEST(MotionModel, ServesSimulatorsAndFiltersAlike) {
  constexpr int kCount = 20000;
  constexpr double kSeconds = .2;
  for (const Robot& robot : robots()) {
    SCOPED_TRACE(robot.name);
    const MotionModel& model = robot.model;
    Rng rng(3);
    const VectorXd mean = rng.uniformVector(model.states, -1, 1);
    const VectorXd u = rng.uniformVector(model.controls, 0, robot.largestControl);
    const Gaussian belief{mean, 1e-4 * Eigen::MatrixXd::Identity(model.states, model.states)};
    const Gaussian predicted = extendedPredict(belief, transitionModel(model, mean, u, kSeconds));
    Particles particles = sampledParticles(belief, kCount, rng), simulated = particles;
    VectorXd unused = VectorXd::Zero(kCount);
    motionProposal(model, u, kSeconds)(particles.states, unused, rng);
    for (auto x : simulated.states.colwise()) x = moved(model, x, u, kSeconds, rng);
    for (const Particles& cloud : {particles, simulated}) {
      const Gaussian moments = sampleMoments(cloud);
      for (int i = 0; i < model.states; ++i) {
        const double deviation = std::sqrt(predicted.covariance(i, i));
        EXPECT_NEAR(moments.mean[i], predicted.mean[i], 5 * deviation / std::sqrt(kCount) + 2e-4);
        for (int j = 0; j < model.states; ++j)
          EXPECT_NEAR(moments.covariance(i, j) / deviation / std::sqrt(predicted.covariance(j, j)),
                      predicted.covariance(i, j) / deviation / std::sqrt(predicted.covariance(j, j)), .05);
      }
    }
  }
}

// Errors of wheels grow with the way that they roll, so that the noise of a way does not depend on how it is
// divided.
TEST(BaseNoise, AddsUpAlongAWay) {
  const MotionModel model = motionModel(DifferentialDrive{}, {.travel = .1, .drift = {.02, .01, .03}});
  const Vector2d u(8, 9);
  const auto after = [&](int steps) {
    Gaussian belief{Vector3d(1, 0, .5), Eigen::Matrix3d::Zero()};
    for (int i = 0; i < steps; ++i)
      belief = extendedPredict(belief, transitionModel(model, belief.mean, u, 2. / steps));
    return belief;
  };
  const Gaussian fine = after(400), coarse = after(100);
  EXPECT_LT((fine.mean - coarse.mean).norm(), 1e-12);
  EXPECT_LT((fine.covariance - coarse.covariance).norm(), .01 * fine.covariance.norm());
  // Heading alone, exactly: (r / track)^2 travel^2 (|l| + |r|) t + drift^2 t.
  EXPECT_NEAR(coarse.covariance(2, 2), std::pow(.05 / .3 * .1, 2) * 17 * 2 + .03 * .03 * 2, 1e-12);
}

TEST(MotionModel, SaysWhatIsWrong) {
  const MotionModel model = motionModel(DifferentialDrive{});
  const Vector3d x(0, 0, 0);
  const Vector2d u(1, 1);
  EXPECT_REX_ERROR(meanAfter(MotionModel{}, x, u, 1), "motion model: found no function f");
  EXPECT_REX_ERROR(meanAfter(model, u, u, 1),
                   "state of a motion model: found a vector of size 2, wanted size 3");
  EXPECT_REX_ERROR(meanAfter(model, x, x, 1),
                   "control of a motion model: found a vector of size 3, wanted size 2");
  EXPECT_REX_ERROR(meanAfter(model, Vector3d(NAN, 0, 0), u, 1),
                   "state of a motion model: number 0: found nan");
  EXPECT_REX_ERROR(meanAfter(model, x, Vector2d(0, INFINITY), 1),
                   "control of a motion model: number 1: found inf");
  EXPECT_REX_ERROR(meanAfter(model, x, u, -1), "time of a motion: found -1 s");
  MotionModel broken = model;
  broken.f = [](const VectorArg&, const VectorArg& v, double) -> VectorXd { return v; };
  EXPECT_REX_ERROR(meanAfter(broken, x, u, 1), "next state of a motion model: found a vector of size 2");
  broken.f = [](const VectorArg& y, const VectorArg&, double) -> VectorXd { return y * NAN; };
  EXPECT_REX_ERROR(meanAfter(broken, x, u, 1), "next state of a motion model: number 0: found nan");
  broken = model;
  broken.noise = [](const VectorArg&, const VectorArg&, double) -> Eigen::MatrixXd {
    return -Eigen::Matrix3d::Identity();
  };
  Rng rng(1);
  EXPECT_REX_ERROR(moved(broken, x, u, 1, rng), "noise of a motion model");
  EXPECT_REX_ERROR(transitionModel(broken, x, u, 1), "noise of a motion model");
  broken = model;
  broken.A = [](const VectorArg&, const VectorArg&, double) -> Eigen::MatrixXd {
    return Eigen::Matrix2d::Identity();
  };
  EXPECT_REX_ERROR(stepJacobians(broken, x, u, 1), "df/dx of a motion model");
  EXPECT_REX_ERROR(motionModel(DifferentialDrive{.wheelRadius = 0}), "radius of wheels: found 0 m");
  EXPECT_REX_ERROR(motionModel(DifferentialDrive{.track = -1}), "track of a differential drive: found -1 m");
  EXPECT_REX_ERROR(motionModel(OmnidirectionalBase{.reach = 0}),
                   "reach of an omnidirectional base: found 0 m");
  EXPECT_REX_ERROR(motionModel(SlippingUnicycle{.slip = 1}),
                   "slip of a base: found 1, wanted a number from 0 to");
  EXPECT_REX_ERROR(motionModel(SlippingUnicycle{.drift = -1}), "drift of a slipping base: found -1 s");
  EXPECT_REX_ERROR(motionModel(Car{.wheelbase = 0}), "wheelbase of a car: found 0 m");
  EXPECT_REX_ERROR(motionModel(CarWithTrailer{.hitchLength = 0}), "hitch of a trailer: found 0 m");
  EXPECT_REX_ERROR(motionModel(DifferentialDrive{}, {.travel = -1}), "noise of travel: found -1");
  EXPECT_REX_ERROR(motionModel(DifferentialDrive{}, {.drift = {0, -1, 0}}),
                   "drift of a base: number 1: found -1");
  EXPECT_REX_ERROR(planarMotion({}), "twist of a base: found no function");
  EXPECT_REX_ERROR(motionModel(PlanarQuadrotor{.mass = 0}), "mass of a quadrotor: found 0");
  EXPECT_REX_ERROR(motionModel(PlanarQuadrotor{.inertia = 0}), "inertia of a quadrotor: found 0");
  EXPECT_REX_ERROR(motionModel(PlanarQuadrotor{.arm = 0}), "arm of a quadrotor: found 0 m");
  EXPECT_REX_ERROR(motionModel(PlanarQuadrotor{.gust = -1}), "gust: found -1");
  EXPECT_REX_ERROR(motionModel(PlanarQuadrotor{.tumble = -1}), "tumble: found -1");
  EXPECT_REX_ERROR(totalEnergy(PlanarQuadrotor{}, x),
                   "state of a quadrotor: found a vector of size 3, wanted size 6");
}

}  // namespace rex::motion_model_test
