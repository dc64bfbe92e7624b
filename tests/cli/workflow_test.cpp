#include <fstream>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <stdlib.h>

#include "cli/command_line.h"
#include "support/file_text.h"
#include "support/temporary_folder.h"

namespace rex::cli {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr const char* kGood = R"(#include "exercise.h"
#include <cmath>
Eigen::Vector2d rotated(const Eigen::Vector2d& p, double a) {
  return {std::cos(a) * p.x() - std::sin(a) * p.y(), std::sin(a) * p.x() + std::cos(a) * p.y()};
}
int main() {}
)";

struct Ended {
  int code = 0;
  std::string output, error;
};

// The words of a message, however its lines are broken.
std::string flat(const std::string& text) {
  std::istringstream words(text);
  std::string joined;
  for (std::string word; words >> word;) joined += (joined.empty() ? "" : " ") + word;
  return joined;
}

// A project of one exercise, made from the template in a folder of its own; its grader was built beforehand.
class WorkflowTest : public ::testing::Test {
 protected:
  void SetUp() override {
    for (const char* folder : {"exercises", "share", "src"}) fs::create_directories(root() / folder);
    fs::copy(REX_BINARY_DIR "/tests/template/source", exercise(), fs::copy_options::recursive);
    fs::copy(REX_SOURCE_DIR "/src/geometry", root() / "src" / "geometry");
    fs::copy(REX_SOURCE_DIR "/share/template", root() / "share" / "template", fs::copy_options::recursive);
    // Older than the grader, which would be built anew otherwise.
    for (const auto& entry : fs::recursive_directory_iterator(exercise()))
      fs::last_write_time(entry.path(), fs::file_time_type::clock::now() - std::chrono::hours(24 * 365 * 20));
    EXPECT_EQ(rex({"dev", "strip", "98"}).code, 0);
  }

  fs::path root() const { return temporary_.path(); }
  fs::path exercise() const { return root() / "exercises" / "98-template"; }
  fs::path out() const { return root() / "out" / "98-template"; }

  Ended rexIn(const fs::path& build, std::vector<std::string> arguments) const {
    std::vector<const char*> argv = {"rex"};
    for (const std::string& argument : arguments) argv.push_back(argument.c_str());
    ::testing::internal::CaptureStdout();
    ::testing::internal::CaptureStderr();
    const int code = runCommandLine(static_cast<int>(argv.size()), argv.data(), {root(), build});
    std::string output = ::testing::internal::GetCapturedStdout();
    return {code, std::move(output), ::testing::internal::GetCapturedStderr()};
  }
  Ended rex(std::vector<std::string> arguments) const {
    return rexIn(REX_BINARY_DIR "/tests/template", std::move(arguments));
  }

  static void write(const fs::path& file, const std::string& text) { std::ofstream(file) << text; }
  static void replace(const fs::path& file, const std::string& from, const std::string& to) {
    std::string text = fileText(file);
    ASSERT_NE(text.find(from), std::string::npos) << from;
    write(file, text.replace(text.find(from), from.size(), to));
  }
  void expectOpenGate(const std::string& gate, const std::string& message) const {
    const Ended ended = rex({"dev", "check", "98", "--gate", gate});
    EXPECT_EQ(ended.code, 1) << gate;
    EXPECT_THAT(ended.output, HasSubstr("FAIL  98-template  " + gate));
    EXPECT_THAT(flat(ended.output), HasSubstr(message));
  }

  TemporaryFolder temporary_;
};

TEST_F(WorkflowTest, ListsExercises) {
  const Ended ended = rex({"list"});
  EXPECT_EQ(ended.code, 0);
  EXPECT_THAT(ended.output, HasSubstr("98-template   3 points  Rotating points (template)\n"));
}

TEST_F(WorkflowTest, FindsExercisesByNumberTopicFolderAndNearMiss) {
  for (const char* name : {"98", "template", "98-template", "exercises/98-template/"})
    EXPECT_EQ(rex({"dev", "check", name, "--list-gates"}).code, 0) << name;
  const Ended ended = rex({"test", "98-templat"});
  EXPECT_EQ(ended.code, 64);
  EXPECT_THAT(ended.error, HasSubstr("no exercise is called '98-templat'"));
  EXPECT_THAT(ended.error, HasSubstr("'98-template'"));
}

TEST_F(WorkflowTest, GradesTheUntouchedFileAtItsFloor) {
  const Ended ended = rex({"test", "98"});
  EXPECT_EQ(ended.code, 1) << ended.error;
  EXPECT_THAT(ended.output, HasSubstr(" FAIL  0/1   A quarter turn [quarter-turn]"));
  EXPECT_THAT(ended.output, HasSubstr("0 of 3 points"));
  EXPECT_THAT(fileText(out() / "results.json"), HasSubstr("\"outcome\": \"fail\""));
}

TEST_F(WorkflowTest, KeepsResultsOfTheSolutionApart) {
  EXPECT_EQ(rex({"test", "98", "--solution"}).code, 0);
  EXPECT_EQ(rex({"run", "98", "--solution"}).code, 0);
  EXPECT_FALSE(fs::exists(out()));
  EXPECT_TRUE(fs::exists(root() / "out" / "98-template-solution" / "results.json"));
}

TEST_F(WorkflowTest, GradesTheSolutionInFull) {
  const Ended ended = rex({"test", "98", "--solution", "-o", root() / "elsewhere"});
  EXPECT_EQ(ended.code, 0) << ended.error;
  EXPECT_THAT(ended.output, HasSubstr("  ok   1/1   A quarter turn [quarter-turn]"));
  EXPECT_THAT(ended.output, HasSubstr("3 of 3 points"));
  EXPECT_TRUE(fs::exists(root() / "elsewhere" / "results.json"));
  EXPECT_FALSE(fs::exists(out() / "results.json"));
}

TEST_F(WorkflowTest, RunsOneCheckAndPrintsJson) {
  write(root() / "mine.cpp", kGood);
  EXPECT_EQ(rex({"test", "98", "--main", root() / "mine.cpp"}).code, 0);
  const std::string whole = fileText(out() / "results.json");
  const Ended ended =
      rex({"test", "98", "--main", root() / "mine.cpp", "--check", "keeps-length", "--seed", "7", "--json"});
  EXPECT_EQ(ended.code, 0) << ended.error;
  EXPECT_EQ(ended.output, fileText(out() / "results-partial.json"));
  EXPECT_EQ(fileText(out() / "results.json"), whole);
  EXPECT_THAT(ended.output, HasSubstr("\"seed_id\": \"public:7\""));
  EXPECT_THAT(ended.output, ::testing::ContainsRegex("\"compiler\": \".* [0-9]+[.][0-9]+"));
  EXPECT_THAT(ended.output, HasSubstr("\"name\": \"mine.cpp\""));
  EXPECT_THAT(ended.output, Not(HasSubstr("quarter-turn")));
  const Ended unknown = rex({"test", "98", "--check", "keeps-lenght"});
  EXPECT_EQ(unknown.code, 64);
  EXPECT_EQ(fileText(out() / "results-partial.json"), ended.output) << "the last result is lost";
  EXPECT_THAT(unknown.error, HasSubstr("no check is called 'keeps-lenght' (did you mean 'keeps-length'?)"));
}

TEST_F(WorkflowTest, ExplainsAFileThatDoesNotCompile) {
  replace(exercise() / "main.cpp", "return Eigen::Vector2d::Zero();", "return nothing;");
  const Ended ended = rex({"test", "98"});
  EXPECT_EQ(ended.code, 2);
  EXPECT_THAT(ended.error, HasSubstr("error: 'nothing' was not declared in this scope"));
  EXPECT_THAT(ended.error, HasSubstr("\n    return nothing;\n           ^\n"));
  EXPECT_THAT(ended.output, HasSubstr("Not graded"));
  EXPECT_THAT(fileText(out() / "build.log"), HasSubstr("main.cpp:11:10: error: "));
  EXPECT_THAT(fileText(out() / "results.json"), HasSubstr("\"outcome\": \"compile_error\""));
  EXPECT_EQ(rex({"run", "98"}).code, 2);
}

TEST_F(WorkflowTest, ExplainsAMissingFileAMissingFunctionAndAForbiddenCall) {
  const Ended missing = rex({"test", "98", "--main", root() / "none.cpp"});
  EXPECT_EQ(missing.code, 2);
  EXPECT_THAT(missing.error, HasSubstr("none.cpp: error: cannot be graded: found no file"));
  write(exercise() / "main.cpp", "int main() {}\n");
  const Ended lacking = rex({"test", "98"});
  EXPECT_EQ(lacking.code, 2);
  EXPECT_THAT(lacking.error, HasSubstr("'rotated' is declared but has no body here"));
  write(exercise() / "main.cpp",
        "#include \"exercise.h\"\n#include \"geometry/rotation.h\"\nEigen::Vector2d rotated(const "
        "Eigen::Vector2d& p, double a) {\n"
        "  return (rex::rotationAboutAxis(a, Eigen::Vector3d::UnitZ()) * Eigen::Vector3d(p.x(), p.y(), "
        "0)).head<2>();\n}\nint main() {}\n");
  const Ended forbidden = rex({"test", "98"});
  EXPECT_EQ(forbidden.code, 2);
  EXPECT_THAT(forbidden.error,
              HasSubstr("main.cpp:4:16: error: calls rex::rotationAboutAxis, which only main() may"));
}

TEST_F(WorkflowTest, SaysWhenTheGraderIsAtFault) {
  const Ended ended = rexIn(root() / "no-build", {"test", "98"});
  EXPECT_EQ(ended.code, 3);
  EXPECT_THAT(ended.error, HasSubstr("the grader of 98-template does not build"));
}

TEST_F(WorkflowTest, SaysWhenTheProjectOrTheMachineIsAtFault) {
  write(root() / "out", "a file where a folder should be");
  for (const char* command : {"test", "run", "debug"}) EXPECT_EQ(rex({command, "98"}).code, 3) << command;
  fs::remove(root() / "out");
  const Ended readOnly = rex({"test", "98", "-o", "/proc"});
  EXPECT_EQ(readOnly.code, 3);
  EXPECT_THAT(flat(readOnly.error), HasSubstr("/proc/results.json: cannot write the result file"));
  replace(exercise() / "exercise.toml", "points = 3", "points = ");
  for (const std::vector<std::string>& arguments :
       std::vector<std::vector<std::string>>{{"list"}, {"test", "98"}})
    EXPECT_EQ(rex(arguments).code, 3) << arguments[0];
}

TEST_F(WorkflowTest, RunsTheProgramInItsFolderAndListsWhatItWrote) {
  write(exercise() / "main.cpp",
        std::string(kGood).replace(std::string(kGood).find("int main() {}"), 13,
                                   "#include <fstream>\nint main() {\n  for (int k = 0; k < 9; ++k)\n"
                                   "    std::ofstream(\"frame\" + std::to_string(k) + \".png\") << k;\n}"));
  const Ended ended = rex({"run", "98"});
  EXPECT_EQ(ended.code, 0) << ended.error;
  EXPECT_THAT(ended.output, HasSubstr("frame0.png ... frame8.png (9 files)"));
  EXPECT_EQ(fileText(out() / "frame3.png"), "3");
  EXPECT_EQ(rex({"run", "98", "--solution", "-o", root() / "other"}).code, 0);
}

TEST_F(WorkflowTest, SaysHowAProgramEnded) {
  write(exercise() / "main.cpp", "#include <csignal>\nint main() { std::raise(SIGKILL); }\n");
  const Ended crashed = rex({"run", "98"});
  EXPECT_EQ(crashed.code, 1);
  EXPECT_THAT(crashed.error, HasSubstr("signal 9 (Killed)"));
  EXPECT_THAT(crashed.error, HasSubstr("rex debug 98-template"));
  write(exercise() / "main.cpp", "int main() { return 5; }\n");
  EXPECT_THAT(rex({"run", "98"}).error, HasSubstr("exit code 5"));
}

TEST_F(WorkflowTest, PrintsADebuggerCommand) {
  const Ended ended = rex({"debug", "98", "--solution", "--print"});
  EXPECT_EQ(ended.code, 0) << ended.error;
  EXPECT_THAT(ended.output, ::testing::StartsWith("gdb -q -ex 'set cwd " + out().string() + "-solution' "));
}

TEST_F(WorkflowTest, SaysHowToGetTheDebugger) {
  fs::create_directory(root() / "bin");
  for (const char* tool : {"as", "ld", "nm"})
    fs::create_symlink(fs::path("/usr/bin") / tool, root() / "bin" / tool);
  const std::string path = std::getenv("PATH");
  ::setenv("PATH", (root() / "bin").c_str(), 1);
  const Ended ended = rex({"debug", "98"});
  ::setenv("PATH", path.c_str(), 1);
  EXPECT_EQ(ended.code, 3);
  EXPECT_THAT(ended.error, HasSubstr("the debugger is not installed: wanted apt-get install gdb"));
}

TEST_F(WorkflowTest, SaysHowToGetTheBenchmarks) {
  const Ended ended = rex({"bench"});
  EXPECT_EQ(ended.code, 3);
  EXPECT_THAT(ended.error, HasSubstr("the benchmarks are not built: wanted scripts/rex bench"));
}

TEST_F(WorkflowTest, NeedsTheSolutionWhereItIsAskedFor) {
  fs::remove(exercise() / "solution.cpp");
  for (const std::vector<std::string>& arguments :
       std::vector<std::vector<std::string>>{{"test", "98", "--solution"}, {"run", "98", "--solution"}}) {
    const Ended ended = rex(arguments);
    EXPECT_EQ(ended.code, 64);
    EXPECT_THAT(flat(ended.error), HasSubstr("98-template comes without a solution here"));
  }
  EXPECT_THAT(flat(rex({"dev", "strip", "98"}).error), HasSubstr("there is no solution to strip"));
}

TEST_F(WorkflowTest, PassesTheTemplateThroughAllGates) {
  const Ended ended = rex({"dev", "check", "98", "--seeds", "2"});
  EXPECT_EQ(ended.code, 0) << ended.output << ended.error;
  const std::string gates = rex({"dev", "check", "98", "--list-gates"}).output;
  EXPECT_EQ(gates,
            "main-current\npoints\nnames\nrelease\nmain-floor\nsolution\nwrong/clockwise\nwrong/library\n");
}

TEST_F(WorkflowTest, FindsWhatIsWrongWithTheTexts) {
  replace(exercise() / "main.cpp", "TODO", "todo");
  expectOpenGate("main-current", "run: scripts/rex dev strip 98-template");
  fs::rename(exercise() / "main.cpp", exercise() / "elsewhere.cpp");
  expectOpenGate("main-current", "main.cpp: cannot read this file");
  replace(exercise() / "README.md", "Complete `rotated`", "Complete `rotatd`");
  expectOpenGate("names", "'rotatd' does not exist (did you mean 'rotated'?)");
  replace(exercise() / "exercise.toml", "points = 3", "points = 4");
  expectOpenGate("points", "part 'rotate': checks are worth 3 points, exercise.toml says 4");
  replace(exercise() / "README.md", "# 98", "`const double s = std::sin(angle);`\n# 98");
  expectOpenGate("release", "a line of the solution would reach students");
  const Ended unknown = rex({"dev", "check", "98", "--gate", "nmes"});
  EXPECT_EQ(unknown.code, 64);
  EXPECT_THAT(flat(unknown.error), HasSubstr("98-template has no gate 'nmes' (did you mean 'names'?)"));
}

TEST_F(WorkflowTest, FindsWhatIsWrongWithTheStarter) {
  replace(exercise() / "exercise.toml", "floor = 0", "floor = 1");
  expectOpenGate("main-floor", "the untouched main.cpp gets 0 points, exercise.toml says floor = 1");
  replace(exercise() / "main.cpp", "return Eigen", "int unused;\n  return Eigen");
  expectOpenGate("main-floor", "main.cpp does not compile cleanly");
}

TEST_F(WorkflowTest, FindsWhatIsWrongWithTheSolution) {
  replace(exercise() / "solution.cpp", "s * p.x() + c * p.y()", "s * p.x() + c * p.x()");
  expectOpenGate("solution", "under seed 1");
}

TEST_F(WorkflowTest, FindsMistakesThatAreNotCaught) {
  replace(exercise() / "wrong" / "clockwise.cpp", "caught by: quarter-turn", "caught by: keeps-length");
  expectOpenGate("wrong/clockwise", "check 'keeps-length' passes although: turns clockwise.");
  replace(exercise() / "wrong" / "clockwise.cpp", "keeps-length", "keeps-lenght");
  expectOpenGate("wrong/clockwise", "no check is called 'keeps-lenght'");
  replace(exercise() / "wrong" / "library.cpp", "rex::rotationAboutAxis(angle, Eigen::Vector3d::UnitZ())",
          "Eigen::Matrix3d::Identity()");
  expectOpenGate("wrong/library", "nothing noticed");
}

TEST_F(WorkflowTest, MakesANewExercise) {
  const Ended made = rex({"dev", "new", "97-walking"});
  EXPECT_EQ(made.code, 0) << made.error;
  EXPECT_EQ(fileText(root() / "exercises/CMakeLists.txt"), "rex_exercise(97-walking FUNCTIONS rotated)\n");
  EXPECT_THAT(fileText(root() / "exercises/97-walking/main.cpp"),
              HasSubstr("// Your solution of 97-walking."));
  EXPECT_THAT(fileText(root() / "exercises/97-walking/README.md"), Not(HasSubstr("@")));
  EXPECT_EQ(rex({"dev", "check", "97", "--list-gates"}).code, 0);
  const Ended again = rex({"dev", "new", "97-walking"});
  EXPECT_EQ(again.code, 64);
  EXPECT_THAT(again.error, HasSubstr("this exercise exists already"));
  for (const char* name : {"walking", "1-walking", "97-", "97-../x", "97-a b", ""}) {
    const Ended bad = rex({"dev", "new", name});
    EXPECT_EQ(bad.code, 64) << name;
    EXPECT_THAT(bad.error, HasSubstr("not a name for an exercise")) << name;
  }
}

TEST_F(WorkflowTest, WritesTheStudentRelease) {
  const Ended ended = rex({"dev", "strip", "--release", "-o", root() / "students"});
  EXPECT_EQ(ended.code, 0) << ended.error;
  EXPECT_TRUE(fs::exists(root() / "students/exercises/98-template/main.cpp"));
  EXPECT_FALSE(fs::exists(root() / "students/exercises/98-template/solution.cpp"));
  EXPECT_EQ(rex({"dev", "strip", "--release", "-o", root() / "students"}).code, 64);
}

}  // namespace
}  // namespace rex::cli
