// What is made of a path that was found: its motion with times, a summary, pictures and plots.
#include "cli/robot/path_results.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cli/robot/path_search.h"
#include "collision/contacts.h"
#include "formats/ors_reader.h"
#include "formats/scene_file.h"
#include "kinematics/forward_kinematics.h"
#include "planning/robot_problem.h"
#include "planning/time_parametrization.h"
#include "support/paths.h"
#include "support/temporary_folder.h"

namespace rex::cli::path_results_test {

using Eigen::Vector3d;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

class BoardPictures : public ::testing::Test {
 protected:
  Vector3d placeOf(const VectorArg& q) const { return forwardKinematics(model, q)[body].p; }

  const Model model = compile(readScene(sourcePath("data/scenes/board.ors")).spec);
  const ContactModel contacts{model};
  const PathTask task{model, contacts,
                      robotProblem(model, contacts, model.initialPositions(), Vector3d(1.5, -1.1, -1))};
  const BodyId body = model.body("eff");
  const FoundPath found = searchPath(task, {}, 0);
};

TEST_F(BoardPictures, ShowTheTreesInTheWorkspace) {
  const Picture picture = exploredPicture(task, body, found);
  ASSERT_EQ(picture.lineSets.size(), 2u);
  EXPECT_NE(picture.lineSets[0].color, picture.lineSets[1].color);
  for (std::size_t i = 0; i < 2; ++i) {
    const auto& [nodes, edges] = found.explored[i];
    const auto& segments = picture.lineSets[i].segments;
    EXPECT_GE(segments.size(), edges.size());
    for (const auto& [a, b] : edges) {  // each way begins and ends where kinematics says
      const Vector3d p_WA = placeOf(nodes.col(a)), p_WB = placeOf(nodes.col(b));
      EXPECT_TRUE(std::ranges::any_of(segments, [&](const auto& one) { return one.first == p_WA; }));
      EXPECT_TRUE(
          std::ranges::any_of(segments, [&](const auto& one) { return (one.second - p_WB).norm() < 1e-12; }));
    }
    for (const auto& [from, to] : segments) EXPECT_LT((from - to).norm(), 0.2);
  }
}

TEST_F(BoardPictures, ShowThePathFromStartToGoal) {
  const Picture picture = exploredPicture(task, body, found);
  ASSERT_EQ(picture.polylines.size(), 1u);
  const auto& points = picture.polylines[0].points;
  EXPECT_EQ(points.front(), placeOf(task.problem.start));
  EXPECT_LT((points.back() - placeOf(task.problem.goal)).norm(), 1e-9);
  for (std::size_t i = 1; i < points.size(); ++i) EXPECT_LT((points[i] - points[i - 1]).norm(), 0.04);
  ASSERT_EQ(picture.pointSets.size(), 1u);
  EXPECT_EQ(picture.pointSets[0].points[1], placeOf(task.problem.goal));
  const long faint = std::ranges::count_if(picture.solids, [](const Solid& one) { return one.color.a < 1; });
  EXPECT_EQ(faint, 3) << "the links at the goal, but nothing that stands still";
}

TEST_F(BoardPictures, ShowNoPathWhereNoneWasFound) {
  const FoundPath none = searchPath(task, {.samples = 3}, 0);
  ASSERT_FALSE(none.isFound());
  const Picture picture = exploredPicture(task, body, none);
  EXPECT_TRUE(picture.polylines.empty());
  EXPECT_FALSE(picture.lineSets[0].segments.empty());
}

TEST_F(BoardPictures, PlotJointsAndClearance) {
  const Motion motion{.times = {0, 1}, .postures = {task.problem.start, task.problem.goal}};
  const Figure joints = jointsFigure(model, motion);
  ASSERT_EQ(joints.series.size(), 3u);
  EXPECT_EQ(joints.series[1].label, "arm1>arm2");
  EXPECT_EQ(joints.series[1].y[1], -1.1);
  const Figure clearance = clearanceFigure(model, contacts, motion, 0.01);
  double nearest = 10;
  for (const Proxy& proxy : proxies(contacts, forwardKinematics(model, task.problem.goal), 10))
    nearest = std::min(nearest, proxy.proximity.distance);
  EXPECT_DOUBLE_EQ(clearance.series[0].y[1], nearest);
  EXPECT_EQ(clearance.horizontalLines[0].at, 0.01);
}

TEST_F(BoardPictures, PlotSpeedsAsSharesOfTheirLimits) {
  const MotionLimits limits = jointLimits(model, {.velocity = 2}).limits;
  const TimedPath timed = parametrizeTime(found.curve, limits).motion;
  const Figure speeds = speedsFigure(timed, limits);
  ASSERT_EQ(speeds.series.size(), 3u);
  EXPECT_EQ(speeds.series[1].label, "arm1>arm2");
  EXPECT_EQ(speeds.horizontalLines.at(0).at, 1);
  double most = 0;
  for (const Series& series : speeds.series) {
    EXPECT_EQ(series.x.back(), timed.duration());
    EXPECT_EQ(series.y.front(), 0);
    EXPECT_NEAR(series.y.back(), 0, 1e-12);
    most = std::max(most, *std::ranges::max_element(series.y));
  }
  EXPECT_GT(most, .95);
  EXPECT_LE(most, 1.01);
  const std::size_t middle = speeds.series[0].x.size() / 2;
  EXPECT_DOUBLE_EQ(speeds.series[2].y[middle], std::abs(timed.at(speeds.series[2].x[middle]).v[2]) / 2);
}

TEST(FarthestBody, HangsOnMostJoints) {
  const auto farthest = [](const char* file) {
    const Model model = compile(readScene(sourcePath(file)).spec);
    return model[farthestBody(model)].name;
  };
  EXPECT_EQ(farthest("data/scenes/maze.ors"), "cart");
  EXPECT_EQ(farthest("data/robots/pegInAHole.ors"), "peg");
  EXPECT_EQ(farthest("data/robots/arm7dof/arm7dof.urdf"), "flange");
}

// Three metres and four metres around a corner, at which it stops.
TimedPath aroundACorner() {
  Eigen::MatrixXd path(2, 3);
  path << 0, 3, 3, 0, 0, 4;
  const Space plane = Space::box(Eigen::Vector2d(-9, -9), Eigen::Vector2d(9, 9));
  return parametrizeTime(straightCurve(plane, path),
                         {.velocity = Eigen::Vector2d(2, 2), .acceleration = Eigen::Vector2d(4, 4)})
      .motion;
}

TEST(PathMotion, HasEvenTimesAndTheEnd) {
  const TimedPath timed = aroundACorner();
  ASSERT_NEAR(timed.duration(), 3.5 + 2 * .5, .01);
  for (const double rate : {4., 30., 1 / timed.duration()}) {
    const Motion motion = sampledMotion(timed, rate);
    ASSERT_EQ(motion.times.size(), motion.postures.size());
    EXPECT_EQ(motion.times.size(), static_cast<std::size_t>(std::ceil(timed.duration() * rate - 1e-9)) + 1);
    EXPECT_EQ(motion.times.back(), timed.duration());
    EXPECT_EQ(motion.postures.front(), Eigen::Vector2d(0, 0));
    EXPECT_EQ(motion.postures.back(), Eigen::Vector2d(3, 4));
    for (std::size_t i = 0; i + 1 < motion.times.size(); ++i) {
      EXPECT_EQ(motion.times[i], static_cast<double>(i) / rate);
      EXPECT_LT(motion.times[i], motion.times[i + 1]);
      EXPECT_EQ(motion.postures[i], timed.at(motion.times[i]).q);
    }
  }
}

TEST(PathMotion, RestsWhereNothingMoves) {
  const TimedPath rest({.start = Eigen::Vector2d(1, 1)}, {}, {});
  const Motion motion = sampledMotion(rest, 30);
  EXPECT_EQ(motion.times, std::vector<double>{0});
  EXPECT_EQ(motion.postures[0], Eigen::Vector2d(1, 1));
}

TEST(PathTable, IsAMotionForOtherCommands) {
  SceneSpec spec = parseOrs(
                       "body a {} body b {} body c {}\n"
                       "joint slide (a b) { type=transXYPhi limits=[-5 5 -5 5 -5 5] }\n"
                       "joint turn (b c) { type=hingeX }\n",
                       "x.ors")
                       .spec;
  spec.joints[1].name = "a, b";
  const Model model = compile(spec);
  const Motion motion{.times = {0, 2.5},
                      .postures = {Eigen::Vector4d::Zero(), Eigen::Vector4d(1, 2, -1. / 3, 0.1)}};
  const std::string table = motionCsv(model, motion);
  EXPECT_THAT(table, StartsWith("time,\"slide [0]\",\"slide [1]\",\"slide [2]\",\"a, b\"\n0,0,0,0,0\n"));
  const TemporaryFolder folder;
  std::ofstream(folder.path() / "path.csv") << table;
  const Motion again = readMotion(model, folder.path() / "path.csv", 1 / motion.times.back());
  ASSERT_EQ(again.postures.size(), 2u);
  EXPECT_EQ(again.postures[1], motion.postures[1]);
}

// Joints of which the first `limited` have limits of velocity and effort.
PathTask chain(int joints, int limited) {
  std::string text = "body b0 { mass=1 }\n";
  for (int i = 1; i <= joints; ++i)
    text += "body b" + std::to_string(i) + " { mass=1 }\njoint j" + std::to_string(i) + " (b" +
            std::to_string(i - 1) + " b" + std::to_string(i) + ") { type=hingeX limits=[-3 3] }\n";
  SceneSpec spec = parseOrs(text, "chain").spec;
  for (std::size_t i = 0; i < static_cast<std::size_t>(limited); ++i)
    spec.joints[i].maxVelocity = 2, spec.joints[i].maxEffort = 100;
  Model model = compile(spec);
  ContactModel contacts(model);
  PathProblem problem =
      robotProblem(model, contacts, Eigen::VectorXd::Zero(joints), Eigen::VectorXd::Ones(joints));
  return {std::move(model), std::move(contacts), std::move(problem)};
}

PathTiming timed(const PathTask& task, const PlanOptions& options) {
  FoundPath found;
  Eigen::MatrixXd path(task.model.nq(), 2);
  path << task.problem.start, task.problem.goal;
  found.curve = straightCurve(task.problem.space, path);
  return timePath(task, options, found);
}

TEST(PathTiming, KeepsToTheScene) {
  const PathTask task = chain(1, 1);
  const PathTiming timing = timed(task, {.ramp = .25});
  ASSERT_TRUE(timing.isFound());
  EXPECT_NEAR(timing.result.motion.duration(), .5 + .25, 1e-3);
  EXPECT_EQ(assumedLimits(timing, {}), "");
  EXPECT_EQ(limitsText(timing, {.ramp = .25}),
            "velocities of the scene; accelerations that reach them in 0.25 s");
  EXPECT_EQ(limitsText(timing, {.effort = true}),
            "velocities of the scene; accelerations that reach them in 0.5 s; efforts of the scene");
}

TEST(PathTiming, SaysWhatItAssumes) {
  const PlanOptions options{.velocity = .7, .effort = true};
  EXPECT_EQ(
      assumedLimits(timed(chain(2, 1), options), options),
      "no velocity limit for 'j2': assuming 0.7 rad/s or m/s, see --velocity; no effort limit for 'j2': "
      "assuming any effort");
  EXPECT_EQ(
      limitsText(timed(chain(2, 1), options), options),
      "velocities of the scene, for 1 of 2 coordinates 0.7 rad/s or m/s; accelerations that reach them in "
      "0.5 s; efforts of the scene");
  EXPECT_EQ(assumedLimits(timed(chain(8, 0), {}), {}),
            "no velocity limit for 'j1', 'j2', 'j3', 'j4', 'j5', 'j6' and 2 more: assuming 1 rad/s or m/s, "
            "see --velocity");
  EXPECT_EQ(limitsText(timed(chain(2, 0), {}), {}),
            "velocities 1 rad/s or m/s; accelerations that reach them in 0.5 s");
}

class Summary : public ::testing::Test {
 protected:
  // A metre at 1 m/s, which is reached after half a second.
  PathTiming timing() const {
    FoundPath found;
    found.curve = straightCurve(task.problem.space, Eigen::RowVector2d(0, 1));
    return timePath(task, options, found);
  }
  static FoundPath path(std::uint64_t seed, double length) {
    return {.seed = seed,
            .path = Eigen::MatrixXd::Zero(1, 2),
            .length = length,
            .plannedLength = 2 * length,
            .clearance = {0.02, 0.0201},
            .samples = 9,
            .nodes = static_cast<int>(seed),
            .checks = 100,
            .planningTime = 0.25,
            .smoothingTime = 0.001};
  }

  const Model model = compile(parseOrs("body a {} body b {} joint (a b) { limits=[-1 1] }", "pole").spec);
  const ContactModel contacts{model};
  const PathTask task{model, contacts,
                      robotProblem(model, contacts, Eigen::VectorXd::Zero(1), Eigen::VectorXd::Ones(1))};
  PlanOptions options{.margin = .01, .resolution = .02};
};

TEST_F(Summary, TellsOfOneSearch) {
  EXPECT_EQ(pathSummary(task, options, {.all = {path(7, 3)}}, timing()),
            "pole, rrt-connect, seed 7: found a path\n"
            "explored   7 nodes of 9 samples, 100 configurations checked\n"
            "CPU time   250.0 ms for planning, 1.0 ms for smoothing\n"
            "length     3.000, before smoothing 6.000\n"
            "duration   1.500 s, at least 1.000 s from the velocity limits alone; no stop on the way\n"
            "limits     velocities 1 rad/s or m/s; accelerations that reach them in 0.5 s\n"
            "clearance  0.0200 m all along the path, margin 0.01 m");
  FoundPath free = path(7, 3);
  constexpr double kEndless = std::numeric_limits<double>::infinity();
  free.clearance = {kEndless, kEndless};
  EXPECT_THAT(pathSummary(task, options, {.all = {free}}, timing()), HasSubstr("nothing can collide"));
  FoundPath open = path(7, 3);
  open.clearance = {-0.01, 0.02};
  EXPECT_THAT(pathSummary(task, options, {.all = {open}}, timing()),
              HasSubstr("-0.0100 m all along the path is proven, 0.0200 m measured, margin"));
  EXPECT_EQ(pathSummary(task, options, {.all = {{.samples = 4, .nodes = 2, .checks = 5}}}, {}),
            "pole, rrt-connect, seed 0: no path within the budget of --samples\n"
            "explored   2 nodes of 4 samples, 5 configurations checked\n"
            "CPU time   0.0 ms for planning");
}

TEST_F(Summary, TellsWhyThereIsNoMotion) {
  PathTiming none;
  none.result.message = "no motion along the path: at s = 0 of 1: too heavy";
  EXPECT_THAT(pathSummary(task, options, {.all = {path(7, 3)}}, none),
              HasSubstr("\nduration   none: no motion along the path: at s = 0 of 1: too heavy\n"));
}

TEST_F(Summary, TellsOfSeveralInATable) {
  const FoundPaths found{.all = {path(1, 9), {.seed = 2, .nodes = 50}, path(3, 4), path(4, 6)}, .best = 2};
  const std::string text = pathSummary(task, options, found, timing());
  EXPECT_THAT(text, HasSubstr("pole, rrt-connect, seeds 1 to 4: 3 of 4 found a path\n"));
  EXPECT_THAT(text, HasSubstr("\nnodes                           1        3.5         50\n"));
  EXPECT_THAT(text, HasSubstr("\nlength                          4          6          9\n"));
  EXPECT_THAT(text, HasSubstr("\nshortest: seed 3\nduration   1.500 s, at least 1.000 s"));
  const std::string none = pathSummary(task, options, {.all = {FoundPath{}, FoundPath{}}}, {});
  EXPECT_THAT(none, HasSubstr("0 of 2 found a path"));
  EXPECT_THAT(none, HasSubstr("nodes"));
  EXPECT_THAT(none, Not(HasSubstr("length")));
  EXPECT_THAT(none, Not(HasSubstr("shortest")));
}

}  // namespace rex::cli::path_results_test
