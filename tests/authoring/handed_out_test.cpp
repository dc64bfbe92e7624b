#include "authoring/handed_out.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/text_file.h"
#include "support/paths.h"
#include "support/temporary_folder.h"

namespace rex::authoring::handed_out_test {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

constexpr const char* kDescription =
    "title = \"A\"\nscript = \"1\"\n[[part]]\nid = \"a\"\ntitle = \"A\"\npoints = 1\n";

TEST(MissingDescriptions, NameEachFileAndWhatItLacks) {
  const TemporaryFolder folder;
  const fs::path root = folder.path();
  writeTextFile(root / "exercises/19-demo/exercise.toml", kDescription);
  writeTextFile(root / "exercises/20-own/exercise.toml",
                "profile = \"private\"\n" + std::string(kDescription));
  const auto missing = [&] {
    return missingDescriptions(root, submission::readExerciseInfo(root / "exercises/19-demo"));
  };
  EXPECT_THAT(
      missing(),
      ElementsAre(
          "exercises/19-demo/README.md: missing: questions for the tutorial, '## Discuss in the tutorial'",
          "notes/19-demo.md: missing: answers to these questions, each below the question as a quotation, "
          "'>'",
          "share/doc/exercises.md: missing: a row of the exercise, '| `19-demo` |'",
          "share/doc/course-map.md: missing: the parts that practise a slide, '`19`'",
          "share/doc/teaching.md: missing: a week in the plan, '`19-demo`'",
          "share/ci/github-actions.yml: missing: a step of the exercise, 'name: 19-demo,'",
          "share/ci/gitlab-ci.yml: missing: a job of the exercise, '19-demo:'",
          "README.md: missing: the number of exercises, '[1 exercises]'"));
  writeTextFile(root / "exercises/19-demo/README.md", "# 19\n\n## Discuss in the tutorial\n\n- Why?\n");
  writeTextFile(root / "notes/19-demo.md", "# 19\n\n> Why?\n");
  writeTextFile(root / "share/doc/exercises.md", "|\n| `19-demo` | x |\n");
  writeTextFile(root / "share/doc/course-map.md", "| `19` 1 |\n");
  writeTextFile(root / "share/doc/teaching.md", "| `19-demo` |\n");
  writeTextFile(root / "share/ci/github-actions.yml", "- {name: 19-demo, run: x}\n");
  writeTextFile(root / "share/ci/gitlab-ci.yml", "x:\n19-demo: {}\n");
  writeTextFile(root / "README.md", "[1 exercises](share/doc/exercises.md)\n");
  EXPECT_THAT(missing(), IsEmpty());
}

TEST(MissingDescriptions, AreNoneOfTheCourse) {
  for (const submission::ExerciseInfo& one : submission::listExercises(sourcePath("exercises")))
    EXPECT_THAT(missingDescriptions(sourcePath("."), one), IsEmpty()) << one.name;
}

}  // namespace rex::authoring::handed_out_test
