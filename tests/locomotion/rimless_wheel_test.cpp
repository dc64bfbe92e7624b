#include "locomotion/rimless_wheel.h"

#include <cmath>
#include <numbers>

#include <Eigen/Core>

#include "support/expect_error.h"
#include "support/runge_kutta.h"

namespace rex::rimless_wheel_test {

using Eigen::Vector2d;
using Status = RimlessWheel::Step::Status;

// The next rate by integrating a pendulum that stands on its head, until a spoke comes down on either side.
double integratedStep(const RimlessWheel& wheel, double rate) {
  const double alpha = wheel.alpha(), start = wheel.slope - alpha, end = wheel.slope + alpha;
  const auto fall = [&](const Vector2d& x) { return Vector2d(x[1], wheel.g / wheel.l * std::sin(x[0])); };
  Vector2d x(rate > 0 ? start : end, rate);
  constexpr double kStep = 1e-4;
  for (int i = 0; i < 200000; ++i) {
    const Vector2d next = rungeKutta4Step(fall, x, kStep);
    for (const double side : {start, end}) {
      const bool leaves = side == start ? next[0] < side : next[0] > side;
      if (!leaves) continue;
      const double share = (side - x[0]) / (next[0] - x[0]);
      return std::cos(2 * alpha) * (x[1] + share * (next[1] - x[1]));
    }
    x = next;
  }
  return NAN;
}

TEST(RimlessWheel, StepsAsItsIntegral) {
  const RimlessWheel wheel{.spokes = 9, .slope = .1, .l = .7, .g = 9.8};
  const double least = wheel.leastRate();
  for (const double rate : {.2 * least, .9 * least, 1.1 * least, 2 * least, -.5, -1.2, -2.5}) {
    const RimlessWheel::Step step = wheel.step(rate);
    ASSERT_NE(step.status, Status::kLostContact) << step.message;
    EXPECT_NEAR(step.rate, integratedStep(wheel, rate), 1e-6) << rate;
  }
  EXPECT_EQ(wheel.step(.9 * least).status, Status::kRockedBack);
  EXPECT_EQ(wheel.step(least).status, Status::kRockedBack);
  EXPECT_EQ(wheel.step(1.1 * least).status, Status::kRolled);
  EXPECT_EQ(wheel.step(-.5).status, Status::kRockedBack);
  EXPECT_EQ(wheel.step(-2.5).status, Status::kRolledUphill);
}

// Where the slope is steeper than alpha, the spoke uphill comes down before the wheel is over the vertical.
TEST(RimlessWheel, RollsUphillOnSteepSlopesAsItsIntegral) {
  const RimlessWheel wheel{.spokes = 30, .slope = .2};
  ASSERT_GT(wheel.slope, wheel.alpha());
  for (const double rate : {-.5, -.9, -.905, -.925, -.945, -.96, -2.}) {
    const RimlessWheel::Step step = wheel.step(rate);
    EXPECT_EQ(step.status, rate > -.903 ? Status::kRockedBack : Status::kRolledUphill) << rate;
    EXPECT_NEAR(step.rate, integratedStep(wheel, rate), 1e-6) << rate;
  }
}

TEST(RimlessWheel, ConvergesToItsFixedPoint) {
  const RimlessWheel wheel;
  const auto fixed = wheel.fixedPoint();
  ASSERT_TRUE(fixed);
  EXPECT_NEAR(wheel.step(fixed->rate).rate, fixed->rate, 1e-14);
  double rate = 2 * fixed->rate, before = rate;
  for (int i = 0; i < 30; ++i) {
    before = rate;
    rate = wheel.step(rate).rate;
  }
  EXPECT_NEAR(rate, fixed->rate, 1e-8);
  EXPECT_NEAR((rate - fixed->rate) / (before - fixed->rate), fixed->multiplier, 1e-4);
  const double h = 1e-6;
  EXPECT_NEAR((wheel.step(fixed->rate + h).rate - wheel.step(fixed->rate - h).rate) / (2 * h),
              fixed->multiplier, 1e-9);
}

TEST(RimlessWheel, SaysWhereItDoesNotRoll) {
  EXPECT_FALSE(RimlessWheel{.slope = 0}.fixedPoint());
  EXPECT_FALSE(RimlessWheel{.slope = .01}.fixedPoint());
  const RimlessWheel wheel;
  const RimlessWheel::Step slow = wheel.step(.1);
  EXPECT_THAT(slow.message, testing::HasSubstr("rate 0.1 does not carry it over the spoke"));
  const RimlessWheel::Step quick = wheel.step(5);
  EXPECT_EQ(quick.status, Status::kLostContact);
  EXPECT_THAT(quick.message, testing::HasSubstr("the spoke leaves the ground at -0.312699 rad"));
  EXPECT_EQ(wheel.step(-5).status, Status::kLostContact);
  const RimlessWheel steep{.spokes = 10, .slope = .4};
  EXPECT_EQ(steep.leastRate(), 0);
  EXPECT_EQ(steep.step(0).status, Status::kRolled);
}

TEST(RimlessWheel, NamesWhatIsWrong) {
  EXPECT_REX_ERROR(RimlessWheel{.spokes = 4}.alpha(), "rimless wheel: spokes: found 4, wanted at least 5");
  EXPECT_REX_ERROR(RimlessWheel{.slope = -.1}.leastRate(),
                   "rimless wheel: slope: found -0.1, wanted an angle");
  EXPECT_REX_ERROR(RimlessWheel{.l = 0}.step(1), "rimless wheel: length l: found 0");
  EXPECT_REX_ERROR(RimlessWheel{.g = -1}.fixedPoint(), "rimless wheel: g: found -1");
  EXPECT_REX_ERROR(RimlessWheel{}.step(NAN), "rimless wheel: rate: found nan");
}

}  // namespace rex::rimless_wheel_test
