#include "cli/robot/path_search.h"

#include <algorithm>
#include <cmath>
#include <csignal>
#include <limits>

#include <gtest/gtest.h>

#include "base/interruption.h"
#include "collision/contacts.h"
#include "formats/ors_reader.h"
#include "planning/robot_problem.h"
#include "support/expect_error.h"
#include "support/paths.h"

namespace rex::cli::path_search_test {

PathTask taskOf(const Model& model, const VectorArg& start, const VectorArg& goal, double margin = 0.01) {
  const ContactModel contacts(model);
  return {model, contacts, robotProblem(model, contacts, start, goal, margin, 0.02)};
}

// The arm comes around the board and from below to the ball.
PathTask boardTask(double margin = 0.01) {
  const Model model = compile(readOrs(sourcePath("data/scenes/board.ors")).spec);
  return taskOf(model, model.initialPositions(), Eigen::Vector3d(1.5, -1.1, -1), margin);
}

PathSearch searchBy(Planner planner) {
  return {.planner = planner, .samples = growsTrees(planner) ? 3000 : 300};
}

double nearestAt(const PathTask& task, const VectorArg& q) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const Proxy& proxy : proxies(task.contacts, forwardKinematics(task.model, q), 10))
    nearest = std::min(nearest, proxy.proximity.distance);
  return nearest;
}

class EachPlanner : public ::testing::TestWithParam<Planner> {};

TEST_P(EachPlanner, FindsAWayThatIsClear) {
  const PathTask task = boardTask();
  const FoundPath found = searchPath(task, searchBy(GetParam()), 1);
  ASSERT_TRUE(found.isFound());
  EXPECT_EQ(found.path.col(0), task.problem.start);
  const Eigen::VectorXd last = found.path.col(found.path.cols() - 1);
  EXPECT_LT(task.problem.space.distance(last, task.problem.goal), 1e-12);
  double nearest = std::numeric_limits<double>::infinity();
  Eigen::VectorXd q(3);
  for (Eigen::Index k = 1; k < found.path.cols(); ++k) {
    for (int i = 0; i <= 50; ++i) {
      task.problem.space.interpolate(found.path.col(k - 1), found.path.col(k), i / 50., q);
      nearest = std::min(nearest, nearestAt(task, q));
    }
  }
  EXPECT_GT(found.clearance.atLeast, 0);
  EXPECT_LE(found.clearance.atLeast, nearest + 1e-12);
  EXPECT_GT(found.clearance.atLeast, nearest - 5e-3);
}

TEST_P(EachPlanner, TellsWhatItExplored) {
  const PathTask task = boardTask();
  const FoundPath found = searchPath(task, searchBy(GetParam()), 2);
  ASSERT_EQ(found.explored.size(), GetParam() == Planner::kRrtConnect ? 2u : 1u);
  Eigen::Index nodes = 0;
  for (const PathGraph& graph : found.explored) {
    nodes += graph.nodes.cols();
    if (growsTrees(GetParam())) {
      EXPECT_EQ(static_cast<Eigen::Index>(graph.edges.size()), graph.nodes.cols() - 1);
    }
    EXPECT_GT(graph.edges.size(), 3u);
    for (const auto& [a, b] : graph.edges) {
      EXPECT_NE(a, b);
      EXPECT_GE(std::min(a, b), 0);
      EXPECT_LT(std::max(a, b), graph.nodes.cols());
    }
  }
  EXPECT_EQ(found.nodes, nodes);
  EXPECT_GT(found.samples, 0);
  EXPECT_LE(found.samples, searchBy(GetParam()).samples);
}

TEST_P(EachPlanner, FindsTheSameWithTheSameSeed) {
  const PathTask task = boardTask();
  const PathSearch search = searchBy(GetParam());
  const FoundPath once = searchPath(task, search, 3), twice = searchPath(task, search, 3);
  EXPECT_EQ(once.path, twice.path);
  EXPECT_EQ(once.checks, twice.checks);
  const Eigen::MatrixXd other = searchPath(task, search, 4).path;
  EXPECT_FALSE(other.cols() == once.path.cols() && other == once.path);
}

INSTANTIATE_TEST_SUITE_P(All, EachPlanner,
                         ::testing::Values(Planner::kRrt, Planner::kRrtConnect, Planner::kRrtStar,
                                           Planner::kPrm, Planner::kPrmStar, Planner::kLazyPrm));

TEST(PathSearch, CountsWhatItAsksFor) {
  PathTask task = boardTask();
  long asked = 0;
  task.problem.allValid = [inner = task.problem.allValid, &asked](const MatrixArg& Q) {
    asked += Q.cols();
    return inner(Q);
  };
  for (const Planner planner : {Planner::kRrtConnect, Planner::kPrm}) {
    asked = 0;
    EXPECT_EQ(searchPath(task, searchBy(planner), 1).checks, asked);
    EXPECT_GT(asked, 100);
  }
}

TEST(PathSearch, SmoothsUnlessToldOtherwise) {
  const PathTask task = boardTask();
  PathSearch search = searchBy(Planner::kRrtConnect);
  const FoundPath smooth = searchPath(task, search, 1);
  search.smooth = false;
  const FoundPath rough = searchPath(task, search, 1);
  EXPECT_EQ(rough.plannedLength, smooth.plannedLength);
  EXPECT_DOUBLE_EQ(rough.length, rough.plannedLength);
  EXPECT_LT(smooth.length, 0.9 * rough.length);
  EXPECT_EQ(rough.explored[0].nodes, smooth.explored[0].nodes);
  for (Eigen::Index k = 1; k < rough.path.cols(); ++k)
    EXPECT_LE((rough.path.col(k) - rough.path.col(k - 1)).norm(), search.step + 1e-12);
}

TEST(PathSearch, SaysWhatAFailureExplored) {
  const PathTask task = boardTask();
  for (const Planner planner : {Planner::kRrtConnect, Planner::kPrm}) {
    PathSearch search = searchBy(planner);
    search.samples = 1;
    const FoundPath found = searchPath(task, search, 1);
    EXPECT_FALSE(found.isFound());
    EXPECT_EQ(found.samples, 1);
    EXPECT_GE(found.nodes, 2);
    EXPECT_GT(found.checks, 0);
  }
}

// A stick on a hinge without limits that goes from 3 to -3 the short way: through pi.
TEST(PathSearch, GivesAnglesThatRunOn) {
  const Model model =
      compile(parseOrs("body stand {} body stick { type=ST_capsule size=[0 0 1 .1] contact }\n"
                       "body ball { X=<T t(1.5 0 0)> type=1 size=[0 0 0 .2] contact }\n"
                       "joint (stand stick) { type=hingeZ B=<T t(.5 0 0) d(90 0 1 0)> }\n",
                       "stick.ors")
                  .spec);
  const Eigen::VectorXd three = Eigen::VectorXd::Constant(1, 3);
  const FoundPath found = searchPath(taskOf(model, three, -three), {}, 0);
  ASSERT_TRUE(found.isFound());
  EXPECT_NEAR(found.path(0, found.path.cols() - 1), 2 * M_PI - 3, 1e-12);
  for (Eigen::Index k = 1; k < found.path.cols(); ++k)
    EXPECT_LT(std::abs(found.path(0, k) - found.path(0, k - 1)), 0.31);
}

TEST(PathSearch, KeepsTheShortestOfSeveral) {
  const PathTask task = boardTask();
  const FoundPaths found = searchPaths(task, searchBy(Planner::kRrtConnect), 5, 6);
  ASSERT_EQ(found.all.size(), 6u);
  EXPECT_EQ(found.successes(), 6);
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_EQ(found.all[i].seed, 5 + i);
    EXPECT_GE(found.all[i].length, found.shortest().length);
    EXPECT_EQ(found.all[i].explored.empty(), i != found.best);
  }
  EXPECT_EQ(found.shortest().path,
            searchPath(task, searchBy(Planner::kRrtConnect), found.shortest().seed).path);
}

TEST(PathSearch, KeepsTheFirstFailureUntilOneFinds) {
  const PathTask task = boardTask();
  PathSearch search = searchBy(Planner::kRrtConnect);
  search.samples = 3;
  const FoundPaths none = searchPaths(task, search, 0, 3);
  EXPECT_EQ(none.successes(), 0);
  EXPECT_EQ(none.best, 0u);
  EXPECT_FALSE(none.shortest().explored.empty());
  search.samples = 30;  // enough for some seeds
  const FoundPaths some = searchPaths(task, search, 0, 20);
  EXPECT_GT(some.successes(), 0);
  EXPECT_LT(some.successes(), 20);
  EXPECT_TRUE(some.shortest().isFound());
}

TEST(PathSearch, StopsWhenTheUserWants) {
  const HeldSignals held;
  ASSERT_EQ(std::raise(SIGTERM), 0);
  EXPECT_THROW(static_cast<void>(searchPath(boardTask(), searchBy(Planner::kRrtStar), 1)), Interrupted);
}

TEST(PathSearch, NamesAllPlanners) {
  EXPECT_EQ(toString(Planner::kPrmStar), "prm-star");
  for (const auto& [name, planner] : plannerNames()) {
    EXPECT_EQ(toString(planner), name);
    EXPECT_EQ(drawsSamples(planner), name.find("rrt") != name.npos || name.find("prm") != name.npos) << name;
  }
}

}  // namespace rex::cli::path_search_test
