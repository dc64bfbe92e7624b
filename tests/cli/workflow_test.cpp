#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <stdlib.h>

#include "cli/command_schema.h"
#include "cli/template_project.h"

namespace rex::cli::workflow_test {

using ::testing::HasSubstr;
using ::testing::Not;

class WorkflowTest : public TemplateProject {};

TEST_F(WorkflowTest, ListsExercises) {
  const Ended ended = rex({"list"});
  EXPECT_EQ(ended.code, 0);
  EXPECT_THAT(ended.output, HasSubstr("98-template   3 points  Rotating points (template)\n"));
}

TEST_F(WorkflowTest, ListsExercisesAsJson) {
  EXPECT_EQ(schemaFaultsOf(rex({"list", "--json"}).output, "list"), "");
  EXPECT_EQ(
      rex({"list", "--json"}).output,
      "{\"exercises\":[{\"name\":\"98-template\",\"title\":\"Rotating points (template)\",\"script\":\"2.1\","
      "\"folder\":\"" +
          shown(exercise()) +
          "\",\"points\":3,\"parts\":[{\"id\":\"rotate\","
          "\"title\":\"Rotation in the plane\",\"points\":3}]}]}\n");
}

TEST_F(WorkflowTest, FindsExercisesByNumberTopicFolderAndNearMiss) {
  for (const char* name :
       {"98", "template", "98-template", "exercises/98-template/", "./exercises/98-template/main.cpp"})
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
  EXPECT_THAT(fileText(out() / "build.log"), HasSubstr("main.cpp:9:10: error: "));
  EXPECT_THAT(fileText(out() / "results.json"), HasSubstr("\"outcome\": \"compile_error\""));
  EXPECT_EQ(rex({"run", "98"}).code, 2);
}

TEST_F(WorkflowTest, ExplainsAMissingFileAMissingFunctionAndAForbiddenCall) {
  const Ended missing = rex({"test", "98", "--main", root() / "none.cpp"});
  EXPECT_EQ(missing.code, 2);
  EXPECT_THAT(missing.error, HasSubstr("none.cpp: error: cannot be graded: found no file"));
  EXPECT_THAT(missing.output, Not(HasSubstr("rex reset")));
  fs::remove(exercise() / "main.cpp");
  const Ended gone = rex({"test", "98"});
  EXPECT_EQ(gone.code, 2);
  EXPECT_THAT(gone.output, HasSubstr("as it was handed out: scripts/rex reset 98-template\n"));
  write(exercise() / "main.cpp", "int main() {}\n");
  const Ended lacking = rex({"test", "98"});
  EXPECT_EQ(lacking.code, 2);
  EXPECT_THAT(lacking.error, HasSubstr("'rotated' is declared but not defined here"));
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

// The program of the second grading keeps what it finds of the first, as another grading would meet it.
TEST_F(WorkflowTest, LeavesTheLastResultWholeWhileItGrades) {
  rex({"test", "98"});
  const fs::path results = out() / "results.json", log = out() / "build.log";
  const std::string last = fileText(results);
  write(log, "the last log");
  std::string curious = kGood;
  curious.replace(curious.find("  return"), 2,
                  "  std::ofstream(\"" + (root() / "seen").string() + "\") << std::ifstream(\"" +
                      results.string() + "\").rdbuf() << std::ifstream(\"" + log.string() +
                      "\").rdbuf();\n  ");
  write(exercise() / "main.cpp", "#include <fstream>\n" + curious);
  EXPECT_EQ(rex({"test", "98"}).code, 0);
  EXPECT_EQ(fileText(root() / "seen"), last + "the last log");
  EXPECT_THAT(fileText(results), HasSubstr("\"outcome\": \"pass\""));
  EXPECT_EQ(fileText(log), "");
}

TEST_F(WorkflowTest, SaysWhenTheGraderIsAtFault) {
  const Ended missing = rexIn(root() / "no-build", {"test", "98"});
  EXPECT_EQ(missing.code, 3);
  EXPECT_THAT(flat(missing.error), HasSubstr("build.json: the exercise is not built"));
  fs::create_directory(root() / "build");
  write(root() / "build" / "build.ninja",
        "rule compile\n  command = echo 'check.cpp:7:1: error: nonsense'; exit 1\n"
        "build 98-template_ready: compile\n");
  const Ended broken = rexIn(root() / "build", {"test", "98"});
  EXPECT_EQ(broken.code, 3);
  EXPECT_THAT(broken.error, HasSubstr("the grader of 98-template does not build"));
  EXPECT_THAT(broken.error, HasSubstr("check.cpp:7:1: error: nonsense"));
}

TEST_F(WorkflowTest, SaysWhenTheProjectOrTheMachineIsAtFault) {
  write(root() / "out", "a file where a folder should be");
  for (const char* command : {"test", "run", "debug"}) {
    const Ended blocked = rex({command, "98"});
    EXPECT_EQ(blocked.code, 3) << command;
    EXPECT_THAT(flat(blocked.error),
                HasSubstr("out/98-template: cannot make the folder for results: found Not a directory"));
  }
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
  const fs::path student = fs::path(REX_BINARY_DIR) / "tests" / "template" / "student";
  fs::create_directories(student);
  fs::copy_file(fs::path(REX_BINARY_DIR) / "student" / "program.json", student / "program.json",
                fs::copy_options::overwrite_existing);
  write(exercise() / "main.cpp",
        std::string(kGood).replace(std::string(kGood).find("int main() {}"), 13,
                                   "#include <fstream>\n#include \"course/live_view.h\"\n"
                                   "int main() {\n  for (int k = 0; k < 9; ++k)\n"
                                   "    std::ofstream(\"frame\" + std::to_string(k) + \".png\") << k;\n"
                                   "  return rex::LiveView(\"page\").isWatched();\n}"));
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

TEST_F(WorkflowTest, LimitsMemoryAlsoWithTheSanitizers) {
  replace(exercise() / "exercise.toml", "memory_mb = 512", "memory_mb = 64");
  write(exercise() / "main.cpp",
        "#include \"exercise.h\"\n#include <cstring>\n#include <unistd.h>\n"
        "Eigen::Vector2d rotated(const Eigen::Vector2d&, double) {\n"
        "  for (int k = 0; k < 100; ++k, usleep(20000)) memset(new char[10 << 20], 1, 10 << 20);\n"
        "  return {0, 0};\n}\nint main() {}\n");
  const Ended ended = rex({"test", "98", "--debug", "--check", "quarter-turn"});
  EXPECT_EQ(ended.code, 1) << ended.error;
  EXPECT_THAT(flat(ended.output), HasSubstr("used more than 384 MB of memory in rotated"));
}

TEST_F(WorkflowTest, PrintsADebuggerCommand) {
  const Ended ended = rex({"debug", "98", "--solution", "--print"});
  EXPECT_EQ(ended.code, 0) << ended.error;
  EXPECT_THAT(ended.output, ::testing::StartsWith("gdb -q -ex 'set cwd " + out().string() + "-solution' "));
}

TEST_F(WorkflowTest, SaysHowToGetTheDebugger) {
  fs::create_directory(root() / "bin");
  for (const char* tool : {"as", "ld", "ld.gold", "nm"})
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
    EXPECT_THAT(flat(ended.error), HasSubstr("98-template has no solution here"));
  }
  EXPECT_THAT(flat(rex({"dev", "strip", "98"}).error), HasSubstr("there is no solution to strip"));
}

TEST_F(WorkflowTest, PassesTheTemplateThroughAllGates) {
  const Ended ended = rex({"dev", "check", "98", "--seeds", "2"});
  EXPECT_EQ(ended.code, 0) << ended.output << ended.error;
  const std::string gates = rex({"dev", "check", "98", "--list-gates"}).output;
  EXPECT_EQ(gates,
            "main-current\npoints\nnames\nrelease\nevidence\nmain-"
            "floor\nsolution\nsanitizers\nhostile\nliars\nwrong\n");
}

TEST_F(WorkflowTest, FindsWhatIsWrongWithTheTexts) {
  replace(exercise() / "main.cpp", "TODO", "todo");
  expectOpenGate("main-current", "run: scripts/rex dev strip 98-template");
  std::string lines;
  for (int k = 0; k < 200; ++k) lines += "//\n";
  for (const char* name : {"main.cpp", "solution.cpp"})
    replace(exercise() / name, "int main()", lines + "int main()");
  replace(exercise() / "main.cpp", "todo", "TODO");
  expectOpenGate("main-current", "main.cpp has 2");  // 200 and those of the template
  fs::rename(exercise() / "main.cpp", exercise() / "elsewhere.cpp");
  expectOpenGate("main-current", "main.cpp: cannot read this file");
  replace(exercise() / "README.md", "Complete `rotated`", "Complete `rotatd`");
  expectOpenGate("names", "'rotatd' does not exist (did you mean 'rotated'?)");
  replace(exercise() / "exercise.toml", "points = 3", "points = 4");
  expectOpenGate("points", "part 'rotate': checks are worth 3 points, exercise.toml says 4");
  expectOpenGate("points",
                 "README.md:11: the heading promises 3 points, exercise.toml says 4 for part 'rotate'");
  replace(exercise() / "exercise.toml", "points = 4", "points = 21");
  expectOpenGate("points", "the parts are worth 21 points together, wanted at most 20");
  replace(exercise() / "README.md", "## Part 1", "## Part 2");
  expectOpenGate("points", "the heading promises 3 points, but exercise.toml has only 1 part");
  replace(exercise() / "README.md", "# 98", "`const double s = std::sin(angle);`\n# 98");
  expectOpenGate("release", "a line of the solution would reach students");
  const Ended unknown = rex({"dev", "check", "98", "--gate", "nmes"});
  EXPECT_EQ(unknown.code, 64);
  EXPECT_THAT(flat(unknown.error), HasSubstr("98-template has no gate 'nmes' (did you mean 'names'?)"));
}

TEST_F(WorkflowTest, FindsWhatIsWrongWithTheStarter) {
  replace(exercise() / "exercise.toml", "floor = 0", "floor = 1");
  expectOpenGate("main-floor",
                 "the untouched main.cpp gets 0 points (no check passes), exercise.toml says floor = 1");
  replace(exercise() / "exercise.toml", "floor = 1", "floor = 0");
  replace(exercise() / "main.cpp", "return Eigen::Vector2d::Zero();", "return angle < 9 ? p : p;");
  expectOpenGate("main-floor", "gets 2 points (keeps-length 1, angles-add 1), exercise.toml says floor = 0");
  replace(exercise() / "main.cpp", "return angle", "int unused;\n  return angle");
  expectOpenGate("main-floor", "main.cpp does not compile cleanly");
}

TEST_F(WorkflowTest, FindsWhatIsWrongWithTheSolution) {
  replace(exercise() / "solution.cpp", "s * p.x() + c * p.y()", "s * p.x() + c * p.x()");
  expectOpenGate("solution", "under seed 1");
  replace(exercise() / "solution.cpp", "const double s = std::sin(angle);",
          "double sines[2] = {std::sin(angle), 0};\n  const double s = sines[angle > 99 ? 0 : 2];");
  expectOpenGate("sanitizers", "solution.cpp does not pass with the sanitizers:");
}

TEST_F(WorkflowTest, FindsMistakesThatAreNotCaught) {
  replace(exercise() / "wrong" / "clockwise.cpp", "caught by: quarter-turn", "caught by: keeps-length");
  expectOpenGate("wrong/clockwise", "check 'keeps-length' does not catch this mistake: turns clockwise.");
  replace(exercise() / "wrong" / "clockwise.cpp", "keeps-length", "keeps-lenght");
  expectOpenGate("wrong/clockwise", "no check is called 'keeps-lenght'");
  replace(exercise() / "wrong" / "clockwise.cpp", "shown by: quarter-turn", "shown by: keeps-length");
  replace(exercise() / "wrong" / "clockwise.cpp", "keeps-lenght", "quarter-turn");
  expectOpenGate("wrong/clockwise", "check 'keeps-length' leaves no picture");
  replace(exercise() / "wrong" / "clockwise.cpp", "// shown by: keeps-length\n", "");
  expectOpenGate("evidence", "no wrong variant names a check that shows its mistake");
  fs::remove(exercise() / "wrong" / "clockwise.cpp");
  expectOpenGate("evidence", "part 'rotate': no wrong variant is caught by one of its checks");
  replace(exercise() / "wrong" / "library.cpp", "rex::rotationAboutAxis(angle, Eigen::Vector3d::UnitZ())",
          "Eigen::Matrix3d::Identity()");
  expectOpenGate("wrong/library", "no call was found");
}

TEST_F(WorkflowTest, RunsTheChosenGatesAndPrintsThemAsJson) {
  const Ended ended = rex({"dev", "check", "98", "--gate", "points", "--gate", "names", "--json"});
  EXPECT_EQ(ended.code, 0) << ended.error;
  EXPECT_EQ(
      ended.output,
      "{\"gates\":[{\"exercise\":\"98-template\",\"gate\":\"points\",\"passed\":true,\"message\":\"\","
      "\"note\":\"\"},{\"exercise\":\"98-template\",\"gate\":\"names\",\"passed\":true,\"message\":\"\","
      "\"note\":\"\"}],\"blocked\":[]}\n");
  EXPECT_EQ(schemaFaultsOf(ended.output, "dev_check"), "");
  EXPECT_EQ(schemaFaultsOf("{\"gates\": [], \"blokced\": []}", "dev_check").empty(), false);
  const std::string names = rex({"dev", "check", "98", "--list-gates", "--json"}).output;
  EXPECT_EQ(schemaFaultsOf(names, "dev_check_gates"), "");
  EXPECT_THAT(names, HasSubstr("{\"98-template\":[\"main-current\",\"points\","));
}

TEST_F(WorkflowTest, ABrokenDescriptionFailsItsOwnExerciseOnly) {
  fs::create_directory(root() / "exercises" / "99-broken");
  write(root() / "exercises" / "99-broken" / "exercise.toml", "title = \"no end\n");
  EXPECT_EQ(rex({"dev", "check", "98", "--gate", "points"}).code, 0);
  const Ended broken = rex({"dev", "check", "--gate", "points"});
  EXPECT_EQ(broken.code, 1);
  EXPECT_THAT(broken.output, HasSubstr(" ok   98-template  points\n FAIL  99-broken  exercise.toml\n"));
  EXPECT_THAT(flat(broken.output), HasSubstr("99-broken/exercise.toml:1:"));
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

TEST_F(WorkflowTest, SaysWhereTheReleaseOfEarlierVersionsWent) {
  for (const std::vector<std::string>& arguments : std::vector<std::vector<std::string>>{
           {"dev", "strip", "--release", "-o", "students"}, {"dev", "strip", "-o", "students"}}) {
    const Ended ended = rex(arguments);
    EXPECT_EQ(ended.code, 64);
    EXPECT_THAT(ended.error, HasSubstr("to make the student release, use: scripts/rex dev release students"));
  }
  EXPECT_THAT(rex({"dev", "strip"}).error, HasSubstr("EXERCISE is required"));
}

}  // namespace rex::cli::workflow_test
