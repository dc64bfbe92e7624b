#include "systems/raibert_hopper.h"

#include <cmath>

#include "base/derivative_check.h"
#include "base/rng.h"
#include "support/expect_error.h"
#include "support/runge_kutta.h"

namespace rex::raibert_hopper_test {

using Eigen::VectorXd;
using Vector6d = Eigen::Matrix<double, 6, 1>;

// Without loss and control.
const RaibertHopper kLossless{.damping = 0};
const RaibertGains kNone{.height = 0, .placement = 0, .attitude = 0, .rate = 0};

HopperApex after(int hops, const RaibertGains& gains, const HopperCommand& command, HopperApex apex) {
  for (int i = 0; i < hops; ++i) {
    const HopperHop next = hop({}, gains, command, apex);
    EXPECT_EQ(next.status, HopStatus::kHopped) << i << ": " << next.message;
    apex = next.apex;
  }
  return apex;
}

// Left alone, the mass hops as a runner with a leg of the same angle does, and the body turns on.
TEST(RaibertHopper, IsASpringLegWhereNothingControlsIt) {
  const HopperApex apex{.height = 1.4, .speed = 1.5, .pitch = 0.1, .rate = 0.3, .thrust = 0};
  const HopperHop one = hop(kLossless, kNone, {}, apex);
  const SpringLeg leg{
      .mass = kLossless.mass, .stiffness = kLossless.stiffness, .angle = M_PI / 2 - one.legAngle};
  const Hop runner = leg.hop({.height = 1.4, .speed = 1.5});
  ASSERT_EQ(one.status, HopStatus::kHopped) << one.message;
  EXPECT_NEAR(one.apex.height, runner.apex.height, 1e-10);
  EXPECT_NEAR(one.apex.speed, runner.apex.speed, 1e-10);
  EXPECT_NEAR(one.apex.stanceTime, runner.stanceTime, 1e-10);
  EXPECT_NEAR(one.time, runner.time, 1e-10);
  EXPECT_NEAR(one.apex.pitch, 0.1 + 0.3 * one.time, 1e-12);
}

// A thrust gives the energy by which it presses the spring.
TEST(RaibertHopper, GainsTheEnergyOfItsThrust) {
  const HopperApex apex{.height = 1.2, .speed = 0.5, .thrust = 0.04};
  const HopperHop one = hop(kLossless, kNone, {}, apex);
  ASSERT_EQ(one.status, HopStatus::kHopped) << one.message;
  const auto energy = [&](const HopperApex& at) {
    return kLossless.mass * (at.speed * at.speed / 2 + kLossless.g * at.height);
  };
  const double shortest = one.stance.col(1).head<2>().norm(), before = 1 - shortest, then = before + 0.04;
  EXPECT_NEAR(energy(one.apex) - energy(apex), kLossless.stiffness / 2 * (then * then - before * before),
              1e-9);
}

// On the ground only gravity turns the whole about the foot, whatever leg and hip do: angular momentum is the
// integral of its torque. And the stance is that of a fixed step of order four.
TEST(RaibertHopper, TurnsAboutItsFootByGravityAlone) {
  const RaibertHopper hopper;
  const RaibertGains gains;
  const HopperApex apex{.height = 1.3, .speed = 1, .pitch = 0.2, .rate = -0.5, .thrust = 0.05};
  const HopperHop one = hop(hopper, gains, {.height = 1.3}, apex);
  ASSERT_EQ(one.status, HopStatus::kHopped) << one.message;
  double thrust = 0, impulse = 0;
  const auto rate = [&](const Vector6d& x) {
    const double length = x.head<2>().norm(), torque = -gains.attitude * x[2] - gains.rate * x[5];
    const double push =
        hopper.stiffness * (1 + thrust - length) - hopper.damping * x.head<2>().dot(x.segment<2>(3)) / length;
    Vector6d d;
    d << x[3], x[4], x[5], (push * x[0] / length + torque * x[1] / length / length) / hopper.mass,
        (push * x[1] / length - torque * x[0] / length / length) / hopper.mass - hopper.g,
        torque / hopper.inertia;
    return d;
  };
  const auto momentum = [&](const Vector6d& x) {
    return hopper.mass * (x[0] * x[4] - x[1] * x[3]) + hopper.inertia * x[5];
  };
  constexpr int kSteps = 20000;
  const double dt = one.apex.stanceTime / kSteps;
  Vector6d x = one.stance.col(0);
  bool isExtending = false;
  for (int i = 0; i < kSteps; ++i) {
    if (!isExtending && x.head<2>().dot(x.segment<2>(3)) >= 0) {
      isExtending = true, thrust = one.apex.thrust;
      EXPECT_LT((x - one.stance.col(1)).norm(), 1e-3);
    }
    impulse -= dt * hopper.mass * hopper.g * x[0];
    x = rungeKutta4Step(rate, x, dt);
  }
  EXPECT_TRUE(isExtending);
  EXPECT_LT((x - one.stance.col(2)).norm(), 2e-3);
  EXPECT_NEAR(momentum(one.stance.col(2)) - momentum(one.stance.col(0)), impulse, 1e-3);
}

TEST(RaibertHopper, DoesWhatItIsTold) {
  const HopperApex there = after(60, {}, {.height = 1.4, .speed = 1.5}, {});
  EXPECT_NEAR(there.height, 1.4, 0.01);
  EXPECT_NEAR(there.speed, 1.5, 0.2);
  EXPECT_NEAR(there.pitch, 0, 0.01);
  const HopperApex back = after(60, {}, {.height = 1.25, .speed = -1}, there);
  EXPECT_NEAR(back.height, 1.25, 0.01);
  EXPECT_NEAR(back.speed, -1, 0.15);
  EXPECT_NEAR(back.pitch, 0, 0.01);
}

TEST(RaibertHopper, RecoversFromPushes) {
  for (const std::uint64_t seed : {1, 2, 3, 4, 5, 6, 7, 8, 9, 10}) {
    Rng rng(seed);
    const HopperApex pushed{.height = rng.uniform(1.2, 1.5),
                            .speed = rng.uniform(-1, 1),
                            .pitch = rng.uniform(-0.3, 0.3),
                            .rate = rng.uniform(-0.5, 0.5)};
    const HopperApex then = after(60, {}, {}, pushed);
    EXPECT_NEAR(then.height, 1.3, 0.01) << seed;
    EXPECT_LT(std::abs(then.speed) + std::abs(then.pitch) + std::abs(then.rate), 0.01) << seed;
  }
}

// The largest modulus of the map from apex to apex, without x, about hopping on the spot.
double growth(const RaibertGains& gains) {
  const HopperApex still = after(200, {}, {}, {});
  const VectorFunction map = [&](const VectorXd& y) {
    const HopperApex from{
        .height = y[0], .speed = y[1], .pitch = y[2], .rate = y[3], .thrust = y[4], .stanceTime = y[5]};
    const HopperApex to = hop({}, gains, {}, from).apex;
    return (VectorXd(6) << to.height, to.speed, to.pitch, to.rate, to.thrust, to.stanceTime).finished();
  };
  const VectorXd at = (VectorXd(6) << still.height, 0, 0, 0, still.thrust, still.stanceTime).finished();
  return Eigen::EigenSolver<Eigen::MatrixXd>(numericJacobian(map, at), false)
      .eigenvalues()
      .cwiseAbs()
      .maxCoeff();
}

// Raibert's point: three simple controllers are enough, and none of them can be left out.
TEST(RaibertHopper, NeedsEachOfItsControllers) {
  EXPECT_LT(growth({}), 0.95);
  EXPECT_GE(growth({.height = 0}), 1 - 1e-6);
  EXPECT_NEAR(after(60, {.placement = 0}, {.speed = 1.5}, {}).speed, 0, 1e-6) << "it stays where it is";
  EXPECT_GE(growth({.attitude = 0}), 1 - 1e-6);
  EXPECT_GT(growth({.rate = 0}), 1);
}

// Its samples lead from apex to apex, without a jump, and the foot stays where it is.
TEST(RaibertHopper, IsDrawnAsItHops) {
  const HopperApex apex{.x = 2, .height = 1.3, .speed = 1, .pitch = 0.2, .rate = -0.5};
  const HopperHop one = hop({}, {}, {}, apex);
  const std::vector<HopperSample> samples = hopSamples({}, {}, {}, apex, 50);
  ASSERT_EQ(samples.size(), 200u);
  EXPECT_EQ(samples.front().hip, Eigen::Vector2d(apex.x, apex.height));
  EXPECT_LT((samples.back().hip - Eigen::Vector2d(one.apex.x, one.apex.height)).norm(), 1e-12);
  EXPECT_NEAR(samples.back().pitch, one.apex.pitch, 1e-12);
  EXPECT_NEAR(samples.back().time, one.time, 1e-12);
  for (std::size_t i = 1; i < samples.size(); ++i) {
    EXPECT_LT((samples[i].hip - samples[i - 1].hip).norm(), 0.05) << i;
    EXPECT_LT((samples[i].foot - samples[i - 1].foot).norm(), 0.08) << i;
  }
  for (std::size_t i = 50; i < 150; ++i) EXPECT_EQ(samples[i].foot, Eigen::Vector2d(one.foot, 0)) << i;
  EXPECT_EQ(hopSamples({}, {}, {}, {.height = 0.9}, 2).size(), 2u);
}

TEST(RaibertHopper, SaysHowItFails) {
  const HopperHop low = hop({}, {}, {}, {.height = 0.9});
  EXPECT_EQ(low.status, HopStatus::kNoTouchdown);
  EXPECT_EQ(low.message, "the apex is too low to set the leg after 0 s");
  const HopperHop soft = hop({.stiffness = 100}, {}, {}, {.height = 1.5});
  EXPECT_EQ(soft.status, HopStatus::kFell) << soft.message;
  EXPECT_THAT(soft.message, testing::StartsWith("fell after "));
  const HopperHop fast = hop({}, kNone, {}, {.speed = 8, .stanceTime = 0.01});
  EXPECT_EQ(fast.status, HopStatus::kNoRise) << fast.message;
  EXPECT_THAT(fast.message, testing::StartsWith("took off downwards after "));
  const HopperHop slow = hop({.stiffness = 1e-3, .damping = 1e5}, {}, {}, {});
  EXPECT_EQ(slow.status, HopStatus::kTimeLimit) << slow.message;
  EXPECT_THAT(slow.message, testing::StartsWith("the leg did not stretch again after "));
}

TEST(RaibertHopper, NamesWhatIsWrong) {
  EXPECT_REX_ERROR(hop({.mass = 0}, {}, {}, {}), "hopper: mass: found 0");
  EXPECT_REX_ERROR(hop({.inertia = 0}, {}, {}, {}), "hopper: inertia: found 0");
  EXPECT_REX_ERROR(hop({.stiffness = 0}, {}, {}, {}), "hopper: stiffness: found 0");
  EXPECT_REX_ERROR(hop({.damping = -1}, {}, {}, {}), "hopper: damping: found -1");
  EXPECT_REX_ERROR(hop({.restLength = 0}, {}, {}, {}), "hopper: rest length: found 0");
  EXPECT_REX_ERROR(hop({.g = 0}, {}, {}, {}), "hopper: g: found 0");
  EXPECT_REX_ERROR(hop({}, {.height = -1}, {}, {}), "hopper: gain of height: found -1");
  EXPECT_REX_ERROR(hop({}, {.placement = -1}, {}, {}), "hopper: gain of placement: found -1");
  EXPECT_REX_ERROR(hop({}, {.attitude = -1}, {}, {}), "hopper: gain of attitude: found -1");
  EXPECT_REX_ERROR(hop({}, {.rate = -1}, {}, {}), "hopper: gain of rate: found -1");
  EXPECT_REX_ERROR(hop({}, {}, {.height = 0}, {}), "hopper: wanted height: found 0");
  EXPECT_REX_ERROR(hop({}, {}, {.speed = NAN}, {}), "hopper: wanted speed: found nan");
  EXPECT_REX_ERROR(hop({}, {}, {}, {.x = NAN}), "hopper: x: found nan");
  EXPECT_REX_ERROR(hop({}, {}, {}, {.height = NAN}), "hopper: height: found nan");
  EXPECT_REX_ERROR(hop({}, {}, {}, {.speed = NAN}), "hopper: speed: found nan");
  EXPECT_REX_ERROR(hop({}, {}, {}, {.pitch = NAN}), "hopper: pitch: found nan");
  EXPECT_REX_ERROR(hop({}, {}, {}, {.rate = NAN}), "hopper: rate: found nan");
  EXPECT_REX_ERROR(hop({}, {}, {}, {.thrust = NAN}), "hopper: thrust: found nan");
  EXPECT_REX_ERROR(hopSamples({}, {}, {}, {}, 1), "hopper: number of samples: found 1, wanted at least 2");
  EXPECT_REX_ERROR(hop({}, {}, {}, {.stanceTime = 0}), "hopper: stance time: found 0");
}

}  // namespace rex::raibert_hopper_test
