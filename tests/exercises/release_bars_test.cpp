// What exercise/student-release left behind, which runs before: the tree that students get, built on its own,
// in which every exercise ran and was graded without a display.
#include <algorithm>
#include <fstream>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/process.h"
#include "render/image.h"
#include "submission/exercise_info.h"
#include "support/file_text.h"
#include "support/paths.h"
#include "support/registered_tests.h"
#include "support/temporary_folder.h"

namespace rex::release_bars_test {

namespace fs = std::filesystem;

const fs::path kRelease = buildPath("student release"), kProof = buildPath("proof of the release");

bool isUniform(const Image& image) {
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      if (image.at(x, y) != image.at(0, 0)) return false;
  return true;
}

std::vector<fs::path> picturesIn(const fs::path& folder) {
  std::vector<fs::path> pictures;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.path().extension() == ".png") pictures.push_back(entry.path());
  return pictures;
}

class AcceptanceBars : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!fs::exists(kProof / "out/passed")) GTEST_SKIP() << "needs the test exercise/student-release";
  }
  std::vector<submission::ExerciseInfo> exercises_ = submission::listExercises(sourcePath("exercises"));
};

TEST_F(AcceptanceBars, Bar02EveryExerciseDrawsPicturesWithoutADisplay) {
  for (const submission::ExerciseInfo& exercise : exercises_) {
    const std::vector<fs::path> pictures = picturesIn(kProof / "out" / exercise.name);
    EXPECT_FALSE(pictures.empty()) << exercise.name;
    for (const fs::path& picture : pictures) EXPECT_FALSE(isUniform(readPng(picture))) << picture;
  }
}

// A camera that looks away, and no display.
TEST_F(AcceptanceBars, Bar02APictureOfNothingFailsTheRun) {
  const TemporaryFolder folder;
  const std::string picture = (folder.path() / "nothing.png").string();
  const auto draw = [&](const std::string& camera) {
    return runProcess({"env", "-u", "DISPLAY", "-u", "WAYLAND_DISPLAY", buildPath("rex-robot"), "render",
                       "man", "--camera", camera, "-o", picture});
  };
  const ProcessResult away = draw("0,0,50@0,0,100");
  EXPECT_EQ(away.exitCode, 64);
  EXPECT_THAT(away.error, ::testing::HasSubstr("nothing of the scene in view"));
  EXPECT_FALSE(fs::exists(picture));
  const ProcessResult front = draw("front");
  ASSERT_EQ(front.exitCode, 0) << front.error;
  EXPECT_FALSE(isUniform(readPng(picture)));
}

// Full scores and floors are gates of each exercise, which ctest runs by name. The release is looked at once
// more, by other means than its own scan: no longer line of a solution that no open file has.
TEST_F(AcceptanceBars, Bar03SolutionsStartersAndReleaseAreGated) {
  const std::string tests = registeredTests();
  const auto textBelow = [](const fs::path& folder) {
    std::string text;
    for (const auto& entry : fs::recursive_directory_iterator(folder))
      if (entry.is_regular_file()) text += fileText(entry.path()) + "\n";
    return text;
  };
  const std::string all = textBelow(kRelease / "exercises");
  std::string open;
  for (const submission::ExerciseInfo& exercise : exercises_)
    for (const char* file : {"main.cpp", "README.md", "exercise.h", "check.cpp"})
      open += fileText(exercise.folder / file);
  for (const submission::ExerciseInfo& exercise : exercises_) {
    for (const char* gate : {"solution", "main-floor", "release"})
      EXPECT_THAT(tests, ::testing::HasSubstr("exercise/" + exercise.name + "/" + gate + "\n"));
    const std::string own = textBelow(kRelease / "exercises" / exercise.name);
    std::istringstream solution(fileText(exercise.folder / "solution.cpp"));
    int secret = 0;
    for (std::string line; std::getline(solution, line);) {
      constexpr std::size_t kTelling = 30, kTellingElsewhere = 60;  // letters; shorter ones occur by chance
      line.erase(0, line.find_first_not_of(' '));
      if (line.size() < kTelling || open.find(line) != open.npos || line.starts_with("//")) continue;
      ++secret;
      const std::string& text = line.size() < kTellingElsewhere ? own : all;
      EXPECT_EQ(text.find(line), text.npos) << exercise.name << ": " << line;
    }
    EXPECT_GT(secret, 0) << exercise.name;
  }
}

}  // namespace rex::release_bars_test
