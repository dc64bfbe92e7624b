#include "cli/robot/path_pictures.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "collision/contacts.h"
#include "kinematics/forward_kinematics.h"
#include "planning/robot_problem.h"
#include "planning/time_parametrization.h"
#include "scene/scene_file.h"
#include "support/paths.h"

namespace rex::cli::path_pictures_test {

using Eigen::Vector3d;

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

}  // namespace rex::cli::path_pictures_test
