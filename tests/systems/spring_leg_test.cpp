#include "systems/spring_leg.h"

#include <cmath>

#include "base/derivative_check.h"
#include "base/rng.h"
#include "support/expect_error.h"
#include "support/runge_kutta.h"

namespace rex::spring_leg_test {

using Eigen::Vector2d;
using Eigen::Vector4d;
using Eigen::VectorXd;

// In stance the force is the slope of the energy.
TEST(SpringLeg, AcceleratesDownItsPotential) {
  Rng rng(1);
  const SpringLeg leg;
  for (int i = 0; i < 10; ++i) {
    Vector4d x;
    x << rng.uniform(-.5, .5), rng.uniform(.5, 1), rng.normal(), rng.normal();
    const VectorFunction potential = [&](const VectorXd& p) {
      return VectorXd::Constant(1, leg.stanceEnergy(Vector4d(p[0], p[1], 0, 0)));
    };
    const Vector2d force = -numericJacobian(potential, x.head<2>()).transpose();
    const Vector4d d = leg.stanceDerivative(x);
    EXPECT_EQ((d.head<2>() - x.tail<2>()).norm(), 0);
    EXPECT_LT((leg.mass * d.tail<2>() - force).norm(), 1e-6 * (1 + force.norm()));
  }
}

TEST(SpringLeg, KeepsItsEnergy) {
  const SpringLeg leg;
  const RunnerApex apex{.height = 1, .speed = 5};
  const Hop hop = leg.hop(apex);
  ASSERT_EQ(hop.status, HopStatus::kHopped) << hop.message;
  const double energy = leg.apexEnergy(apex);
  EXPECT_NEAR(leg.stanceEnergy(hop.touchdown), energy, 1e-12 * energy);
  EXPECT_NEAR(leg.stanceEnergy(hop.takeoff), energy, 1e-12 * energy);
  EXPECT_NEAR(leg.apexEnergy(hop.apex), energy, 1e-12 * energy);
  EXPECT_NEAR(hop.takeoff.head<2>().norm(), leg.restLength, 1e-14);
}

// Straight down a spring swings as a cosine about where it carries the weight.
TEST(SpringLeg, HopsOnTheSpotInClosedForm) {
  SpringLeg leg{.angle = M_PI / 2 - 1e-9};
  const Hop hop = leg.hop({.height = 1.1, .speed = 0});
  ASSERT_EQ(hop.status, HopStatus::kHopped) << hop.message;
  const double w = std::sqrt(leg.stiffness / leg.mass), fall = std::sqrt(2 * leg.g * .1);
  EXPECT_NEAR(hop.stanceTime, 2 / w * (M_PI / 2 + std::atan(leg.g / (w * fall))), 1e-9);
  EXPECT_NEAR(hop.apex.height, 1.1, 1e-9);
}

TEST(SpringLeg, StanceIsTheIntegral) {
  const SpringLeg leg;
  const Hop hop = leg.hop({.height = 1, .speed = 5});
  Vector4d x = hop.touchdown;
  constexpr int kSteps = 4000;
  for (int i = 0; i < kSteps; ++i)
    x = rungeKutta4Step([&](const Vector4d& y) { return leg.stanceDerivative(y); }, x,
                        hop.stanceTime / kSteps);
  EXPECT_LT((x - hop.takeoff).norm(), 1e-9);
}

TEST(RunningGait, OfTheDefaultLegIsStable) {
  const SpringLeg leg;
  const RunningGait gait = findRunningGait(leg, {.height = 1, .speed = 5});
  ASSERT_EQ(gait.status, RunningGait::Status::kFound) << gait.message;
  EXPECT_TRUE(gait.isStable);
  EXPECT_NEAR(leg.apexEnergy(gait.apex), leg.apexEnergy({.height = 1, .speed = 5}), 1e-9);
  // A gait takes off as it touches down, seen in a mirror.
  const Hop hop = leg.hop(gait.apex);
  EXPECT_LT((hop.takeoff - Vector4d(-1, 1, 1, -1).cwiseProduct(hop.touchdown)).norm(), 1e-11);
  // From far away it runs into that gait by itself.
  RunnerApex apex{.height = 1, .speed = 5};
  for (int i = 0; i < 40; ++i) {
    const Hop next = leg.hop(apex);
    ASSERT_EQ(next.status, HopStatus::kHopped) << i << ": " << next.message;
    apex = next.apex;
  }
  EXPECT_NEAR(apex.height, gait.apex.height, 1e-9);
}

TEST(RunningGait, MultiplierTellsWhetherItLasts) {
  SpringLeg leg{.angle = 69 * M_PI / 180};
  RunningGait gait = findRunningGait(leg, {.height = .94, .speed = 5.1});
  ASSERT_EQ(gait.status, RunningGait::Status::kFound) << gait.message;
  EXPECT_FALSE(gait.isStable);
  EXPECT_LT(gait.multiplier, -1);
  leg.angle = 67 * M_PI / 180;
  gait = findRunningGait(leg, {.height = 1, .speed = 5});
  ASSERT_EQ(gait.status, RunningGait::Status::kFound) << gait.message;
  const double energy = leg.apexEnergy(gait.apex), height = gait.apex.height + 1e-4;
  const Hop hop = leg.hop({.height = height, .speed = std::sqrt(2 * (energy / leg.mass - leg.g * height))});
  EXPECT_NEAR((hop.apex.height - gait.apex.height) / 1e-4, gait.multiplier, 1e-2);
}

// A leg without a hold on the ground cannot pull: it takes off as soon as it would be longer than at rest.
TEST(SpringLeg, NeverPulls) {
  const SpringLeg leg;
  int atOnce = 0, soon = 0;
  for (int i = -8000; i <= 8000; i += 5) {
    const Hop hop = leg.hop({.height = 1, .speed = i / 1000.});
    EXPECT_LE(hop.takeoff.head<2>().norm(), leg.restLength + 1e-12) << i << ": " << hop.message;
    if (hop.status != HopStatus::kNoRise) continue;
    atOnce += hop.stanceTime == 0;
    soon += hop.stanceTime > 0 && hop.stanceTime < .005;
  }
  EXPECT_GT(atOnce, 900);
  EXPECT_GE(soon, 1);
  const Hop backwards = leg.hop({.height = 1, .speed = -5});
  EXPECT_EQ(backwards.status, HopStatus::kNoRise);
  EXPECT_THAT(backwards.message, testing::StartsWith("took off downwards after "));
  EXPECT_EQ(backwards.takeoff, backwards.touchdown);
  EXPECT_GT(backwards.touchdown.head<2>().dot(backwards.touchdown.tail<2>()), 0);
}

// On a flat leg some hops come to rest for a moment and go back the way they came: to the same height, but
// not to the same apex.
TEST(RunningGait, DoesNotTurnBack) {
  const SpringLeg leg{.angle = M_PI / 4};
  const RunnerApex apex{.height = .7511, .speed = 1.8786};
  EXPECT_LT(leg.hop(apex).apex.speed, 0);
  const RunningGait gait = findRunningGait(leg, apex);
  EXPECT_EQ(gait.status, RunningGait::Status::kFell) << gait.message;
  EXPECT_THAT(gait.message, testing::HasSubstr("turned back, from 1.878"));
}

TEST(RunningGait, RunsTheWayOfTheGuess) {
  const RunningGait gait = findRunningGait({}, {.height = 1, .speed = -5});
  EXPECT_EQ(gait.status, RunningGait::Status::kFell) << gait.message;
  EXPECT_DOUBLE_EQ(gait.apex.speed, -5);
}

TEST(SpringLeg, SaysHowItFails) {
  const SpringLeg leg;
  const Hop low = leg.hop({.height = .9, .speed = 5});
  EXPECT_EQ(low.status, HopStatus::kNoTouchdown);
  EXPECT_EQ(low.message, "the apex is too low to set the leg after 0 s");
  const SpringLeg soft{.stiffness = 1500};
  const Hop fell = soft.hop({.height = 2, .speed = .1});
  EXPECT_EQ(fell.status, HopStatus::kFell) << fell.message;
  EXPECT_NEAR(fell.takeoff[1], 0, 1e-14);
  EXPECT_THAT(fell.message, testing::StartsWith("fell after "));
  EXPECT_EQ(leg.hop({.height = 1, .speed = 5}, 1e-3).status, HopStatus::kTimeLimit);
  const Hop stumble = SpringLeg{.angle = 89 * M_PI / 180}.hop({.height = 1.3, .speed = 10});
  EXPECT_EQ(stumble.status, HopStatus::kNoRise) << stumble.message;
  EXPECT_LT(stumble.takeoff[3], 0);
  EXPECT_EQ(findRunningGait(leg, {.height = .5, .speed = 5}).status, RunningGait::Status::kFell);
}

TEST(SpringLeg, NamesWhatIsWrong) {
  EXPECT_REX_ERROR(SpringLeg{.mass = 0}.hop({}), "spring leg: mass: found 0");
  EXPECT_REX_ERROR(SpringLeg{.stiffness = -1}.hop({}), "spring leg: stiffness: found -1");
  EXPECT_REX_ERROR(SpringLeg{.restLength = 0}.hop({}), "spring leg: rest length: found 0");
  EXPECT_REX_ERROR(SpringLeg{.g = 0}.apexEnergy({}), "spring leg: g: found 0");
  EXPECT_REX_ERROR(SpringLeg{.angle = 2}.hop({}), "spring leg: angle: found 2, wanted an angle in (0, pi/2)");
  EXPECT_REX_ERROR(SpringLeg{}.hop({.height = NAN}), "spring leg: height of the apex: found nan");
  EXPECT_REX_ERROR(SpringLeg{}.hop({.speed = NAN}), "spring leg: speed of the apex: found nan");
  EXPECT_REX_ERROR(SpringLeg{}.hop({}, 0), "spring leg: time limit: found 0");
  EXPECT_REX_ERROR(SpringLeg{}.stanceEnergy({0, NAN, 0, 0}), "spring leg: state: number 1");
}

}  // namespace rex::spring_leg_test
