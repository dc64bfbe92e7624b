#include "planning/robot_problem.h"

#include <limits>

#include <gtest/gtest.h>

#include "base/rng.h"
#include "collision/contacts.h"
#include "formats/ors_reader.h"
#include "planning/rrt.h"
#include "support/expect_error.h"
#include "support/paths.h"

namespace rex::robot_problem_test {

using Kind = SpacePart::Kind;

Model scene(const std::string& text) { return compile(parseOrs(text, "scene.ors").spec); }
Model pegInAHole() { return compile(readOrs(sourcePath("data/robots/pegInAHole.ors")).spec); }

// Where the exercise of slide 4:42 sends the peg (erratum 28).
Eigen::VectorXd pegInTheHole() {
  Eigen::VectorXd q(7);
  q << 0.945499, 0.431195, -1.97155, 0.623969, 2.22355, -0.665206, -1.48356;
  return q;
}

PathProblem pegProblem(const Model& model, const ContactModel& contacts) {
  PathProblem problem = robotProblem(model, contacts, Eigen::VectorXd::Zero(7), pegInTheHole(), .02, .05);
  problem.space = Space::box(Eigen::VectorXd::Constant(7, -2 * M_PI), Eigen::VectorXd::Constant(7, 2 * M_PI));
  return problem;
}

TEST(PostureSpace, FollowsLimitsAndKindsOfJoints) {
  const Model model = scene(
      "body a {} body b {} body c {} body d {} body e {}\n"
      "joint (a b) { type=hingeX limits=[-1 2] }\n"
      "joint (b c) { type=hingeX A=<T t(1 2 3)> }\n"
      "joint (c d) { type=quatBall }\n"
      "joint (d e) { type=transX limits=[0 3] }\n");
  const Space space = postureSpace(model);
  ASSERT_EQ(space.parts().size(), 4u);
  EXPECT_EQ(space.size(), 7);
  EXPECT_EQ(space.parts()[0].kind, Kind::kLine);
  EXPECT_EQ(space.parts()[0].upper, 2);
  EXPECT_EQ(space.parts()[1].kind, Kind::kCircle);
  EXPECT_EQ(space.parts()[2].kind, Kind::kQuaternion);
  EXPECT_EQ(space.parts()[3].upper, 3);
  EXPECT_REX_ERROR(
      static_cast<void>(postureSpace(scene("body a {} body b {} joint rail (a b) { type=transX }"))),
      "joint 'rail': found limits -inf and inf, wanted finite limits");
}

TEST(ContactFree, SaysWhatDistancesSay) {
  const Model model = pegInAHole();
  const ContactModel contacts(model);
  const AllValid isFree = contactFree(model, contacts, .02);
  Rng rng(1);
  int free = 0;
  for (int i = 0; i < 300; ++i) {
    const Eigen::MatrixXd Q = Eigen::MatrixXd::NullaryExpr(7, 1, [&] { return rng.uniform(-2, 2); });
    double nearest = std::numeric_limits<double>::infinity();
    for (const Proxy& proxy : proxies(contacts, forwardKinematics(model, Q)))
      nearest = std::min(nearest, proxy.proximity.distance);
    EXPECT_EQ(isFree(Q), nearest >= .02);
    free += nearest >= .02 ? 1 : 0;
  }
  EXPECT_GT(free, 30);
  EXPECT_LT(free, 290);
}

TEST(RobotProblem, SaysWhichShapesAreInTheWay) {
  const Model model = pegInAHole();
  const ContactModel contacts(model);
  Eigen::VectorXd inside = pegInTheHole();
  inside[1] += .2;
  PathProblem problem = pegProblem(model, contacts);
  problem.goal = inside;
  Rng rng(1);
  EXPECT_REX_ERROR(static_cast<void>(connectRrts(problem, {}, rng)), "in overlap, wanted a valid one");
  EXPECT_EQ(nearestContact(scene("body a { type=1 size=[0 0 0 1] contact }"),
                           ContactModel(scene("body a { type=1 size=[0 0 0 1] contact }")), Eigen::VectorXd())
                .text,
            "all shapes apart");
}

}  // namespace rex::robot_problem_test
