#include "submission/student_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/text_file.h"
#include "support/paths.h"
#include "support/temporary_folder.h"

namespace rex::submission::student_files_test {

namespace fs = std::filesystem;
using ::testing::ElementsAre;

void write(const fs::path& file, const std::string& text) {
  fs::create_directories(file.parent_path());
  writeTextFile(file, text);
}

TEST(StudentFiles, AreThoseThatShownSourcesIncludeOrName) {
  const TemporaryFolder folder;
  const fs::path exercise = folder.path();
  for (const char* name :
       {"README.md", "exercise.toml", "starter.cpp", "solution.cpp", "wrong.cpp", "seen.txt",
        "equal_mutants.tsv", "answers.csv", "checks.h", "other.cpp", "deep.h", "pictures/b.png"})
    write(exercise / name, "");
  write(exercise / "README.md",
        "![a room](pictures/a.png), not seen.txt, equal_mutants.tsv, checks.h or check.cpp\n");
  write(exercise / "pictures/a.png", "");
  write(exercise / "room.csv", "");
  write(exercise / "exercise.h", "#include \"course/course.h\"\n#include <vector>\n#include \"../out.h\"\n");
  write(exercise / "main.cpp", "#include \"exercise.h\"\n# include \"show.h\"\n// #include \"checks.h\"\n");
  write(exercise / "show.cpp", "#include \"show.h\"\nconst char* text = \"room.csv\";\n");
  write(exercise / "show.h", "#include \"world.h\"\n");
  write(exercise / "world.h", "#include \"./deep.h\"\n#include \"show.h\"\n");
  write(exercise / "check.cpp", "#include \"checks.h\"\n");
  EXPECT_THAT(studentFiles(exercise),
              ElementsAre("README.md", "deep.h", "exercise.h", "exercise.toml", "main.cpp", "pictures/a.png",
                          "room.csv", "show.cpp", "show.h", "starter.cpp", "world.h"));
}

// What `rex init` and packages hand out, so that nobody adds a header of checks to it unseen.
TEST(StudentFiles, HoldNoHeaderOfChecks) {
  int exercises = 0;
  for (const auto& entry : fs::directory_iterator(sourcePath("exercises"))) {
    if (!entry.is_directory()) continue;
    ++exercises;
    for (const fs::path& name : studentFiles(entry.path())) {
      const std::string text = name.string();
      EXPECT_EQ(text.find("check"), text.npos) << entry.path() << ": " << text;
      EXPECT_EQ(text.find("reference"), text.npos) << entry.path() << ": " << text;
      EXPECT_EQ(readTextFile(entry.path() / name).find("grading/"), text.npos)
          << entry.path() << ": " << text;
    }
  }
  EXPECT_GE(exercises, 20);
}

}  // namespace rex::submission::student_files_test
