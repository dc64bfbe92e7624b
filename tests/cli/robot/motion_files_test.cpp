// Pictures and files of motions.
#include "cli/robot/motion_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "formats/ors_reader.h"
#include "kinematics/forward_kinematics.h"
#include "support/expect_error.h"
#include "support/paths.h"

namespace rex::cli::motion_files_test {

using Eigen::Vector3d;
using ::testing::HasSubstr;

class Pictures : public ::testing::Test {
 protected:
  const Model arm = compile(readOrs(sourcePath("data/robots/pegArm.ors")).spec);
  // The whole arm turns, then hangs below the ground.
  const Motion motion = moveThrough(arm, {Vector3d(0, 0, 0), Vector3d(2, 0, 0)}, 0.2, 30);
};

TEST_F(Pictures, HaveTheWaysUpToTheirMoments) {
  const MotionPictures pictures(arm, motion, {0, 2, 6}, {"peg", "arm1"}, "up");
  ASSERT_EQ(pictures.size(), 3u);
  EXPECT_EQ(pictures.time(1), motion.times[2]);
  EXPECT_TRUE(pictures.picture(0).polylines.empty());
  const Picture picture = pictures.picture(1);
  ASSERT_EQ(picture.polylines.size(), 2u);
  ASSERT_EQ(picture.polylines[0].points.size(), 3u);
  const Vector3d p_WPeg = forwardKinematics(arm, motion.postures[1])[arm.body("peg")].p;
  EXPECT_EQ(picture.polylines[0].points[1], p_WPeg);
  ASSERT_EQ(picture.captions.size(), 1u);
  EXPECT_EQ(picture.captions[0].text, "up");
}

TEST_F(Pictures, AgreeWithTheirFilm) {
  const MotionPictures pictures(arm, motion, {0, 3, 6}, {"peg"}, "");
  Film film = pictures.film();
  ASSERT_EQ(film.size(), 3u);
  EXPECT_EQ(film[1].time, pictures.time(1));
  EXPECT_EQ(film[1].picture.polylines.size(), 1u);
  EXPECT_TRUE(film[1].picture.captions.empty());
  const Ground ground = film[1].picture.ground;
  settleGround(film);
  EXPECT_EQ(film[1].picture.ground.height, ground.height);
  EXPECT_LT((film[1].picture.ground.scene.high - ground.scene.high).norm(), 1e-12);
  const Bounds box = bounds(film);
  EXPECT_LT((box.low - pictures.bounds().low).norm() + (box.high - pictures.bounds().high).norm(), 1e-12);
}

// The way down shows how far the arm sinks below a floor of the scene.
TEST_F(Pictures, HaveTheGroundOfTheScene) {
  EXPECT_LT(MotionPictures(arm, motion, {0, 6}, {}, "").picture(0).ground.height, 0);
  SceneSpec spec = readOrs(sourcePath("data/robots/pegArm.ors")).spec;
  spec.worldShapes.push_back(
      {.name = "floor", .X_BS = translation(0, 0, -0.45), .shape = {}, .ground = true});
  const MotionPictures pictures(compile(spec), motion, {0, 6}, {}, "");
  EXPECT_NEAR(pictures.picture(0).ground.height, 0.05, 1e-12);
  EXPECT_NEAR(pictures.picture(1).ground.height, 0.05, 1e-12);
}

TEST_F(Pictures, TellUnknownBodies) {
  EXPECT_REX_ERROR(MotionPictures(arm, motion, {0}, {"pge"}, ""), "--trace: scene");
  EXPECT_REX_ERROR(MotionPictures(arm, motion, {0}, {"pge"}, ""), "has no body 'pge' (did you mean 'peg'?)");
}

TEST(FilmSpeed, IsThatAskedForUnlessTheFilmWouldBeTooLong) {
  testing::internal::CaptureStderr();
  EXPECT_EQ(filmSpeed(1, kLongestFilm), 1);
  EXPECT_EQ(filmSpeed(.5, kLongestFilm / 2), .5);
  EXPECT_EQ(filmSpeed(7, 1), 7);
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  testing::internal::CaptureStderr();
  EXPECT_DOUBLE_EQ(filmSpeed(.5, 3 * kLongestFilm), 3);
  EXPECT_THAT(testing::internal::GetCapturedStderr(),
              HasSubstr("the film plays 3 times as fast as the motion, so that it lasts 120 s"));
}

TEST(ResultFolder, IsNotCalledLikeAFile) {
  EXPECT_NO_THROW(requireFolderName("out/run-1.5", "a folder"));
  EXPECT_REX_ERROR(requireFolderName("out/a.mp4", "a folder"),
                   "-o out/a.mp4: found the name of a file, wanted a folder");
  EXPECT_REX_ERROR(makeResultFolder("a.csv", {"b.csv"}, "frames"), "-o a.csv: found the name of a file");
}

}  // namespace rex::cli::motion_files_test
