#include "cli/robot/motion_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/expect_error.h"

namespace rex::cli::motion_files_test {

using ::testing::HasSubstr;

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
