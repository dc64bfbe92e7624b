#include "live/drag.h"

#include <limits>

#include <gmock/gmock.h>

#include "base/error.h"
#include "base/rng.h"
#include "collision/contacts.h"
#include "formats/scene_file.h"
#include "geometry/rotation.h"
#include "support/paths.h"

namespace rex::drag_test {

Model sceneOf(const std::string& name) {
  return compile(readScene(homeFolder().string() + "/data/robots/" + name).spec);
}

TEST(Drag, ReachesPointsOfOtherPosturesWithinTheLimits) {
  const Model arm = sceneOf("arm3.ors");
  const BodyId last = arm.bodiesInFileOrder().back();
  Rng rng(1);
  int reached = 0;
  for (int round = 0; round < 50; ++round) {
    Eigen::VectorXd wanted = arm.initialPositions(), start = wanted;
    for (int i = 0; i < arm.nq(); ++i) {
      const double low = std::max(arm.lowerLimits()[i], -2.), high = std::min(arm.upperLimits()[i], 2.);
      wanted[i] = rng.uniform(low, high), start[i] = rng.uniform(low, high);
    }
    const Eigen::Vector3d p_BQ = rng.uniformVector(3, -0.1, 0.1);
    const DragGoal goal{.body = last, .p_BQ = p_BQ, .p_WQ = forwardKinematics(arm, wanted)[last] * p_BQ};
    Eigen::VectorXd q = start;
    for (int tick = 0; tick < 60; ++tick) q = dragged(arm, q, goal);
    EXPECT_TRUE((q.array() >= arm.lowerLimits().array()).all() &&
                (q.array() <= arm.upperLimits().array()).all());
    if ((forwardKinematics(arm, q)[last] * p_BQ - goal.p_WQ).norm() < 1e-6) ++reached;
  }
  EXPECT_GE(reached, 40);  // the others end at a limit or stretched
}

TEST(Drag, LeavesFreeBasesAndOtherBranchesWhereTheyAre) {
  const Model man = sceneOf("man.ors");
  const BodyId hand = man.bodiesInFileOrder().back();
  const Eigen::VectorXd q = man.initialPositions();
  const BodyPoses before = forwardKinematics(man, q);
  const BodyPoses after = forwardKinematics(
      man, dragged(man, q, {.body = hand, .p_WQ = before[hand].p + Eigen::Vector3d(0.05, 0, 0.05)}));
  std::vector<bool> carries(man.bodies().size());
  for (BodyId at = hand; at != kWorld; at = man[at].parent) carries[static_cast<std::size_t>(at)] = true;
  for (std::size_t i = 1; i < carries.size(); ++i) {
    BodyId top{static_cast<int>(i)};
    bool isBeyond = false;
    for (BodyId at = top; at != kWorld; at = man[at].parent)
      isBeyond |= carries[static_cast<std::size_t>(at)];
    if (isBeyond) continue;
    EXPECT_EQ(after.X_WB[i].p, before.X_WB[i].p) << man.bodies()[i].name;
  }
}

TEST(Drag, TurnsABodyAndStaysClearOfContacts) {
  const Model arm = sceneOf("arm7.ors");
  const BodyId last = arm.bodiesInFileOrder().back();
  Eigen::VectorXd q = arm.initialPositions();
  Rng rng(3);
  for (int i = 0; i < arm.nq(); ++i) q[i] += rng.uniform(-0.3, 0.3);
  const Pose goal = forwardKinematics(arm, q)[last];
  Eigen::VectorXd at = arm.initialPositions();
  for (int tick = 0; tick < 100; ++tick)
    at = dragged(arm, at, {.body = last, .p_WQ = goal.p, .R_WB = goal.R},
                 contactTask(ContactModel(arm), 0.001));
  EXPECT_LT((forwardKinematics(arm, at)[last].R - goal.R).norm(), 1e-3);
}

// The arm is stretched at the start, where small steps may turn joints far.
TEST(Drag, StretchesTowardsWhatIsOutOfReachWithoutShaking) {
  const Model arm = sceneOf("arm7.ors");
  const BodyId last = arm.joints().back().child;
  Eigen::VectorXd q = arm.initialPositions();
  const Pose start = forwardKinematics(arm, q)[last];
  const DragGoal goal{.body = last, .p_WQ = start.p + Eigen::Vector3d(-0.09, -0.09, -0.08)};
  double before = (start.p - goal.p_WQ).norm();
  for (int tick = 0; tick < 200; ++tick) {
    q = dragged(arm, q, goal);
    const double distance = (forwardKinematics(arm, q)[last].p - goal.p_WQ).norm();
    EXPECT_LE(distance, before + 1e-12);
    before = distance;
  }
  EXPECT_LT((dragged(arm, q, goal) - q).norm(), 1e-3);
}

TEST(Drag, RefusesGoalsThatAreNotFinite) {
  const Model arm = sceneOf("arm3.ors");
  try {
    static_cast<void>(dragged(arm, arm.initialPositions(),
                              {.body = BodyId{1}, .p_WQ = {0, 0, std::numeric_limits<double>::quiet_NaN()}}));
    FAIL();
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "the goal of a drag: found a number that is not finite");
  }
}

}  // namespace rex::drag_test
