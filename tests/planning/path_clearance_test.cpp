#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "base/rng.h"
#include "collision/contacts.h"
#include "formats/ors_reader.h"
#include "planning/robot_problem.h"
#include "planning/rrt.h"
#include "planning/smooth_path.h"
#include "support/expect_error.h"
#include "support/paths.h"
#include "support/rounds.h"

namespace rex::path_clearance_test {

Model scene(const std::string& text) { return compile(parseOrs(text, "scene.ors").spec); }

double nearestAt(const Model& model, const ContactModel& contacts, const VectorArg& q) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const Proxy& proxy : proxies(contacts, forwardKinematics(model, q)))
    nearest = std::min(nearest, proxy.proximity.distance);
  return nearest;
}

// At points of the way by the space's own interpolation, far more than a planner looks at.
double leastOfManyPoints(const Model& model, const ContactModel& contacts, const Space& space,
                         const Eigen::MatrixXd& path) {
  double least = nearestAt(model, contacts, path.col(0));
  Eigen::VectorXd q(space.size());
  for (Eigen::Index k = 1; k < path.cols(); ++k) {
    for (int i = 1; i <= 200; ++i) {
      space.interpolate(path.col(k - 1), path.col(k), i / 200., q);
      least = std::min(least, nearestAt(model, contacts, q));
    }
  }
  return least;
}

TEST(PathClearance, IsThatOfAStickBesideABall) {
  const Model model = scene(
      "body stand {} body stick { type=ST_capsule size=[0 0 1 .1] contact }\n"
      "body ball { X=<T t(1.5 0 0)> type=1 size=[0 0 0 .2] contact }\n"
      "joint (stand stick) { type=hingeZ B=<T t(.5 0 0) d(90 0 1 0)> }\n");
  const ContactModel contacts(model);
  const Space space = postureSpace(model);
  Eigen::MatrixXd beside(1, 2), past(1, 2), still(1, 1);
  beside << .5, 2;
  past << -.1, 2 * M_PI + .2;
  still << 0;
  const double apart = std::hypot(1.5 - std::cos(.5), std::sin(.5)) - .3;
  EXPECT_NEAR(pathClearance(model, contacts, space, beside, 1e-6).atLeast, apart, 2e-6);
  EXPECT_NEAR(pathClearance(model, contacts, space, past, 1e-6).atLeast, .2, 2e-6) << "the shorter way round";
  EXPECT_NEAR(pathClearance(model, contacts, space, still, 1e-6).atLeast, .2, 2e-6);
  EXPECT_REX_ERROR(static_cast<void>(pathClearance(model, contacts, space, Eigen::MatrixXd(1, 0))),
                   "path: found no postures, wanted at least one");
  EXPECT_REX_ERROR(static_cast<void>(pathClearance(model, contacts, space, Eigen::MatrixXd::Zero(2, 2))),
                   "postures of a path: found a vector of size 2, wanted size 1");
}

TEST(PathClearance, TakesAQuaternionAndItsOppositeForOneRotation) {
  const Model model = scene(
      "body stand {} body stick { type=ST_capsule size=[0 0 1 .1] contact }\n"
      "body ball { X=<T t(0 0 1.5)> type=1 size=[0 0 0 .2] contact }\n"
      "joint (stand stick) { type=quatBall B=<T t(0 0 .5)> }\n");
  const ContactModel contacts(model);
  Eigen::MatrixXd path(4, 2);
  path << std::cos(.1), -std::cos(.3), std::sin(.1), -std::sin(.3), 0, 0, 0, 0;
  const double apart = std::hypot(1.5 - std::cos(.2), std::sin(.2)) - .3;
  EXPECT_NEAR(pathClearance(model, contacts, postureSpace(model), path, 1e-6).atLeast, apart, 2e-6);
}

// Where a slider and a ball joint move at once, the arc of the quaternions and their chord meet other
// postures.
TEST(PathClearance, FollowsTheArcOfABallJointOnACart) {
  const Model model = scene(
      "body rail {} body cart {} body stick { type=ST_capsule size=[0 0 2 .05] contact }\n"
      "body ball { X=<T t(1 1.5 .9)> type=1 size=[0 0 0 .2] contact }\n"
      "joint (rail cart) { type=transX limits=[0 3] }\n"
      "joint (cart stick) { type=quatBall B=<T t(0 0 1)> }\n");
  const ContactModel contacts(model);
  const Space space = postureSpace(model);
  double most = 0;
  for (const double angle : {2., 2.5, 170 * M_PI / 180}) {
    Eigen::MatrixXd path(5, 2);
    path << 0, 2, std::cos(.2), std::cos(.2 - angle / 2), std::sin(.2), std::sin(.2 - angle / 2), 0, 0, 0, 0;
    const ClearanceBounds bounds = pathClearance(model, contacts, space, path, 1e-5);
    Eigen::VectorXd q(5);
    double least = 9;
    for (int i = 0; i <= 4000; ++i) {
      space.interpolate(path.col(0), path.col(1), i / 4000., q);
      least = std::min(least, nearestAt(model, contacts, q));
    }
    EXPECT_LE(bounds.atLeast, least + 1e-5);
    EXPECT_NEAR(bounds.atLeast, least, 2e-5) << angle;
    EXPECT_LE(bounds.atMost - bounds.atLeast, 1e-5);
    const double onChord = motionClearance(model, contacts, path.col(0), path.col(1), 1e-5);
    most = std::max(most, std::abs(onChord - least));
  }
  EXPECT_GT(most, .01) << "else the test tells them not apart";
}

// So long a way beside a plate that the distances run out.
TEST(PathClearance, SaysHowMuchIsProven) {
  const Model model = scene(
      "body rail {} body ball { type=1 size=[0 0 0 .05] contact }\n"
      "body plate { X=<T t(0 0 -.101)> type=0 size=[3000 1 .1 0] contact }\n"
      "joint slide (rail ball) { type=transX limits=[-1000 1000] }\n");
  const ContactModel contacts(model);
  Eigen::MatrixXd path(1, 2);
  path << -900, 900;
  const ClearanceBounds bounds = pathClearance(model, contacts, postureSpace(model), path, 1e-4);
  EXPECT_LT(bounds.atLeast, .001);
  EXPECT_NEAR(bounds.atMost, .001, 1e-6);
  EXPECT_GT(bounds.atMost - bounds.atLeast, 1e-4) << "not proven";
  const ClearanceBounds shorter = pathClearance(model, contacts, postureSpace(model), path / 100, 1e-4);
  EXPECT_NEAR(shorter.atLeast, .001, 1e-4);
  EXPECT_LE(shorter.atMost - shorter.atLeast, 1e-4);
}

// What a planner looked at in points stays clear in between: the margin is more than the arm moves there.
// A twentieth of the seeds will do where sanitizers make everything slow.
TEST(PathClearance, ProvesPathsOfTheArmThatFitsAPegIntoAHole) {
#ifdef __SANITIZE_ADDRESS__
  const int seeds = 5;
#else
  const int seeds = rounds(21, 100);
#endif
  const Model model = compile(readOrs(sourcePath("data/robots/pegInAHole.ors")).spec);
  const ContactModel contacts(model);
  Eigen::VectorXd goal(7);
  goal << 0.945499, 0.431195, -1.97155, 0.623969, 2.22355, -0.665206, -1.48356;
  const PathProblem problem = robotProblem(model, contacts, Eigen::VectorXd::Zero(7), goal, .02, .05);
  for (int seed = 0; seed < seeds; ++seed) {
    Rng rng(static_cast<std::uint64_t>(seed));
    const PathResult found = connectRrts(problem, {.stepSize = .3, .maxSamples = 300000}, rng);
    ASSERT_EQ(found.status, PathStatus::kFound) << found.message;
    const Eigen::MatrixXd path = shortcut(problem, found.path, 100, rng);
    const double clearance = pathClearance(model, contacts, problem.space, path).atLeast;
    EXPECT_GT(clearance, 0) << seed;
    if (seed % 20 != 0) continue;
    const double sampled = leastOfManyPoints(model, contacts, problem.space, path);
    EXPECT_LE(clearance, sampled + 1e-12);
    EXPECT_GT(clearance, sampled - 2e-3);
  }
}

}  // namespace rex::path_clearance_test
