#include "locomotion/compass_gait.h"

#include <array>
#include <cmath>

#include <Eigen/Dense>

#include "base/derivative_check.h"
#include "base/rng.h"
#include "support/expect_error.h"

namespace rex::compass_gait_test {

using Eigen::Matrix4d;
using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::Vector4d;
using Eigen::VectorXd;

const Vector4d kGait(.218668802939, -.323388558059, -1.091826677490, -.377181558403);

CompassGait randomWalker(Rng& rng) {
  return {.a = rng.uniform(0, 1),
          .b = rng.uniform(.2, 1),
          .legMass = rng.uniform(.1, 5),
          .hipMass = rng.uniform(.1, 5),
          .slope = rng.uniform(-.1, .1),
          .g = rng.uniform(1, 10)};
}

// Masses and places of the walker, seen from a foot at `foot`: hip, stance leg, swing leg, swing foot.
struct Places {
  Vector2d hip, stance, swing, swingFoot;
};
Places places(const CompassGait& w, const Vector2d& foot, double thetaStance, double thetaSwing) {
  const Vector2d up(-std::sin(thetaStance), std::cos(thetaStance));
  const Vector2d down(std::sin(thetaSwing), -std::cos(thetaSwing));
  const Vector2d hip = foot + (w.a + w.b) * up;
  return {hip, foot + w.a * up, hip + w.b * down, hip + (w.a + w.b) * down};
}

// Their derivatives by (foot x, foot y, both angles): 8 x 4.
MatrixXd placesJacobian(const CompassGait& w, const Vector2d& angles) {
  const VectorFunction f = [&](const VectorXd& q) {
    const Places p = places(w, q.head<2>(), q[2], q[3]);
    VectorXd all(8);
    all << p.hip, p.stance, p.swing, p.swingFoot;
    return all;
  };
  return numericJacobian(f, Vector4d(0, 0, angles[0], angles[1]));
}

VectorXd masses(const CompassGait& w) {
  VectorXd m(8);
  m << w.hipMass, w.hipMass, w.legMass, w.legMass, w.legMass, w.legMass, 0, 0;
  return m;
}

double cross(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

TEST(CompassGait, EnergyIsThatOfThreeMasses) {
  Rng rng(1);
  for (int i = 0; i < 20; ++i) {
    const CompassGait w = randomWalker(rng);
    const Vector4d x = rng.normalVector(4);
    const VectorXd v = placesJacobian(w, x.head<2>()).rightCols<2>() * x.tail<2>();
    const Places p = places(w, Vector2d::Zero(), x[0], x[1]);
    const double kinetic = v.dot(masses(w).cwiseProduct(v)) / 2;
    const double potential = w.g * (w.hipMass * p.hip.y() + w.legMass * (p.stance.y() + p.swing.y()));
    EXPECT_NEAR(w.energy(x), kinetic + potential, 1e-8 * (1 + std::abs(kinetic)));
  }
}

// The equation of motion by the laws of Newton for masses on a moving foot that is held in its place: the
// force there is the ground's.
TEST(CompassGait, MovesAsThreeMassesDo) {
  Rng rng(2);
  for (int i = 0; i < 20; ++i) {
    const CompassGait w = randomWalker(rng);
    const Vector4d x = rng.normalVector(4), d = w.derivative(x);
    EXPECT_EQ((d.head<2>() - x.tail<2>()).norm(), 0);
    const auto velocities = [&](const VectorXd& t) {
      const Vector2d angles = x.head<2>() + t[0] * x.tail<2>() + t[0] * t[0] / 2 * d.tail<2>();
      return VectorXd(placesJacobian(w, angles).rightCols<2>() * (x.tail<2>() + t[0] * d.tail<2>()));
    };
    const VectorXd acceleration = numericJacobian(velocities, VectorXd::Zero(1), .02);
    VectorXd forces = masses(w).cwiseProduct(acceleration);
    for (const int y : {1, 3, 5}) forces[y] += masses(w)[y] * w.g;
    const MatrixXd J = placesJacobian(w, x.head<2>());
    const double scale = forces.norm() + 1;
    EXPECT_LT((J.rightCols<2>().transpose() * forces).norm(), 1e-5 * scale);
    const Vector2d ground = J.leftCols<2>().transpose() * forces, found = w.groundForce(x);
    const Vector2d downhill(std::cos(w.slope), -std::sin(w.slope)),
        normal(std::sin(w.slope), std::cos(w.slope));
    EXPECT_LT((found - Vector2d(downhill.dot(ground), normal.dot(ground))).norm(), 1e-5 * scale);
  }
}

TEST(CompassGait, KeepsItsEnergyBetweenImpacts) {
  const CompassGait walker;
  const double start = walker.energy(kGait);
  const WalkerStep step = walker.step(kGait);
  ASSERT_EQ(step.status, StepStatus::kStepped);
  EXPECT_NEAR(walker.energy(step.before), start, 1e-12 * start);
  EXPECT_LT(walker.energy(step.after), start + 10);
  // Over a step of the gait the impact takes what the slope gave.
  const Vector2d foot = places(walker, Vector2d::Zero(), step.before[0], step.before[1]).swingFoot;
  const double given = -(walker.hipMass + 2 * walker.legMass) * walker.g * foot.y();
  const double loss = walker.energy(step.before) + given - walker.energy(step.after);
  EXPECT_NEAR(loss, given, 1e-8);
  EXPECT_NEAR(foot.y(), -std::tan(walker.slope) * foot.x(), 1e-14);
}

// The impact as in slide 11:22: impulses on a robot that stands nowhere, so that the foot that comes down
// rests and nothing acts on the other (Westervelt, Grizzle, Koditschek 2003).
TEST(CompassGait, ImpactIsThatOfImpulsesOnAFreeRobot) {
  Rng rng(3);
  for (int i = 0; i < 20; ++i) {
    const CompassGait w = randomWalker(rng);
    Vector4d x = rng.normalVector(4);
    x[0] *= .3;
    x[1] = -2 * w.slope - x[0];
    const MatrixXd J = placesJacobian(w, x.head<2>());
    MatrixXd kkt = MatrixXd::Zero(6, 6);
    kkt.topLeftCorner(4, 4) = J.transpose() * masses(w).asDiagonal() * J;
    kkt.topRightCorner(4, 2) = J.bottomRows(2).transpose();
    kkt.bottomLeftCorner(2, 4) = J.bottomRows(2);
    VectorXd wanted = VectorXd::Zero(6);
    wanted.head(4) = kkt.topLeftCorner(4, 4) * Vector4d(0, 0, x[2], x[3]);
    const VectorXd rates = kkt.fullPivLu().solve(wanted);
    const Vector4d after = w.impact(x);
    EXPECT_EQ(after[0], x[1]);
    EXPECT_EQ(after[1], x[0]);
    EXPECT_NEAR(after[2], rates[3], 1e-6 * x.norm());
    EXPECT_NEAR(after[3], rates[2], 1e-6 * x.norm());
    // In words: the angular momentum of all about the foot that comes down.
    const auto momentum = [&](const Vector4d& at, const Vector2d& foot, const Vector2d& about) {
      const VectorXd v = placesJacobian(w, at.head<2>()).rightCols<2>() * at.tail<2>();
      const Places p = places(w, foot, at[0], at[1]);
      return w.hipMass * cross(p.hip - about, v.segment<2>(0)) +
             w.legMass * (cross(p.stance - about, v.segment<2>(2)) + cross(p.swing - about, v.segment<2>(4)));
    };
    const Vector2d newFoot = places(w, Vector2d::Zero(), x[0], x[1]).swingFoot;
    EXPECT_NEAR(momentum(x, Vector2d::Zero(), newFoot), momentum(after, newFoot, newFoot),
                1e-7 * (1 + std::abs(momentum(x, Vector2d::Zero(), newFoot))));
    EXPECT_LE(w.energy(after) - w.energy(x) + (w.hipMass + 2 * w.legMass) * w.g * newFoot.y(), 1e-9);
  }
}

TEST(CompassGait, DerivativesAreExact) {
  Rng rng(4);
  for (int i = 0; i < 20; ++i) {
    const CompassGait w = randomWalker(rng);
    const Vector4d x = rng.normalVector(4);
    const JacobianCheck rate = checkJacobian([&](const VectorXd& y) { return VectorXd(w.derivative(y)); },
                                             w.derivativeJacobian(x), x, 1e-5);
    EXPECT_TRUE(rate.ok) << rate.message;
    const JacobianCheck impact =
        checkJacobian([&](const VectorXd& y) { return VectorXd(w.impact(y)); }, w.impactJacobian(x), x, 1e-6);
    EXPECT_TRUE(impact.ok) << impact.message;
  }
  const CompassGait walker;
  const WalkerStepJacobian step = walker.stepJacobian(kGait);
  ASSERT_EQ(step.step.status, StepStatus::kStepped);
  EXPECT_LT((step.step.after - walker.step(kGait).after).norm(), 1e-13);
  const MatrixXd numeric =
      numericJacobian([&](const VectorXd& y) { return VectorXd(walker.step(y).after); }, kGait, 1e-3);
  EXPECT_LT((step.J - numeric).cwiseAbs().maxCoeff(), 1e-6 * numeric.cwiseAbs().maxCoeff());
}

// The equations of Garcia et al. in their own coordinates.
TEST(SimplestWalker, IsThatOfThePaper) {
  constexpr double kSlope = .009;
  const CompassGait walker = simplestWalker(kSlope);
  const auto paper = [](const Vector4d& y) {  // theta, phi, their rates
    const double turn = std::sin(y[0] - kSlope);
    return Vector4d(y[2], y[3], turn,
                    turn + y[2] * y[2] * std::sin(y[1]) - std::cos(y[0] - kSlope) * std::sin(y[1]));
  };
  const auto ours = [](const Vector4d& y) {
    return Vector4d(y[0] - kSlope, y[0] - kSlope - y[1], y[2], y[2] - y[3]);
  };
  Rng rng(5);
  for (int i = 0; i < 10; ++i) {
    const Vector4d y = rng.normalVector(4), d = walker.derivative(ours(y));
    EXPECT_NEAR(d[2], paper(y)[2], 1e-14);
    EXPECT_NEAR(d[2] - d[3], paper(y)[3], 1e-13);
    const double theta = .2 * rng.normal(), rate = rng.normal(), keeps = std::cos(2 * theta);
    const Vector4d after = walker.impact(ours({theta, 2 * theta, rate, rng.normal()}));
    EXPECT_LT((after - ours({-theta, -2 * theta, keeps * rate, keeps * (1 - keeps) * rate})).norm(), 1e-14);
  }
}

TEST(CompassGait, SaysHowItFails) {
  const CompassGait walker;
  const auto from = [&](double theta, double rate, double swingRate, double limit = 10) {
    return walker.step({theta, -theta - 2 * walker.slope, rate, swingRate}, limit);
  };
  const WalkerStep slow = from(.22, -.3, -.3);
  EXPECT_EQ(slow.status, StepStatus::kFellBackward) << slow.message;
  EXPECT_NEAR(slow.before[0] + walker.slope, M_PI / 2, 1e-12);
  const WalkerStep stuck = from(.22, -1, 1.5);
  EXPECT_EQ(stuck.status, StepStatus::kFootStuck);
  EXPECT_EQ(stuck.message, "the rear foot did not lift after 0 s");
  const WalkerStep brief = from(.2186, -1.09, -.377, .1);
  EXPECT_EQ(brief.status, StepStatus::kTimeLimit);
  EXPECT_EQ(brief.message, "no foot came down after 0.1 s");
  EXPECT_EQ(walker.step({-2, 0, 0, 0}).status, StepStatus::kFellForward);
  EXPECT_EQ(walker.step({2, 0, 0, 0}).status, StepStatus::kFellBackward);
  // Its swing leg swings on and on.
  const WalkerStep forward = walker.step({-.3, -.9, -1, -3});
  EXPECT_EQ(forward.status, StepStatus::kFellForward) << forward.message;
  EXPECT_NEAR(forward.before[0] + walker.slope, -M_PI / 2, 1e-12);
  EXPECT_THAT(forward.message, testing::StartsWith("fell forward after "));
}

TEST(CompassGait, NamesWhatIsWrong) {
  const auto with = [](auto change) {
    CompassGait walker;
    change(walker);
    return walker.step(kGait);
  };
  EXPECT_REX_ERROR(with([](CompassGait& w) { w.a = -1; }), "compass gait: length a: found -1");
  EXPECT_REX_ERROR(with([](CompassGait& w) { w.b = 0; }), "compass gait: length b: found 0");
  EXPECT_REX_ERROR(with([](CompassGait& w) { w.legMass = -1; }), "compass gait: mass of a leg: found -1");
  EXPECT_REX_ERROR(with([](CompassGait& w) { w.hipMass = 0; }), "compass gait: mass of the hip: found 0");
  EXPECT_REX_ERROR(with([](CompassGait& w) { w.g = 0; }), "compass gait: g: found 0");
  EXPECT_REX_ERROR(with([](CompassGait& w) { w.slope = 1; }),
                   "compass gait: slope: found 1, wanted an angle");
  EXPECT_REX_ERROR(CompassGait{}.energy({0, 0, NAN, 0}), "compass gait: state: number 2: found nan");
  EXPECT_REX_ERROR(CompassGait{}.step(kGait, 0), "compass gait: time limit: found 0");
}

}  // namespace rex::compass_gait_test
