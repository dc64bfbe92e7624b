#include "locomotion/footsteps.h"

#include <cmath>

#include "locomotion/walking_pattern.h"
#include "support/expect_error.h"

namespace rex::footsteps_test {

using Eigen::Vector2d;

WalkPlan plan() { return {.footsteps = straightFootsteps(6, .3, .19)}; }

TEST(Footsteps, OfAStraightWalk) {
  const std::vector<Footstep> steps = straightFootsteps(3, .3, .2);
  ASSERT_EQ(steps.size(), 5);
  const double x[] = {0, 0, .3, .6, .6};
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_EQ(steps[i].side, i % 2 == 0 ? Side::kLeft : Side::kRight);
    EXPECT_LT((steps[i].p - Vector2d(x[i], i % 2 == 0 ? .1 : -.1)).norm(), 1e-15);
  }
}

// Sampled finely: the reference never jumps, stays on the soles, and stays put while a foot is in the air.
TEST(WalkPlan, KeepsItsReferenceOnTheSoles) {
  WalkPlan walk = plan();
  walk.footsteps[3].yaw = .4;
  const double end = duration(walk);
  EXPECT_NEAR(end, 2 * 1.6 + .2 + 6 * .9, 1e-12);
  WalkPhase before = phaseAt(walk, 0);
  int landings = 0;
  for (double t = 0; t < end + .1; t += 1e-3) {
    const WalkPhase phase = phaseAt(walk, t);
    const SupportMargin margin = supportMargin(supportPolygon(phase, walk.sole), phase.zmp, .05);
    EXPECT_TRUE(margin.isInside) << t << ": " << margin.message;
    EXPECT_LT((phase.zmp - before.zmp).norm(), 3e-3) << t;
    if (phase.swing && before.swing) {
      EXPECT_EQ(phase.zmp, before.zmp);
    }
    if (before.swing && !phase.swing) {
      ++landings;
      const Footstep& foot = before.swing->side == Side::kLeft ? phase.left : phase.right;
      EXPECT_EQ(foot.p, before.swing->p);
      EXPECT_EQ(foot.yaw, before.swing->yaw);
    }
    EXPECT_GE(phase.share, 0);
    EXPECT_LE(phase.share, 1);
    before = phase;
  }
  EXPECT_EQ(landings, 6);
  EXPECT_EQ(phaseAt(walk, 0).zmp, Vector2d(0, 0));
  EXPECT_LT((phaseAt(walk, 1e9).zmp - Vector2d(1.5, 0)).norm(), 1e-15);
  EXPECT_EQ(phaseAt(walk, -1).share, 0);
}

// The zero moment point of the centre of mass that preview control plans stays on the soles, too.
TEST(WalkPlan, PreviewControlKeepsTheZmpOnTheSoles) {
  const WalkPlan walk = plan();
  const PreviewOptions options;
  const PreviewMotion motion = followZmp(zmpReference(walk, options.step), options);
  ASSERT_EQ(motion.status, RiccatiStatus::kSolved) << motion.message;
  EXPECT_LT(motion.largestError, .03);
  int outside = 0;  // the centre of mass itself leaves the soles: the walk is not statically stable
  for (Eigen::Index k = 0; k < motion.zmp.cols(); ++k) {
    const SupportPolygon support =
        supportPolygon(phaseAt(walk, static_cast<double>(k) * options.step), walk.sole);
    const SupportMargin margin = supportMargin(support, motion.zmp.col(k), .02);
    EXPECT_TRUE(margin.isInside) << k << ": " << margin.message;
    outside += !supportMargin(support, motion.c.col(k)).isInside;
  }
  EXPECT_GT(outside, 100);
}

TEST(WalkPlan, OnTheSpotStaysThere) {
  const WalkPlan walk{.footsteps = straightFootsteps(1, .3, .19)};
  EXPECT_EQ(zmpReference(walk, .01).row(0).cwiseAbs().maxCoeff(), 0);
  const WalkPlan still{.footsteps = {{.side = Side::kRight}, {.side = Side::kLeft, .p = {0, .2}}}};
  EXPECT_EQ(phaseAt(still, 1).zmp, Vector2d(0, .1));
  EXPECT_EQ(phaseAt(still, 1).left.p, Vector2d(0, .2));
}

TEST(WalkPlan, NamesWhatIsWrong) {
  EXPECT_REX_ERROR(straightFootsteps(0, .3, .2), "footsteps: count: found 0, wanted at least 1");
  EXPECT_REX_ERROR(straightFootsteps(2, NAN, .2), "footsteps: length: found nan");
  EXPECT_REX_ERROR(straightFootsteps(2, .3, 0), "footsteps: width: found 0");
  EXPECT_REX_ERROR(duration({}), "walk: footsteps: found 0, wanted two to stand on at first");
  WalkPlan walk = plan();
  walk.footsteps[3].p.y() = NAN;
  EXPECT_REX_ERROR(duration(walk), "walk: footstep 3: p: number 1: found nan");
  walk = plan();
  walk.footsteps[2].yaw = INFINITY;
  EXPECT_REX_ERROR(duration(walk), "walk: footstep 2: yaw: found inf");
  walk = plan();
  walk.footsteps[4].side = Side::kRight;
  EXPECT_REX_ERROR(phaseAt(walk, 0),
                   "walk: footstep 4: found the same side as before, wanted left and right");
  EXPECT_REX_ERROR(phaseAt(plan(), NAN), "walk: time t: found nan");
  EXPECT_REX_ERROR(zmpReference(plan(), 0), "walk: time step: found 0");
  EXPECT_REX_ERROR(zmpReference(plan(), 1e-9),
                   "walk: time step: found 8.8e+09 columns, wanted at most 1e+06");
  for (auto [set, name] :
       {std::pair<void (*)(WalkPlan&), const char*>{[](WalkPlan& w) { w.sole.length = 0; },
                                                    "walk: length of the sole: found 0"},
        {[](WalkPlan& w) { w.sole.width = 0; }, "walk: width of the sole: found 0"},
        {[](WalkPlan& w) { w.doubleSupport = 0; }, "walk: time of double support: found 0"},
        {[](WalkPlan& w) { w.singleSupport = 0; }, "walk: time of single support: found 0"},
        {[](WalkPlan& w) { w.rest = 0; }, "walk: time of rest: found 0"}}) {
    walk = plan();
    set(walk);
    EXPECT_REX_ERROR(duration(walk), name);
  }
}

}  // namespace rex::footsteps_test
