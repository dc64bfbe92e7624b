#include "cli/robot/path_motion.h"

#include <cmath>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "planning/time_parametrization.h"
#include "scene/ors_reader.h"
#include "support/temporary_folder.h"

namespace rex::cli::path_motion_test {

using ::testing::StartsWith;

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
    const Motion motion = motionOf(timed, rate);
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
  const Motion motion = motionOf(rest, 30);
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
  const std::string table = csvOf(model, motion);
  EXPECT_THAT(table, StartsWith("time,\"slide [0]\",\"slide [1]\",\"slide [2]\",\"a, b\"\n0,0,0,0,0\n"));
  const TemporaryFolder folder;
  std::ofstream(folder.path() / "path.csv") << table;
  const Motion again = readMotion(model, folder.path() / "path.csv", 1 / motion.times.back());
  ASSERT_EQ(again.postures.size(), 2u);
  EXPECT_EQ(again.postures[1], motion.postures[1]);
}

}  // namespace rex::cli::path_motion_test
