#include "cli/robot/motion_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

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
              HasSubstr("the film is 3 times as fast as the motion, to last 120 s"));
}

}  // namespace rex::cli::motion_files_test
