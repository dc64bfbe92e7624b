// `rex dev viva`: questions about a file that a person handed in, as a lecturer reads them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "commands/built_project.h"

namespace rex::cli::dev_viva_test {

using ::testing::HasSubstr;
using ::testing::StartsWith;

class DevViva : public BuiltProject {};

TEST_F(DevViva, AsksAndAnswers) {
  const fs::path file = root() / "hand-in" / "main.cpp";
  fs::create_directories(file.parent_path());
  write(file, fileText(exercise() / "solution.cpp"));
  const Ended ended = rex({"dev", "viva", "98", file.string()});
  EXPECT_EQ(ended.code, 0) << ended.error;
  EXPECT_THAT(ended.output, StartsWith("1. Line 13, in rotated:\n     const double c = std::cos(angle);\n"
                                       "   If it were\n     "));
  EXPECT_THAT(flat(ended.output), HasSubstr("which check would fail first, and why? Answer: A quarter turn "
                                            "[quarter-turn]. "));
  EXPECT_THAT(ended.output, HasSubstr("\n3. Line "));
}

TEST_F(DevViva, SaysWhatIsMissing) {
  EXPECT_THAT(flat(rex({"dev", "viva", "98"}).error), HasSubstr("FILE is required"));
  EXPECT_THAT(flat(rex({"dev", "viva", "98", "none.cpp"}).error),
              HasSubstr("none.cpp: FILE: found no such file, wanted the main.cpp that was handed in"));
  EXPECT_THAT(flat(rex({"dev", "viva", "98", exercise().string()}).error), HasSubstr("FILE: found a folder"));
  EXPECT_THAT(flat(rex({"dev", "viva", "98", (exercise() / "main.cpp").string()}).error),
              HasSubstr("found a file that passes no visible check"));
}

}  // namespace rex::cli::dev_viva_test
