#include "planning/path_clearance.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "base/rng.h"
#include "collision/contacts.h"
#include "planning/robot_problem.h"
#include "planning/rrt.h"
#include "planning/smooth_path.h"
#include "scene/ors_reader.h"
#include "support/expect_error.h"
#include "support/paths.h"

namespace rex {
namespace {

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
  EXPECT_NEAR(pathClearance(model, contacts, space, beside, 1e-6), apart, 2e-6);
  EXPECT_NEAR(pathClearance(model, contacts, space, past, 1e-6), .2, 2e-6) << "the shorter way round";
  EXPECT_NEAR(pathClearance(model, contacts, space, still, 1e-6), .2, 2e-6);
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
  EXPECT_NEAR(pathClearance(model, contacts, postureSpace(model), path, 1e-6), apart, 2e-6);
}

// What a planner looked at in points stays clear in between: the margin is more than the arm moves there.
TEST(PathClearance, ProvesPathsOfTheArmThatFitsAPegIntoAHole) {
  const Model model = compile(readOrs(sourcePath("data/robots/pegInAHole.ors")).spec);
  const ContactModel contacts(model);
  Eigen::VectorXd goal(7);
  goal << 0.945499, 0.431195, -1.97155, 0.623969, 2.22355, -0.665206, -1.48356;
  PathProblem problem = robotProblem(model, contacts, Eigen::VectorXd::Zero(7), goal, .02, .05);
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    Rng rng(seed);
    const PathResult found = connectRrts(problem, {.stepSize = .3, .maxSamples = 300000}, rng);
    ASSERT_EQ(found.status, PathStatus::kFound) << found.message;
    const Eigen::MatrixXd path = shortcut(problem, found.path, 100, rng);
    const double clearance = pathClearance(model, contacts, problem.space, path);
    const double sampled = leastOfManyPoints(model, contacts, problem.space, path);
    EXPECT_GT(clearance, 0);
    EXPECT_LE(clearance, sampled + 1e-12);
    EXPECT_GT(clearance, sampled - 2e-3);
  }
}

}  // namespace
}  // namespace rex
