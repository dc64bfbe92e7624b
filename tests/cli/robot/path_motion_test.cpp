#include "cli/robot/path_motion.h"

#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scene/ors_reader.h"
#include "support/temporary_folder.h"

namespace rex::cli::path_motion_test {

using ::testing::StartsWith;

const Space kPlane = Space::box(Eigen::Vector2d(-9, -9), Eigen::Vector2d(9, 9));

// Three metres and four metres around a corner, with the corner twice.
Eigen::MatrixXd corner() {
  Eigen::MatrixXd path(2, 4);
  path << 0, 3, 3, 3, 0, 0, 0, 4;
  return path;
}

TEST(TimedPath, HasAllCornersAndASteadySpeed) {
  const Motion motion = timedPath(kPlane, corner(), 2, 0.4);
  ASSERT_EQ(motion.times.size(), motion.postures.size());
  ASSERT_EQ(motion.times.size(), 1u + 4 + 5);
  EXPECT_EQ(motion.times.front(), 0);
  EXPECT_DOUBLE_EQ(motion.times.back(), 3.5);
  EXPECT_EQ(motion.postures[4], Eigen::Vector2d(3, 0));
  EXPECT_EQ(motion.postures.back(), Eigen::Vector2d(3, 4));
  for (std::size_t i = 1; i < motion.times.size(); ++i) {
    const double seconds = motion.times[i] - motion.times[i - 1];
    EXPECT_GT(seconds, 0);
    EXPECT_LE(seconds, 0.4 + 1e-12);
    EXPECT_NEAR((motion.postures[i] - motion.postures[i - 1]).norm(), 2 * seconds, 1e-12);
  }
}

TEST(TimedPath, RestsWhereNothingMoves) {
  const Motion motion = timedPath(kPlane, Eigen::MatrixXd::Ones(2, 3), 1, 0.1);
  EXPECT_EQ(motion.times, std::vector<double>{0});
  EXPECT_EQ(motion.postures[0], Eigen::Vector2d(1, 1));
  EXPECT_EQ(resampled(kPlane, motion, 30).times, std::vector<double>{0});
}

TEST(Resampled, LiesOnTheWays) {
  const Motion even = resampled(kPlane, timedPath(kPlane, corner(), 2, 0.4), 4);
  ASSERT_EQ(even.times.size(), 15u);
  for (std::size_t i = 0; i < even.times.size(); ++i) {
    EXPECT_EQ(even.times[i], static_cast<double>(i) / 4);
    const double way = 2 * even.times[i];
    const Eigen::Vector2d expected = way < 3 ? Eigen::Vector2d(way, 0) : Eigen::Vector2d(3, way - 3);
    EXPECT_LT((even.postures[i] - expected).norm(), 1e-12) << i;
  }
  EXPECT_EQ(resampled(kPlane, timedPath(kPlane, corner(), 2, 0.4), 3).postures.back(), Eigen::Vector2d(3, 4));
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
  Eigen::MatrixXd path(4, 2);
  path << 0, 1, 0, 2, 0, -1. / 3, 0, 0.1;
  const Motion motion =
      timedPath(Space::box(Eigen::Vector4d::Constant(-5), Eigen::Vector4d::Constant(5)), path, 1, 10);
  const std::string table = csvOf(model, motion);
  EXPECT_THAT(table, StartsWith("time,\"slide [0]\",\"slide [1]\",\"slide [2]\",\"a, b\"\n0,0,0,0,0\n"));
  const TemporaryFolder folder;
  std::ofstream(folder.path() / "path.csv") << table;
  const Motion again = readMotion(model, folder.path() / "path.csv", 1 / motion.times.back());
  ASSERT_EQ(again.postures.size(), 2u);
  EXPECT_EQ(again.postures[1], path.col(1));
}

}  // namespace rex::cli::path_motion_test
