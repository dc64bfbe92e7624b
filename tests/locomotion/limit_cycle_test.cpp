#include "locomotion/limit_cycle.h"

#include <cmath>

#include "support/expect_error.h"

namespace rex::limit_cycle_test {

using Eigen::Vector4d;
using Status = LimitCycle::Status;

TEST(LimitCycle, OfTheCompassGait) {
  const CompassGait walker;
  const LimitCycle cycle = findLimitCycle(walker, {.2, -.3, -1, -.3});
  ASSERT_EQ(cycle.status, Status::kFound) << cycle.message;
  const Vector4d known(.218668802939, -.323388558059, -1.091826677490, -.377181558403);
  EXPECT_LT((cycle.x - known).cwiseAbs().maxCoeff(), 1e-9);
  EXPECT_NEAR(cycle.period, .734720962155, 1e-9);
  EXPECT_NEAR(std::abs(cycle.multipliers[0]), .579952333, 1e-9);
  EXPECT_NEAR(std::abs(cycle.multipliers[1]), .579952333, 1e-9);
  EXPECT_NEAR(std::abs(cycle.multipliers[3]), 0, 1e-9);
  EXPECT_TRUE(cycle.isStable);
  EXPECT_THAT(cycle.message, testing::HasSubstr("found: stable, largest multiplier 0.579952"));
}

TEST(LimitCycle, OfTheSimplestWalker) {
  const CompassGait walker = simplestWalker(.009);
  const LimitCycle cycle = findLimitCycle(walker, {.19, -.21, -.2, -.2});
  ASSERT_EQ(cycle.status, Status::kFound) << cycle.message;
  EXPECT_NEAR(cycle.x[0] + .009, .2003109005442, 1e-9);
  EXPECT_NEAR(cycle.x[2], -.1998324730050, 1e-9);
  EXPECT_NEAR(cycle.period, 3.882463752851, 1e-9);
  EXPECT_TRUE(cycle.isStable);
}

// What the multipliers say happens: a disturbed walker comes back as they shrink.
TEST(LimitCycle, MultipliersTellHowDisturbancesShrink) {
  const CompassGait walker;
  const LimitCycle cycle = findLimitCycle(walker, {.2, -.3, -1, -.3});
  ASSERT_EQ(cycle.status, Status::kFound);
  Vector4d x = cycle.x + Vector4d(1e-4, -1e-4, 2e-4, 0);
  const double start = (x - cycle.x).norm();
  for (int i = 0; i < 20; ++i) x = walker.step(x).after;
  const double rate = std::pow((x - cycle.x).norm() / start, 1. / 20);
  EXPECT_NEAR(rate, .58, .06);  // a pair turns as it shrinks
}

// Slopes above some 4.4 degrees make it limp, every other step alike; the even gait then is unstable
// (Goswami et al., figure 8). Newton's method finds it all the same.
TEST(LimitCycle, OnSteepSlopesIsUnstable) {
  LimitCycle cycle = findLimitCycle({}, {.2, -.3, -1, -.3});
  CompassGait walker;
  for (double degrees = 3; degrees <= 4.75; degrees += .25) {
    walker.slope = degrees * M_PI / 180;
    cycle = findLimitCycle(walker, cycle.x);
    ASSERT_EQ(cycle.status, Status::kFound) << degrees << ": " << cycle.message;
    EXPECT_EQ(cycle.isStable, degrees < 4.4) << degrees << ": " << cycle.message;
  }
  EXPECT_LT(cycle.multipliers[0].real(), -1);
  EXPECT_EQ(cycle.multipliers[0].imag(), 0);
  Vector4d x = cycle.x + Vector4d(0, 0, 1e-3, 0);
  for (int i = 0; i < 200; ++i) x = walker.step(x).after;
  const Vector4d next = walker.step(x).after;
  EXPECT_GT((next - x).norm(), .01);
  EXPECT_LT((walker.step(next).after - x).norm(), 1e-6);
}

// Lengths and gravity only set the unit of time, in which the gait is the same.
TEST(LimitCycle, OfWalkersOfAllSizesIsTheSame) {
  const LimitCycle known = findLimitCycle({}, {.2, -.3, -1, -.3});
  for (const auto& [size, g] : {std::pair{1e-4, 9.8}, {1e4, 9.8}, {1., 1e5}, {1., 1.6}}) {
    const CompassGait walker{.a = size / 2, .b = size / 2, .g = g};
    const double unit = std::sqrt(9.8 * size / g);
    const LimitCycle cycle =
        findLimitCycle(walker, {.2, -.3, -1 / unit, -.3 / unit}, {.timeLimit = 10 * unit});
    ASSERT_EQ(cycle.status, Status::kFound) << size << " m, " << g << ": " << cycle.message;
    EXPECT_LT((cycle.x.head<2>() - known.x.head<2>()).cwiseAbs().maxCoeff(), 1e-9);
    EXPECT_LT((unit * cycle.x.tail<2>() - known.x.tail<2>()).cwiseAbs().maxCoeff(), 1e-9);
    EXPECT_NEAR(std::abs(cycle.multipliers[0]), std::abs(known.multipliers[0]), 1e-9);
    EXPECT_NEAR(cycle.period, unit * known.period, 1e-9 * unit);
  }
}

TEST(LimitCycle, NeedsASlopeThatReplacesWhatImpactsLose) {
  const char* message = "no gait: on level ground and uphill nothing replaces the energy that impacts lose";
  for (const CompassGait& walker : {CompassGait{.slope = 0}, simplestWalker(0), CompassGait{.slope = -.05}}) {
    const LimitCycle none = findLimitCycle(walker, {.2, -.2 - 2 * walker.slope, -1, -.3});
    EXPECT_EQ(none.status, Status::kNoGait) << none.message;
    EXPECT_EQ(none.message, message);
    EXPECT_FALSE(none.isStable);
  }
  // Without a slope to speak of the equations are linear, and steps as long as the slope is steep.
  const LimitCycle small = findLimitCycle({.slope = 1e-6}, {.05, -.05, -.25, -.05});
  ASSERT_EQ(small.status, Status::kFound) << small.message;
  const LimitCycle smaller = findLimitCycle({.slope = 1e-9}, 1e-3 * small.x);
  ASSERT_EQ(smaller.status, Status::kFound) << smaller.message;
  EXPECT_LT((1e3 * smaller.x - small.x).norm(), 1e-5 * small.x.norm());
  const LimitCycle tiny = findLimitCycle({.slope = 1e-12}, 1e-6 * small.x);
  EXPECT_EQ(tiny.status, Status::kNoGait) << tiny.message;
  EXPECT_THAT(tiny.message, testing::HasSubstr("rad cannot be distinguished from standing"));
}

TEST(LimitCycle, SaysWhyThereIsNone) {
  const LimitCycle fell = findLimitCycle({}, {.2, -.3, 0, -.3});
  EXPECT_EQ(fell.status, Status::kFell);
  EXPECT_THAT(fell.message, testing::HasSubstr("from the guess: "));
  const LimitCycle early = findLimitCycle({}, {.2, -.3, -1, -.3}, {.maxIterations = 1});
  EXPECT_EQ(early.status, Status::kIterationLimit);
  EXPECT_EQ(early.message, "not found in 1 iterations");
  EXPECT_GT(early.residual, 1e-13);
  // Rounding alone keeps it from coming nearer.
  const LimitCycle stuck = findLimitCycle({}, {.2, -.3, -1, -.3}, {.tolerance = 1e-300});
  EXPECT_EQ(stuck.status, Status::kStuck);
  EXPECT_THAT(stuck.message, testing::HasSubstr("stuck: a step changes the state by "));
  EXPECT_LT(stuck.residual, 1e-13);
  EXPECT_REX_ERROR(findLimitCycle({}, Vector4d::Zero(), {.maxIterations = 0}),
                   "limit cycle: iterations: found 0, wanted at least 1");
  EXPECT_REX_ERROR(findLimitCycle({}, Vector4d::Zero(), {.tolerance = 0}), "limit cycle: tolerance: found 0");
}

}  // namespace rex::limit_cycle_test
