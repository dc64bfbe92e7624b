// What `rex dev new 97-made exercise.h` makes of tests/authoring/made/exercise.h: the other files there, of
// which the build has made the grader.
#include "authoring/new_exercise.h"

#include <cstdlib>
#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "authoring/gates.h"
#include "base/text_file.h"
#include "submission/exercise_info.h"
#include "support/file_text.h"
#include "support/paths.h"
#include "support/temporary_folder.h"

namespace rex::authoring::new_exercise_test {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

const fs::path kMade = sourcePath("tests/authoring/made");

GateResult pass(const fs::path& folder, const std::string& gate) {
  const TemporaryFolder work;
  return runGate({.root = sourcePath("."),
                  .exercise = submission::readExerciseInfo(folder),
                  .toolchain = submission::readToolchain(buildPath("tests/made/build.json")),
                  .workFolder = work.path()},
                 gate);
}

TEST(NewExercise, IsMadeOfAHeader) {
  for (const auto& [name, text] : exerciseFor(fileText(kMade / "exercise.h"), "exercise.h", "97-made")) {
    if (std::getenv("REX_UPDATE_GOLDEN") != nullptr) writeTextFile(kMade / name, text);
    EXPECT_EQ(fileText(kMade / name), text) << name << "; REX_UPDATE_GOLDEN=1 rewrites it";
  }
}

// All that does not need the author: the stub and the frame of the solution compile and run, and pass
// nothing.
TEST(NewExercise, PassesTheGatesThatNeedNoSolution) {
  for (const char* gate : {"main-current", "names", "release", "points", "main-floor", "mains"}) {
    const GateResult result = pass(kMade, gate);
    EXPECT_TRUE(result.passed) << gate << ": " << result.message;
  }
}

TEST(NewExercise, FailsEachCheckUntilThereIsASolution) {
  const GateResult result = pass(kMade, "solution");
  EXPECT_FALSE(result.passed);
  EXPECT_THAT(result.message, HasSubstr("solution.cpp scores 0 of 20 under seed 1"));
}

TEST(NewExercise, HasItsNameInTheTemplate) {
  const ExerciseFiles files = templateExercise(sourcePath("."), "97-made");
  EXPECT_THAT(files.at("main.cpp"), HasSubstr("// Your solution of 97-made."));
  EXPECT_EQ(buildLine(files, "97-made"), "rex_exercise(97-made FUNCTIONS rotated)\n");
}

}  // namespace rex::authoring::new_exercise_test
