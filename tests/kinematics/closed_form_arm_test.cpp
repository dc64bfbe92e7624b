// Postures in closed form: forward kinematics, and a numeric solver that finds no others.
#include "kinematics/closed_form_arm.h"

#include <cmath>
#include <tuple>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "base/rng.h"
#include "formats/urdf_reader.h"
#include "kinematics/closed_form_arm_internal.h"
#include "kinematics/forward_kinematics.h"
#include "kinematics/inverse_kinematics_solver.h"
#include "kinematics/task_maps.h"
#include "support/expect_error.h"

namespace rex::closed_form_arm_test {

using Eigen::Vector3d;

struct Hinge {
  Vector3d origin, axis;
  double lower = -3.1, upper = 3.1;
};

std::string numbers(const Vector3d& v) { return fmt::format("{:.17g} {:.17g} {:.17g}", v[0], v[1], v[2]); }

// A chain of hinges in the order of their origins, each seen from the last, and a tip.
Model chainOf(const std::vector<Hinge>& hinges, const Vector3d& tip, const std::string& type = "revolute",
              const std::string& inLast = "") {
  std::string urdf = "<robot name='chain'><link name='l0'/>";
  for (std::size_t i = 0; i < hinges.size(); ++i)
    urdf += fmt::format(
        "<link name='l{1}'/><joint name='j{1}' type='{6}'><parent link='l{0}'/><child link='l{1}'/>"
        "<origin xyz='{2}' rpy='0 0 0'/><axis xyz='{3}'/><limit lower='{4}' upper='{5}' effort='1' "
        "velocity='1'/>{7}</joint>",
        i, i + 1, numbers(hinges[i].origin), numbers(hinges[i].axis), hinges[i].lower, hinges[i].upper,
        i + 1 == hinges.size() ? type : "revolute", i + 1 == hinges.size() ? inLast : "");
  urdf += fmt::format(
      "<link name='tip'/><joint name='fixed' type='fixed'><parent link='l{}'/><child link='tip'/>"
      "<origin xyz='{}' rpy='.3 .2 .1'/></joint></robot>",
      hinges.size(), numbers(tip));
  return compile(parseUrdf(urdf, "chain.urdf").spec);
}

const Vector3d kX(1, 0, 0), kY(0, 1, 0), kZ(0, 0, 1), kNone(0, 0, 0);

// Like industrial arms: an offset shoulder, and a wrist that is a ball.
std::vector<Hinge> industrial() {
  return {{kNone, kZ},         {{.35, 0, .7}, kY}, {{0, 0, 1.1}, kY},
          {{.5, 0, -.04}, kX}, {{.7, 0, 0}, kY},   {kNone, kX}};
}
// Like a UR5.
std::vector<Hinge> parallelArm() {
  return {{{0, 0, .0892}, kZ}, {{0, .1358, 0}, kY}, {{0, -.1197, .425}, kY},
          {{0, 0, .3922}, kY}, {{0, .093, 0}, kZ},  {{0, 0, .0946}, kY}};
}
Vector3d someDirection(Rng& rng) { return rng.normalVector(3).normalized(); }

std::vector<Hinge> randomWrist(Rng& rng) {
  std::vector<Hinge> hinges;
  for (int i = 0; i < 6; ++i)
    hinges.push_back({i < 4 ? Vector3d(0.5 * rng.normalVector(3)) : kNone, someDirection(rng)});
  return hinges;
}
std::vector<Hinge> randomParallel(Rng& rng) {
  std::vector<Hinge> hinges;
  const Vector3d axis = someDirection(rng);
  for (int i = 0; i < 6; ++i)
    hinges.push_back({0.5 * rng.normalVector(3),
                      i >= 1 && i <= 3 ? Vector3d(rng.uniform() < .5 ? axis : -axis) : someDirection(rng)});
  return hinges;
}
// The same arm with the world at its tip.
std::vector<Hinge> reversed(const std::vector<Hinge>& hinges) {
  std::vector<Hinge> result;
  for (std::size_t i = 0; i < 6; ++i)
    result.push_back({i == 0 ? Vector3d(.1, .2, .3) : Vector3d(-hinges[6 - i].origin), hinges[5 - i].axis});
  return result;
}

struct Arm {
  Model model;
  BodyId tip = model.body("tip");
  ClosedFormArm closed;
  explicit Arm(const std::vector<Hinge>& hinges, const Vector3d& offset = {.1, .05, .2})
      : model(chainOf(hinges, offset)), closed(ClosedFormArm::of(model, tip).value()) {}
  Pose at(const Eigen::VectorXd& q) const { return forwardKinematics(model, q)[tip]; }
};

std::vector<Arm> arms(Rng& rng) {
  std::vector<Arm> result;
  for (const auto& hinges : {industrial(), parallelArm(), reversed(industrial()), reversed(parallelArm())})
    result.emplace_back(hinges);
  for (int i = 0; i < 4; ++i) {
    result.emplace_back(randomWrist(rng));
    result.emplace_back(randomParallel(rng));
    result.emplace_back(reversed(randomWrist(rng)));
    result.emplace_back(reversed(randomParallel(rng)));
  }
  return result;
}

double gapOf(const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  double gap = 0;
  for (Eigen::Index i = 0; i < a.size(); ++i)
    gap = std::max(gap, std::abs(std::remainder(a[i] - b[i], 2 * M_PI)));
  return gap;
}

double nearest(const std::vector<ClosedFormPosture>& postures, const Eigen::VectorXd& q) {
  double gap = 10;
  for (const ClosedFormPosture& one : postures) gap = std::min(gap, gapOf(one.q, q));
  return gap;
}

Eigen::VectorXd randomPosture(Rng& rng) {
  Eigen::VectorXd q(6);
  for (double& angle : q) angle = rng.uniform(-3, 3);
  return q;
}

TEST(ClosedFormArm, FindsThePostureThatLedThere) {
  Rng rng(1);
  std::size_t most = 0;
  for (const Arm& arm : arms(rng))
    for (int k = 0; k < 100; ++k) {
      const Eigen::VectorXd q = randomPosture(rng);
      const Pose X_WT = arm.at(q);
      const auto postures = arm.closed.postures(X_WT, Eigen::VectorXd::Zero(6), {.withinLimits = false});
      EXPECT_LT(nearest(postures, q), 1e-6) << q.transpose();
      EXPECT_LE(postures.size(), 8u);
      most = std::max(most, postures.size());
      for (const ClosedFormPosture& one : postures) {
        const Pose X = arm.at(one.q);
        EXPECT_LT((X.R - X_WT.R).norm() + (X.p - X_WT.p).norm(), 1e-9);
        EXPECT_EQ(one.chosen, kNoJoint);
      }
    }
  EXPECT_EQ(most, 8u);
}

std::vector<Hinge> scaled(std::vector<Hinge> hinges, double factor) {
  for (Hinge& hinge : hinges) hinge.origin *= factor;
  return hinges;
}

// Some robots are described in millimetres.
TEST(ClosedFormArm, FindsPosturesOfArmsOfAnySize) {
  Rng rng(11);
  for (const double factor : {1e-3, 1e3})
    for (const auto& hinges : {industrial(), parallelArm()}) {
      const Arm arm(scaled(hinges, factor), factor * Vector3d(.1, .05, .2));
      for (int k = 0; k < 30; ++k) {
        const Eigen::VectorXd q = randomPosture(rng);
        const Pose X_WT = arm.at(q);
        const auto postures = arm.closed.postures(X_WT, Eigen::VectorXd::Zero(6), {.withinLimits = false});
        EXPECT_LT(nearest(postures, q), 1e-6) << q.transpose();
        for (const ClosedFormPosture& one : postures)
          EXPECT_LT((arm.at(one.q).p - X_WT.p).norm(), 1e-9 * factor);
      }
    }
}

// A second opinion: the numeric solver, from many starts.
TEST(ClosedFormArm, LeavesNothingToANumericSolver) {
  Rng rng(2);
  for (const Arm& arm : arms(rng))
    for (int k = 0; k < 3; ++k) {
      const Pose X_WT = arm.at(randomPosture(rng));
      const auto postures = arm.closed.postures(X_WT, Eigen::VectorXd::Zero(6), {.withinLimits = false});
      const Task task{.name = "tip", .map = poseTask(arm.tip, X_WT), .tolerance = 1e-9};
      for (int start = 0; start < 30; ++start) {
        const auto numeric = solveInverseKinematics(arm.model, std::span(&task, 1), randomPosture(rng),
                                                    {.maxIterations = 100, .maxRestarts = 1}, rng);
        if (numeric.status != InverseKinematicsResult::Status::kSolved) continue;
        EXPECT_LT(nearest(postures, numeric.q), 1e-4) << numeric.q.transpose();
      }
    }
}

TEST(ClosedFormArm, SaysWhichAngleItChose) {
  const Arm arm(industrial());
  Eigen::VectorXd q(6), reference = Eigen::VectorXd::Constant(6, 0.25);
  q << .3, .4, -.5, .6, 0, .7;  // axes 4 and 6 are one
  const auto postures = arm.closed.postures(arm.at(q), reference);
  ASSERT_FALSE(postures.empty());
  bool isTold = false;
  for (const ClosedFormPosture& one : postures) {
    if (one.chosen != kNoJoint) {
      EXPECT_EQ(arm.model[one.chosen].name, "j4");
      EXPECT_EQ(one.q[3], 0.25);
      isTold = true;
    }
    EXPECT_LT((arm.at(one.q).R - arm.at(q).R).norm(), 1e-9);
  }
  EXPECT_TRUE(isTold);
  // The wrist is on the first axis.
  q << .3, .5, std::asin(-1.1 / .7 * std::sin(.5)) - .5, .6, .5, .7;
  std::vector<Hinge> upright = industrial();
  upright[1].origin = {0, 0, .7};
  upright[3] = {kNone, kZ};
  upright[4].origin = {0, 0, .7};
  upright[5].axis = kZ;
  const Arm tower(upright);
  const auto stretched = tower.closed.postures(tower.at(q), reference);
  ASSERT_FALSE(stretched.empty());
  for (const ClosedFormPosture& one : stretched) {
    ASSERT_NE(one.chosen, kNoJoint);
    EXPECT_EQ(tower.model[one.chosen].name, "j1");
    EXPECT_EQ(one.q[0], 0.25);
    EXPECT_LT((tower.at(one.q).p - tower.at(q).p).norm(), 1e-9);
  }
  // The last axis of the other kind is parallel to the three.
  const Arm parallel(parallelArm());
  q << .3, -.4, .5, .6, 0, .7;
  isTold = false;
  for (const ClosedFormPosture& one : parallel.closed.postures(parallel.at(q), reference)) {
    isTold = isTold || (one.chosen != kNoJoint && parallel.model[one.chosen].name == "j6");
    EXPECT_LT((parallel.at(one.q).p - parallel.at(q).p).norm(), 1e-9);
  }
  EXPECT_TRUE(isTold);
}

TEST(ClosedFormArm, FindsNothingBeyondReach) {
  const Arm arm(industrial());
  EXPECT_TRUE(
      arm.closed.postures({Eigen::Matrix3d::Identity(), {9, 0, 0}}, Eigen::VectorXd::Zero(6)).empty());
}

TEST(ClosedFormArm, KeepsLimitsAndListsTurns) {
  std::vector<Hinge> hinges = industrial();
  hinges[5].lower = -9;
  hinges[5].upper = 9;
  hinges[4].lower = 0;
  const Arm arm(hinges);
  Eigen::VectorXd q(6);
  q << .3, .4, -.5, .6, .8, 7;
  const Pose X_WT = arm.at(q);
  const auto all = arm.closed.postures(X_WT, q, {.withinLimits = false});
  const auto within = arm.closed.postures(X_WT, q);
  const auto turns = arm.closed.postures(X_WT, q, {.listsTurns = true});
  EXPECT_GT(all.size(), within.size());
  EXPECT_GT(turns.size(), within.size());
  ASSERT_FALSE(within.empty());
  double gap = 10;
  for (const ClosedFormPosture& one : within) gap = std::min(gap, (one.q - q).norm());
  EXPECT_LT(gap, 1e-9) << "the turn that is nearest to the reference";
  for (const ClosedFormPosture& one : turns) {
    EXPECT_TRUE((one.q.array() >= arm.model.lowerLimits().array()).all());
    EXPECT_TRUE((one.q.array() <= arm.model.upperLimits().array()).all());
    EXPECT_LT((arm.at(one.q).p - X_WT.p).norm(), 1e-9);
  }
}

using Status = InverseKinematicsResult::Status;

// The second opinions: all turns of all postures, of which none is nearer, and the numeric solver.
TEST(PoseTarget, TakesTheNearestPostureInClosedForm) {
  Rng rng(5);
  const Eigen::VectorXd lower = Eigen::VectorXd::Constant(6, -5), upper = -lower;
  for (std::vector<Hinge> hinges : {industrial(), parallelArm(), reversed(parallelArm()), randomWrist(rng)}) {
    for (Hinge& hinge : hinges) std::tie(hinge.lower, hinge.upper) = std::pair(-5, 5);
    const Arm arm(hinges);
    for (int k = 0; k < 20; ++k) {
      const Pose X_WT = arm.at(randomPosture(rng));
      const Eigen::VectorXd start = rng.uniformVector(6, -5, 5);
      const auto found = solveInverseKinematics(arm.model, {.body = arm.tip, .X_WB = X_WT}, start, {}, rng);
      ASSERT_EQ(found.status, Status::kSolved);
      EXPECT_EQ(found.message, "solved in closed form");
      const Pose X = arm.at(found.q);
      EXPECT_LT((X.R - X_WT.R).norm() + (X.p - X_WT.p).norm(), 1e-9);
      EXPECT_LT(found.residuals.at(0), 1e-9);
      EXPECT_TRUE((found.q.array() >= lower.array()).all() && (found.q.array() <= upper.array()).all());
      const double way = (found.q - start).norm();
      for (const auto& one : arm.closed.postures(X_WT, start, {.listsTurns = true}))
        EXPECT_LE(way, (one.q - start).norm() + 1e-9);
      const Task task{.name = "tip", .map = poseTask(arm.tip, X_WT), .tolerance = 1e-9};
      const auto numeric = solveInverseKinematics(arm.model, std::span(&task, 1), start, {}, rng);
      if (numeric.status == Status::kSolved) {
        EXPECT_LE(way, (numeric.q - start).norm() + 1e-6);
      }
    }
  }
}

TEST(PoseTarget, TakesThatOfTheAllowedPosturesWhichIsNearest) {
  const Arm arm(industrial());
  Rng rng(6);
  int chosenAnew = 0, refused = 0;
  for (int k = 0; k < 40; ++k) {
    const Pose X_WT = arm.at(randomPosture(rng));
    const Eigen::VectorXd start = randomPosture(rng);
    const auto isAllowed = [](const Eigen::VectorXd& q) { return q[1] > 0 && q[4] > 0; };
    const auto any = solveInverseKinematics(arm.model, {.body = arm.tip, .X_WB = X_WT}, start, {}, rng);
    const auto found = solveInverseKinematics(
        arm.model, {.body = arm.tip, .X_WB = X_WT, .isAllowed = isAllowed}, start, {.maxRestarts = 5}, rng);
    double least = HUGE_VAL;
    for (const ClosedFormPosture& one : arm.closed.postures(X_WT, start))
      if (isAllowed(one.q)) least = std::min(least, (one.q - start).norm());
    const Pose X = arm.at(found.q);
    EXPECT_LT((X.R - X_WT.R).norm() + (X.p - X_WT.p).norm(), 1e-5) << "even a refused posture leads there";
    if (std::isinf(least)) {
      EXPECT_EQ(found.status, Status::kRefused);
      EXPECT_FALSE(isAllowed(found.q));
      EXPECT_EQ(found.message.find("no posture that reaches the target is allowed: found after "), 0u);
      ++refused;
    } else {
      EXPECT_EQ(found.status, Status::kSolved);
      EXPECT_TRUE(isAllowed(found.q));
      EXPECT_NEAR((found.q - start).norm(), least, 1e-9);
      chosenAnew += found.q == any.q ? 0 : 1;
    }
  }
  EXPECT_GT(chosenAnew, 0);
  EXPECT_GT(refused, 0);
}

// Joints without limits turn the shorter way; those that do not move the tip stay.
TEST(PoseTarget, TurnsEndlessJointsTheShorterWay) {
  const Model model = chainOf(industrial(), {.1, .05, .2}, "continuous");
  const BodyId tip = model.body("tip");
  Eigen::VectorXd q(6), start(6);
  q << .3, .4, -.5, .6, .8, 11.5;
  start << .31, .39, -.52, .61, .79, 11.7;
  const Pose X_WT = forwardKinematics(model, q)[tip];
  Rng rng(7);
  const auto found = solveInverseKinematics(model, {.body = tip, .X_WB = X_WT}, start, {}, rng);
  EXPECT_LT((found.q - q).norm(), 1e-9);
}

// Also one that does not move the tip.
TEST(PoseTarget, BringsAStartBeyondTheLimitsBack) {
  std::string urdf = "<robot name='r'><link name='l0'/>";
  for (std::size_t i = 0; i < 6; ++i)
    urdf += fmt::format(
        "<link name='l{1}'/><joint name='j{1}' type='revolute'><parent link='l{0}'/><child link='l{1}'/>"
        "<origin xyz='{2}'/><axis xyz='{3}'/><limit lower='-3' upper='3' effort='1' velocity='1'/></joint>",
        i, i + 1, numbers(industrial()[i].origin), numbers(industrial()[i].axis));
  const Model model = compile(
      parseUrdf(
          urdf +
              "<link name='lid'/><joint name='hinge' type='revolute'><parent link='l0'/><child link='lid'/>"
              "<axis xyz='0 0 1'/><limit lower='-1' upper='1' effort='1' velocity='1'/></joint></robot>",
          "r.urdf")
          .spec);
  Eigen::VectorXd q = model.initialPositions(), start = Eigen::VectorXd::Constant(7, 5);
  Eigen::Index lid = 0;
  for (const Joint& joint : model.joints()) {
    if (joint.name == "hinge") lid = joint.qIndex;
    if (joint.nq > 0) q[joint.qIndex] = 0.1 * (1 + joint.qIndex);
  }
  Rng rng(12);
  const BodyId tip = model.body("l6");
  const auto found =
      solveInverseKinematics(model, {.body = tip, .X_WB = forwardKinematics(model, q)[tip]}, start, {}, rng);
  EXPECT_EQ(found.message, "solved in closed form");
  EXPECT_TRUE((found.q.array() <= model.upperLimits().array()).all()) << found.q.transpose();
  EXPECT_EQ(found.q[lid], 1);
}

TEST(PoseTarget, IsSearchedWhereThereIsNoClosedForm) {
  std::vector<Hinge> seven = industrial();
  seven.push_back({{.1, 0, 0}, kZ});
  const Model model = chainOf(seven, {.1, .05, .2});
  const BodyId tip = model.body("tip");
  Rng rng(8);
  for (int k = 0; k < 10; ++k) {
    const Pose X_WT = forwardKinematics(model, rng.uniformVector(7, -3, 3))[tip];
    const auto isAllowed = [](const Eigen::VectorXd& q) { return q[0] > 0; };
    const auto found = solveInverseKinematics(model, {.body = tip, .X_WB = X_WT, .isAllowed = isAllowed},
                                              Eigen::VectorXd::Zero(7), {}, rng);
    ASSERT_EQ(found.status, Status::kSolved) << found.message;
    EXPECT_GT(found.q[0], 0);
    const Pose X = forwardKinematics(model, found.q)[tip];
    EXPECT_LT((X.R - X_WT.R).norm() + (X.p - X_WT.p).norm(), 1e-5);
  }
}

// Nothing reaches: as near as the numeric solver comes.
TEST(PoseTarget, SaysHowFarOffItIs) {
  const Arm arm(industrial());
  Rng rng(9);
  const PoseTarget far{.body = arm.tip, .X_WB = {Eigen::Matrix3d::Identity(), {9, 0, 0}}};
  const auto found = solveInverseKinematics(arm.model, far, Eigen::VectorXd::Zero(6), {}, rng);
  EXPECT_NE(found.status, Status::kSolved);
  EXPECT_EQ(found.message.find("task 'tip' misses its target by"), 0u) << found.message;
  EXPECT_GT(found.residuals.at(0), 1);
}

TEST(PoseTarget, RefusesWhatIsNone) {
  const Arm arm(industrial());
  Rng rng(10);
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(6);
  const auto solve = [&](const PoseTarget& target, const Eigen::VectorXd& start) {
    static_cast<void>(solveInverseKinematics(arm.model, target, start, {}, rng));
  };
  EXPECT_REX_ERROR(solve({.body = arm.tip, .tolerance = 0}, zero),
                   "inverse kinematics: tolerance: found 0, wanted a positive, finite number");
  EXPECT_REX_ERROR(solve({.body = arm.tip}, Eigen::VectorXd::Zero(5)),
                   "start posture: found a vector of size 5, wanted size 6");
  EXPECT_REX_ERROR(solve({.body = arm.tip, .X_WB = {2 * Eigen::Matrix3d::Identity(), kX}}, zero),
                   "orientation of the tip: found no rotation matrix");
}

std::string reason(const Model& model) {
  std::string why;
  EXPECT_FALSE(ClosedFormArm::of(model, model.body("tip"), &why));
  return why;
}

TEST(ClosedFormArm, SaysWhyThereIsNone) {
  Rng rng(3);
  std::vector<Hinge> any = randomWrist(rng);
  any[5].origin = kX;
  EXPECT_EQ(reason(chainOf(any, kX)),
            "neither three of its axes meet at an end, nor three in the middle are parallel");
  // Three axes meet, but the last two are one.
  std::vector<Hinge> twice = industrial();
  twice[5].axis = twice[4].axis;
  EXPECT_EQ(reason(chainOf(twice, kX)),
            "neither three of its axes meet at an end, nor three in the middle are parallel");
  any.push_back({kX, kY});
  EXPECT_EQ(reason(chainOf(any, kX)), "7 joints move the tip, not six");
  EXPECT_EQ(reason(chainOf(industrial(), kX, "prismatic")), "joint 'j6' is no hinge");
  EXPECT_EQ(reason(chainOf(industrial(), kX, "revolute", "<mimic joint='j1'/>")),
            "joint 'j6' mimics another");
  EXPECT_EQ(
      reason(chainOf({{kNone, kX}, {kNone, kY}, {kNone, kZ}, {kNone, kX}, {kNone, kY}, {kNone, kZ}}, kX)),
      "all axes meet in a point");
}

TEST(ClosedFormArm, RefusesWhatIsNoPose) {
  const Arm arm(industrial());
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(6);
  EXPECT_REX_ERROR(static_cast<void>(arm.closed.postures({}, Eigen::VectorXd::Zero(5))),
                   "reference posture: found a vector of size 5, wanted size 6");
  EXPECT_REX_ERROR(static_cast<void>(arm.closed.postures({2 * Eigen::Matrix3d::Identity(), kX}, zero)),
                   "orientation of the tip: found no rotation matrix");
  EXPECT_REX_ERROR(static_cast<void>(arm.closed.postures({Eigen::Matrix3d::Identity(), {NAN, 0, 0}}, zero)),
                   "position of the tip: number 0: found nan");
  EXPECT_REX_ERROR(static_cast<void>(ClosedFormArm::of(arm.model, BodyId{99})),
                   "body of the tip: found number 99");
}

TEST(TrigonometricRoots, AreWhereTheSumIsZero) {
  Rng rng(4);
  for (int k = 0; k < 200; ++k) {
    const Eigen::VectorXd a = rng.normalVector(5);
    const auto sum = [&](double x) {
      return a[0] + a[1] * std::cos(x) + a[2] * std::sin(x) + a[3] * std::cos(2 * x) + a[4] * std::sin(2 * x);
    };
    std::array<double, 8> values;
    for (int i = 0; i < 8; ++i) values[static_cast<std::size_t>(i)] = sum(i * M_PI / 4);
    const auto roots = internal::rootsOfSecondOrder(values, 1e-12);
    for (const double x : roots) EXPECT_NEAR(sum(x), 0, 1e-12);
    int changes = 0;
    for (int i = 0; i < 10000; ++i)
      changes += (sum(i * 2 * M_PI / 10000) < 0) != (sum((i + 1) * 2 * M_PI / 10000) < 0);
    EXPECT_EQ(roots.count, changes);
  }
  const auto touching = internal::rootsOfSecondOrder(
      {0, 1 - std::sqrt(.5), 1, 1 + std::sqrt(.5), 2, 1 + std::sqrt(.5), 1, 1 - std::sqrt(.5)}, 1e-12);
  ASSERT_EQ(touching.count, 1);
  EXPECT_NEAR(touching.angle[0], 0, 1e-7);
}

}  // namespace rex::closed_form_arm_test
