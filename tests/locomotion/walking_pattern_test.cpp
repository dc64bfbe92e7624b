#include "locomotion/walking_pattern.h"

#include <cmath>

#include "kinematics/center_of_mass.h"
#include "locomotion/humanoid.h"
#include "locomotion/zero_moment_point.h"
#include "scene/state.h"
#include "support/expect_error.h"

namespace rex::walking_pattern_test {

using Eigen::Vector3d;
using Eigen::VectorXd;

TEST(WalkingPattern, KeepsFeetAndCenterOfMassInTheirPlaces) {
  const Humanoid robot;
  WalkPlan plan{.footsteps = straightFootsteps(4, .2, .19)};
  plan.footsteps[4].yaw = plan.footsteps[5].yaw = .2;
  const WalkOptions options;
  const WalkingPattern pattern = walkingPattern(robot.model, robot.legs, plan, robot.start, options);
  ASSERT_EQ(pattern.status, WalkingPattern::Status::kWalks) << pattern.message;
  ASSERT_EQ(pattern.Q.cols(), pattern.center.c.cols());
  double slip = 0, offCenter = 0;
  for (Eigen::Index k = 0; k < pattern.Q.cols(); ++k) {
    const WalkPhase phase = phaseAt(plan, static_cast<double>(k) * options.preview.step);
    const BodyPoses poses = forwardKinematics(robot.model, pattern.Q.col(k));
    for (const Side side : {Side::kLeft, Side::kRight}) {
      const bool isLeft = side == Side::kLeft;
      const Pose& X_WF = poses[isLeft ? robot.legs.leftFoot : robot.legs.rightFoot];
      const Footstep& foot = isLeft ? phase.left : phase.right;
      if (phase.swing && phase.swing->side == side) {
        EXPECT_GE((X_WF * robot.legs.p_FS).z(), -1e-8);
        continue;
      }
      for (const double x : {-.12, .12}) {  // heel and toe
        const Vector3d wanted(foot.p.x() + x * std::cos(foot.yaw), foot.p.y() + x * std::sin(foot.yaw), 0);
        slip = std::max(slip, (X_WF * (robot.legs.p_FS + Vector3d(x, 0, 0)) - wanted).norm());
      }
    }
    const Vector3d center = centerOfMass(robot.model, poses);
    offCenter = std::max(offCenter, (center.head<2>() - pattern.center.c.col(k)).norm());
    EXPECT_NEAR(center.z(), options.preview.height, 1e-6);
    EXPECT_TRUE((pattern.Q.col(k).array() <= robot.model.upperLimits().array()).all());
    EXPECT_TRUE((pattern.Q.col(k).array() >= robot.model.lowerLimits().array()).all());
  }
  EXPECT_LT(slip, 1e-6);
  EXPECT_LT(offCenter, 1e-6);
  EXPECT_LE(pattern.largestError, options.tolerance);
  const VectorXd end = pattern.Q.rightCols<1>();
  EXPECT_NEAR(centerOfMass(robot.model, forwardKinematics(robot.model, end)).x(), .6, .02);
}

// The whole robot's zero moment point, with all that its limbs do, stays on the soles.
TEST(WalkingPattern, KeepsTheZmpOfTheWholeRobotOnTheSoles) {
  const Humanoid robot;
  const WalkPlan plan{.footsteps = straightFootsteps(3, .15, .19), .singleSupport = .8};
  const WalkingPattern pattern = walkingPattern(robot.model, robot.legs, plan, robot.start);
  ASSERT_EQ(pattern.status, WalkingPattern::Status::kWalks) << pattern.message;
  const double h = WalkOptions{}.preview.step;
  const auto velocity = [&](Eigen::Index k) {
    return VectorXd(difference(robot.model, pattern.Q.col(k), pattern.Q.col(k + 1)) / h);
  };
  for (Eigen::Index k = 50; k + 1 < pattern.Q.cols(); ++k) {
    const VectorXd before = velocity(k - 1), after = velocity(k);
    const ZeroMomentPoint zmp =
        zmpOfMotion(robot.model, pattern.Q.col(k), (before + after) / 2, (after - before) / h);
    ASSERT_TRUE(zmp.exists);
    const WalkPhase phase = phaseAt(plan, static_cast<double>(k) * h);
    const SupportMargin margin = supportMargin(supportPolygon(phase, plan.sole), zmp.p_W.head<2>());
    EXPECT_TRUE(margin.isInside) << static_cast<double>(k) * h << " s: " << margin.message;
  }
}

// A turn on the spot past pi, with yaws that stay within (-pi, pi], and with those that go on.
TEST(WalkingPattern, TurnsPastHalfATurn) {
  Humanoid robot;
  const double yaw = 3.05;
  for (const Joint& joint : robot.model.joints())
    if (joint.type == JointType::kFree)
      robot.start.segment<4>(joint.qIndex + 3) << std::cos(yaw / 2), 0, 0, std::sin(yaw / 2);
  WalkPlan wrapped, goesOn;
  for (int i = 0; i < 5; ++i) {
    const double turned = yaw + .08 * std::max(0, i - 1), side = i % 2 == 0 ? .095 : -.095;
    goesOn.footsteps.push_back({.side = i % 2 == 0 ? Side::kLeft : Side::kRight,
                                .p = {-side * std::sin(turned), side * std::cos(turned)},
                                .yaw = turned});
    wrapped.footsteps.push_back(goesOn.footsteps.back());
    wrapped.footsteps.back().yaw = std::remainder(turned, 2 * M_PI);
  }
  ASSERT_LT(wrapped.footsteps.back().yaw, 0);
  const WalkingPattern pattern = walkingPattern(robot.model, robot.legs, wrapped, robot.start);
  ASSERT_EQ(pattern.status, WalkingPattern::Status::kWalks) << pattern.message;
  const WalkingPattern known = walkingPattern(robot.model, robot.legs, goesOn, robot.start);
  EXPECT_LT((pattern.Q - known.Q).cwiseAbs().maxCoeff(), 1e-6);
}

TEST(SolePose, TurnsTheShorterWay) {
  WalkPlan plan{.footsteps = straightFootsteps(1, 0, .2)};
  for (Footstep& foot : plan.footsteps) foot.yaw = 3;
  plan.footsteps[2].yaw = -3;
  const double middle = plan.rest + plan.doubleSupport + plan.singleSupport / 2;
  const Eigen::Matrix3d turned = solePose(plan, Side::kLeft, middle, .05).R;
  EXPECT_LT((turned - Eigen::Vector3d(-1, -1, 1).asDiagonal().toDenseMatrix()).norm(), 1e-12);
}

TEST(SolePose, RisesAndLands) {
  const WalkPlan plan{.footsteps = straightFootsteps(2, .3, .2)};
  const double lift = plan.rest + plan.doubleSupport, middle = lift + plan.singleSupport / 2;
  EXPECT_NEAR(solePose(plan, Side::kLeft, middle, .07).p.z(), .07, 1e-14);
  EXPECT_NEAR(solePose(plan, Side::kLeft, middle, .07).p.x(), .15, 1e-14);
  EXPECT_EQ(solePose(plan, Side::kRight, middle, .07).p, Vector3d(0, -.1, 0));
  const double h = 1e-4;
  for (double t = 0; t < duration(plan); t += h) {
    const Vector3d way = solePose(plan, Side::kLeft, t + h, .07).p - solePose(plan, Side::kLeft, t, .07).p;
    EXPECT_LT(way.norm(), 1.5 * h);
  }
}

TEST(WalkingPattern, SaysWhereItCannotWalk) {
  const Humanoid robot;
  const WalkPlan wide{.footsteps = straightFootsteps(3, 1.2, .19)};
  const WalkingPattern pattern = walkingPattern(robot.model, robot.legs, wide, robot.start);
  EXPECT_EQ(pattern.status, WalkingPattern::Status::kUnreached);
  EXPECT_THAT(pattern.message, testing::HasSubstr("s feet or centre of mass are off by "));
  EXPECT_GT(pattern.Q.cols(), 50);
  EXPECT_LT(pattern.Q.cols(), pattern.center.c.cols());
  const WalkPlan plan{.footsteps = straightFootsteps(1, .1, .19)};
  const auto with = [&](const WalkOptions& options) {
    return walkingPattern(robot.model, robot.legs, plan, robot.start, options);
  };
  EXPECT_REX_ERROR(walkingPattern(robot.model, robot.legs, plan, VectorXd::Zero(3)),
                   "walking pattern: start: found a vector of size 3");
  EXPECT_REX_ERROR(with({.lift = 0}), "walking pattern: lift: found 0");
  EXPECT_REX_ERROR(with({.tolerance = -1}), "walking pattern: tolerance: found -1");
  EXPECT_REX_ERROR(with({.maxIterations = 0}), "walking pattern: iterations: found 0, wanted at least 1");
}

}  // namespace rex::walking_pattern_test
