#include <set>

#include "locomotion/limit_cycle.h"
#include "support/expect_error.h"

namespace rex::basin_test {

using Eigen::VectorXd;
using Status = BasinOutcome::Status;

LimitCycle gait() { return findLimitCycle({}, {.2, -.3, -1, -.3}); }

TEST(Basin, HasTheCycleInsideAndFallsAround) {
  const CompassGait walker;
  const LimitCycle cycle = gait();
  const VectorXd angles = VectorXd::LinSpaced(9, .1, .34), rates = VectorXd::LinSpaced(9, -1.6, -.6);
  const Eigen::Matrix4Xd starts = basinGrid(walker, cycle, angles, rates);
  ASSERT_EQ(starts.cols(), 81);
  const std::vector<BasinOutcome> outcomes = basinOfAttraction(walker, cycle, starts);
  ASSERT_EQ(outcomes.size(), 81);
  int reached = 0;
  std::set<StepStatus> falls;
  for (std::size_t i = 0; i < outcomes.size(); ++i) {
    Eigen::Vector4d x = starts.col(static_cast<Eigen::Index>(i));
    EXPECT_NEAR(x[0] + x[1], -2 * walker.slope, 1e-15);
    reached += outcomes[i].status == Status::kReached;
    if (outcomes[i].status == Status::kFell) falls.insert(outcomes[i].last);
    // The same again, by hand.
    for (int s = 0; s < outcomes[i].steps; ++s) x = walker.step(x).after;
    if (outcomes[i].status == Status::kReached) {
      EXPECT_LE((x - cycle.x).cwiseAbs().maxCoeff(), 1e-3);
    }
    if (outcomes[i].status == Status::kFell) {
      EXPECT_EQ(walker.step(x).status, outcomes[i].last);
    }
  }
  EXPECT_GT(reached, 5);
  EXPECT_LT(reached, 60);
  EXPECT_GE(falls.size(), 1);
  EXPECT_FALSE(falls.contains(StepStatus::kStepped));
}

TEST(Basin, OfTheCycleItselfTakesNoStep) {
  const LimitCycle cycle = gait();
  const std::vector<BasinOutcome> outcomes = basinOfAttraction({}, cycle, cycle.x);
  EXPECT_EQ(outcomes[0].status, Status::kReached);
  EXPECT_EQ(outcomes[0].steps, 0);
  const Eigen::Vector4d near = cycle.x + Eigen::Vector4d(.01, -.01, 0, 0);
  EXPECT_EQ(basinOfAttraction({}, cycle, near, {.maxSteps = 1})[0].status, Status::kUndecided);
  EXPECT_EQ(basinOfAttraction({}, cycle, near)[0].status, Status::kReached);
  EXPECT_TRUE(basinOfAttraction({}, cycle, Eigen::Matrix4Xd(4, 0)).empty());
}

TEST(Basin, NamesWhatIsWrong) {
  const LimitCycle cycle = gait(), none = findLimitCycle({}, {.2, -.3, 0, -.3});
  EXPECT_REX_ERROR(basinOfAttraction({}, none, cycle.x),
                   "basin of attraction: limit cycle: found from the guess");
  const CompassGait lightLegs{.legMass = 5e-6};
  const LimitCycle unstable = findLimitCycle(lightLegs, {.2, -.3, -1, -.3});
  ASSERT_EQ(unstable.status, LimitCycle::Status::kFound) << unstable.message;
  EXPECT_REX_ERROR(basinOfAttraction(lightLegs, unstable, unstable.x),
                   "basin of attraction: limit cycle: found found: unstable");
  EXPECT_REX_ERROR(basinGrid({}, none, VectorXd(), VectorXd()), "basin of attraction: limit cycle");
  EXPECT_REX_ERROR(basinOfAttraction({}, cycle, cycle.x, {.maxSteps = 0}),
                   "basin of attraction: steps: found 0, wanted at least 1");
  EXPECT_REX_ERROR(basinOfAttraction({}, cycle, cycle.x, {.tolerance = -1}),
                   "basin of attraction: tolerance: found -1");
}

}  // namespace rex::basin_test
