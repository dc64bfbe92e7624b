#include "authoring/release.h"

#include <fstream>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/process.h"
#include "support/expect_error.h"
#include "support/file_text.h"
#include "support/temporary_folder.h"

namespace rex::authoring::release_test {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::Not;

class ReleaseTest : public ::testing::Test {
 protected:
  void SetUp() override {
    for (const char* file :
         {"CMakeLists.txt", "README.md", "LICENSE", ".clang-format", ".ci/run", "tests/a_test.cpp",
          "build/release/rex", "out/01-demo/results.json", "notes.txt", "share/cmake/a.cmake",
          "src/base/error.h", "data/robots/arm.ors", "scripts/rex", ".vscode/tasks.json", "scripts/test",
          "exercises/CMakeLists.txt", "exercises/01-demo/exercise.h", "exercises/01-demo/wrong.cpp",
          "exercises/01-demo/seen.txt"})
      write(file, file);
    write("exercises/01-demo/wrong.cpp", "// <variant thrice>\n// mistake: trebles the number.\n");
    write("exercises/01-demo/equal_mutants.tsv", "a\tb\tc\n");
    write("exercises/01-demo/README.md", "Write `twice`.\n");
    write("README.md", "Run scripts/rex.\nRun scripts/test.\n| `tests/` | tests |\n| `notes/` | notes |\n");
    write("exercises/01-demo/main.cpp", "out of date\n");
    write("exercises/01-demo/check.cpp", "visible();\n// <hidden>\nsecret();\n// </hidden>\n");
    write("exercises/01-demo/solution.cpp",
          "int twice(int a) {\n  // <solution twice>\n  return multiply(a, 2);\n  // <todo>\n  //| return "
          "0;\n  // </solution>\n}\n");
  }

  void write(const std::string& name, const std::string& text) {
    fs::create_directories((root() / name).parent_path());
    std::ofstream(root() / name) << text;
  }
  static std::string told(const Release& release) {
    return release.scan.leaks.empty() ? "no leak" : toString(release.scan.leaks.front());
  }
  std::string released() const { return told(writeStudentRelease(root(), target())); }
  fs::path root() const { return temporary_.path() / "root"; }
  fs::path target() const { return temporary_.path() / "target"; }
  std::string released(const std::string& name) const { return fileText(target() / name); }

  TemporaryFolder temporary_;
};

TEST_F(ReleaseTest, HoldsWhatStudentsNeedAndNothingElse) {
  const Release release = writeStudentRelease(root(), target());
  EXPECT_EQ(told(release), "no leak");
  EXPECT_EQ(release.exercises, 1);
  EXPECT_EQ(release.scan.files, 15);
  EXPECT_FALSE(release.secrets.empty());
  std::set<std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(target()))
    if (entry.is_regular_file()) files.insert(fs::relative(entry.path(), target()).string());
  EXPECT_THAT(files, ::testing::UnorderedElementsAre(
                         "CMakeLists.txt", "README.md", "LICENSE", ".clang-format", ".vscode/tasks.json",
                         "share/cmake/a.cmake", "src/base/error.h", "data/robots/arm.ors", "scripts/rex",
                         "exercises/CMakeLists.txt", "exercises/01-demo/exercise.h",
                         "exercises/01-demo/README.md", "exercises/01-demo/main.cpp",
                         "exercises/01-demo/starter.cpp", "exercises/01-demo/check.cpp"));
  EXPECT_EQ(released("exercises/01-demo/main.cpp"), "int twice(int a) {\n  return 0;\n}\n");
  EXPECT_EQ(released("exercises/01-demo/starter.cpp"), released("exercises/01-demo/main.cpp"));
  EXPECT_EQ(released("exercises/01-demo/check.cpp"), "visible();\n");
  EXPECT_EQ(released("README.md"), "Run scripts/rex.\n");
}

TEST_F(ReleaseTest, HoldsNoLecturersNotes) {
  const std::string question = "> Why does the doubling converge to the answer of the tutorial?\n";
  write("notes/01-demo.md",
        question + "\nBecause every step halves what is left of the interval.\nShort line.\n");
  write("exercises/01-demo/README.md", question + "Short line.\n");
  EXPECT_EQ(released(), "no leak");
  EXPECT_FALSE(fs::exists(target() / "notes"));
  fs::remove_all(target());
  write("share/hints.md", "\n\nbecause every step\nhalves what is left of the interval\n");
  EXPECT_EQ(released(), "no leak") << "the full stop is a letter, too";
  fs::remove_all(target());
  write("share/hints.md", "\n\nbecause every step\nhalves what is left of the interval.\n");
  EXPECT_EQ(released(),
            "share/hints.md:3: a line of the lecturer's notes would reach students: found 'Because every "
            "step halves "
            "what is left of the interval.' of notes/01-demo.md:3");
  EXPECT_FALSE(fs::exists(target()));
}

TEST_F(ReleaseTest, LeavesOutWhatResetKeeps) {
  write("exercises/01-demo/main.backup-1.cpp", "int twice(int a) { return a + a; }\n");
  EXPECT_EQ(released(), "no leak");
  EXPECT_FALSE(fs::exists(target() / "exercises/01-demo/main.backup-1.cpp"));
}

TEST_F(ReleaseTest, HoldsOnlyWhatGitKnows) {
  const auto git = [&](std::vector<std::string> words) {
    words.insert(words.begin(), {"git", "-C", root().string()});
    ASSERT_TRUE(runProcess(words).ok());
  };
  git({"init", "-q"});
  write(".gitignore", "*.csv\n");
  git({"add", "-A"});
  write("share/grades.csv", "zoe,20\n");
  write("exercises/01-demo/main.cpp", "changed since\n");
  EXPECT_EQ(released(), "no leak");
  EXPECT_FALSE(fs::exists(target() / "share/grades.csv"));
  EXPECT_FALSE(fs::exists(target() / ".git"));
  EXPECT_TRUE(fs::exists(target() / "src/base/error.h"));
  fs::remove_all(target());

  write("exercises/01-demo/exam-notes.txt", "ask for twice(3)\n");
  EXPECT_REX_ERROR(
      writeStudentRelease(root(), target()),
      "exercises/01-demo/exam-notes.txt: a file that git does not know would reach students: wanted "
      "git add, a line in .gitignore, or another folder");
  write("scripts/mine", "x\n");
  EXPECT_REX_ERROR(writeStudentRelease(root(), target()),
                   "exercises/01-demo/exam-notes.txt: 2 files that git does not know would reach students");
  write("notes/mine", "stays behind anyway\n");
  fs::remove(root() / "scripts/mine");
  git({"add", "exercises"});
  EXPECT_EQ(released(), "no leak");
  EXPECT_TRUE(fs::exists(target() / "exercises/01-demo/exam-notes.txt"));
}

TEST_F(ReleaseTest, NeedsAnAnswerOfGit) {
  write(".git/HEAD", "nothing\n");
  EXPECT_REX_ERROR(writeStudentRelease(root(), target()), "cannot ask git which files belong to the course");
  EXPECT_FALSE(fs::exists(target()));
}

TEST_F(ReleaseTest, MayLieInsideTheRoot) {
  EXPECT_EQ(told(writeStudentRelease(root(), root() / "out" / "students")), "no leak");
  EXPECT_TRUE(fs::exists(root() / "out/students/LICENSE"));
  EXPECT_FALSE(fs::exists(root() / "out/students/out"));
}

TEST_F(ReleaseTest, NeedsNoExercise) {
  fs::remove_all(root() / "exercises" / "01-demo");
  EXPECT_EQ(released(), "no leak");
  EXPECT_EQ(released("exercises/CMakeLists.txt"), "exercises/CMakeLists.txt");
}

TEST_F(ReleaseTest, KeepsWhatLiesInTheTarget) {
  fs::create_directories(target());
  EXPECT_EQ(released(), "no leak");
  EXPECT_REX_ERROR(writeStudentRelease(root(), target()),
                   "target: will not overwrite: wanted an empty or new folder");
}

TEST_F(ReleaseTest, RefusesSolutionTextHoweverItIsLaidOut) {
  write("exercises/01-demo/README.md", "Hint:\n\n    return multiply(\n      a, 2);\n");
  EXPECT_EQ(released(),
            "exercises/01-demo/README.md:3: a line of the solution would reach students: found 'return "
            "multiply(a, 2);' of exercises/01-demo/solution.cpp:3");
  EXPECT_FALSE(fs::exists(target()));
  write("exercises/01-demo/README.md", "\n");
  write("exercises/01-demo/check.cpp", "int expected(int a) { return multiply(a, 2); }\n");
  EXPECT_REX_ERROR(requireNoSolutionText(root() / "exercises/01-demo"),
                   "check.cpp:1: a line of the solution");
  write("exercises/01-demo/check.cpp",
        "// <hidden>\nint expected(int a) { return multiply(a, 2); }\n// </hidden>\n");
  EXPECT_NO_THROW(requireNoSolutionText(root() / "exercises/01-demo"));
  write("exercises/01-demo/show.cpp", "int shown(int a) { return multiply(a, 2); }\n");
  EXPECT_REX_ERROR(requireNoSolutionText(root() / "exercises/01-demo"), "show.cpp:1: a line of the solution");
  fs::remove(root() / "exercises/01-demo/show.cpp");
  write("exercises/01-demo/help.h", "  return multiply(a, 2);\n");
  EXPECT_REX_ERROR(requireNoSolutionText(root() / "exercises/01-demo"), "help.h:1: a line of the solution");
  fs::remove(root() / "exercises/01-demo/help.h");
  write("exercises/01-demo/solution.cpp",
        "// <solution twice>\n return multiply(a, 2);\n// <todo>\n//| // return multiply(a, 2);\n// "
        "</solution>\n");
  EXPECT_REX_ERROR(requireNoSolutionText(root() / "exercises/01-demo"), "main.cpp:1: a line of the solution");
}

TEST_F(ReleaseTest, RefusesSolutionTextInAnyFileButTheLibrary) {
  for (const char* file :
       {"share/doc/writing.md", "exercises/01-demo/exercise.h", "exercises/01-demo/exercise.toml",
        "exercises/README.md", "scripts/rex", "README.md"}) {
    write(file, "one\n  return multiply(a, 2);\n");
    EXPECT_THAT(released(), HasSubstr(std::string(file) + ":2: a line of the solution would reach students"));
    EXPECT_FALSE(fs::exists(target())) << file;
    write(file, "one\n");
  }
  write("src/base/error.h", "return multiply(a, 2);\n");
  EXPECT_EQ(released(), "no leak");
}

TEST_F(ReleaseTest, TakesTheTemplateForPublic) {
  write("share/template/solution.cpp", "return multiply(a, 2);\n");
  write("share/doc/writing.md", "return multiply(a, 2);\n");
  EXPECT_EQ(released(), "no leak");
}

TEST_F(ReleaseTest, LooksForTheSecretOfTheCourse) {
  write("secret", "the secret of the course\n");
  write("src/base/error.h", "// THE SECRET of the course\n");
  const Release release = writeStudentRelease(root(), target(), root() / "secret");
  EXPECT_EQ(told(release), "src/base/error.h:1: the secret of the course would reach students: found of " +
                               (root() / "secret").string() + ":1");
  EXPECT_FALSE(fs::exists(target()));
}

TEST_F(ReleaseTest, SaysWhatItCannotWrite) {
  EXPECT_REX_ERROR(writeStudentRelease(root(), "/proc/students"), "cannot write the student release: found ");
  write("file", "");
  EXPECT_REX_ERROR(writeStudentRelease(root(), root() / "file" / "students"), "file");
}

TEST_F(ReleaseTest, PassesOnComplaintsAboutMarkers) {
  write("exercises/01-demo/check.cpp", "// <hidden>\n");
  EXPECT_REX_ERROR(writeStudentRelease(root(), target()), "check.cpp:1:5: no '// </hidden>' closes this");
}

}  // namespace rex::authoring::release_test
