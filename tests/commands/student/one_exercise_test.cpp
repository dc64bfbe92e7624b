// `rex test`, `run` and `debug` of one exercise: from the student's file to the verdict.
#include <cstdlib>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <stdlib.h>

#include "base/process.h"
#include "commands/built_project.h"

namespace rex::cli::one_exercise_test {

using ::testing::HasSubstr;
using ::testing::Not;

class OneExercise : public BuiltProject {};

// The fixtures rely on it: equal files are compiled once, others never share a result.
TEST(KeptCompiler, GivesEqualFilesTheSameAndOthersTheirOwn) {
  const TemporaryFolder folder;
  const auto toExitCode = [&](const std::string& project, const std::string& text,
                              const std::string& header) {
    const fs::path place = folder.path() / project;
    fs::create_directories(place);
    std::ofstream(place / "main.cpp") << text;
    std::ofstream(place / "seven.h") << header;
    const ProcessResult compiled = runProcess(
        {kKeptCompiler, "-include", "seven.h", "main.cpp", "-o", place / "program"}, {.directory = place});
    if (!compiled.ok()) return compiled.error.find("main.cpp:1:") == std::string::npos ? -2 : -1;
    return runProcess({place / "program"}).exitCode;
  };
  const std::string header = "constexpr int seven = 7;\n";
  for (const char* project : {"one", "two"}) {
    EXPECT_EQ(toExitCode(project, "int main() { return seven; }\n", header), 7);
    EXPECT_EQ(toExitCode(project, "int main() { return seven + 1; }\n", header), 8);
    EXPECT_EQ(toExitCode(project, "int main() { return seven; }\n", "constexpr int seven = 9;\n"), 9);
    EXPECT_EQ(toExitCode(project, "int main() { return nothing; }\n", header), -1);
  }
}

TEST_F(OneExercise, GradesTheUntouchedFileAtItsFloor) {
  const Ended ended = rex({"test", "98"});
  EXPECT_EQ(ended.code, 1) << ended.error;
  EXPECT_THAT(ended.output, HasSubstr(" FAIL  0/1   A quarter turn [quarter-turn]"));
  EXPECT_THAT(ended.output, HasSubstr("0 of 3 points"));
  EXPECT_THAT(fileText(out() / "results.json"), HasSubstr("\"outcome\": \"fail\""));
}

TEST_F(OneExercise, GradesTheSolutionInFull) {
  const Ended ended = rex({"test", "98", "--solution", "-o", root() / "elsewhere"});
  EXPECT_EQ(ended.code, 0) << ended.error;
  EXPECT_THAT(ended.output, HasSubstr("  ok   1/1   A quarter turn [quarter-turn]"));
  EXPECT_THAT(ended.output, HasSubstr("3 of 3 points"));
  EXPECT_TRUE(fs::exists(root() / "elsewhere" / "results.json"));
  EXPECT_FALSE(fs::exists(out() / "results.json"));
}

TEST_F(OneExercise, KeepsResultsOfTheSolutionApart) {
  EXPECT_EQ(rex({"test", "98", "--solution"}).code, 0);
  EXPECT_EQ(rex({"run", "98", "--solution"}).code, 0);
  EXPECT_FALSE(fs::exists(out()));
  EXPECT_TRUE(fs::exists(root() / "out" / "98-template-solution" / "results.json"));
}

TEST_F(OneExercise, RunsOneCheckAndPrintsJson) {
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

TEST_F(OneExercise, SaysHowToRepeatACheckThatFailed) {
  write(exercise() / "main.cpp",
        "#include \"exercise.h\"\nEigen::Vector2d rotated(const Eigen::Vector2d& p, double) { return -p; }");
  write(root() / "secret", "sixteen letters and more\n");
  std::vector<std::string> test = {"test", "98", "--seed", "7"};
  for (const std::string suffix : {"", " --secret-file FILE"}) {
    EXPECT_THAT(rex(test).output, HasSubstr("--check quarter-turn --seed 7\n"));
    test.insert(test.end(), {"--check", "angles-add"});
    EXPECT_THAT(rex(test).output, HasSubstr("--check angles-add --seed 7" + suffix + "\n"));
    test = {"test", "98", "--seed", "7", "--secret-file", root() / "secret"};
  }
}

// What the other commands of the loop find: tests/cli records the same.
TEST_F(OneExercise, RemembersWholeTestsOfTheStudentsFileOnly) {
  write(root() / "mine.cpp", kGood);
  rex({"test", "98", "--main", root() / "mine.cpp"});
  rex({"test", "98", "--solution"});
  rex({"test", "98", "--check", "keeps-length"});
  EXPECT_THAT(rex({}).output, HasSubstr("  - of  3"));
  rex({"test", "98"});
  EXPECT_THAT(rex({}).output, HasSubstr("  0 of  3\n"));
  EXPECT_THAT(rex({"hint", "98"}).output, HasSubstr("[rotate]"));
  write(exercise() / "main.cpp", kGood);
  EXPECT_THAT(rex({}).output, HasSubstr("  0 of  3   edited since this test\n"));
  rex({"test", "98"});
  EXPECT_THAT(rex({}).output, HasSubstr("  3 of  3\n"));
  EXPECT_EQ(rex({"submit", "98", "-o", root() / "handin.zip"}).error, "") << "it was tested";
  replace(exercise() / "exercise.toml", "[limits]", "solution = \"after-pass\"\n\n[limits]");
  EXPECT_EQ(rex({"show", "98", "--solution"}).code, 0);
}

TEST_F(OneExercise, WritesReportsBesideTheResultAndRenewsThem) {
  EXPECT_EQ(rex({"test", "98", "--report", "junit,markdown"}).code, 1);
  EXPECT_THAT(fileText(out() / "junit.xml"), HasSubstr("<testsuite"));
  const std::string before = fileText(out() / "summary.md");
  EXPECT_THAT(before, HasSubstr("0 of 3 points"));
  write(exercise() / "main.cpp", kGood);
  EXPECT_EQ(rex({"test", "98"}).code, 0);
  EXPECT_THAT(fileText(out() / "summary.md"), HasSubstr("3 of 3 points")) << "not of an earlier result";
  EXPECT_FALSE(fs::exists(out() / "gradescope.json"));
  const Ended unknown = rex({"test", "98", "--report", "markdwn"});
  EXPECT_EQ(unknown.code, 64);
  EXPECT_THAT(flat(unknown.error), HasSubstr("--report: found markdwn, wanted one of "));
  EXPECT_THAT(flat(unknown.error), HasSubstr("did you mean 'markdown'?"));
}

TEST_F(OneExercise, ExplainsAFileThatDoesNotCompile) {
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

TEST_F(OneExercise, ExplainsAMissingFileAMissingFunctionAndAForbiddenCall) {
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
TEST_F(OneExercise, LeavesTheLastResultWholeWhileItGrades) {
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

TEST_F(OneExercise, SaysWhenTheGraderIsAtFault) {
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

TEST_F(OneExercise, SaysWhenTheProjectOrTheMachineIsAtFault) {
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

TEST_F(OneExercise, LimitsMemoryAlsoWithTheSanitizers) {
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

TEST_F(OneExercise, NeedsTheSolutionWhereItIsAskedFor) {
  fs::remove(exercise() / "solution.cpp");
  for (const std::vector<std::string>& arguments :
       std::vector<std::vector<std::string>>{{"test", "98", "--solution"}, {"run", "98", "--solution"}}) {
    const Ended ended = rex(arguments);
    EXPECT_EQ(ended.code, 64);
    EXPECT_THAT(flat(ended.error), HasSubstr("98-template has no solution here"));
  }
  EXPECT_THAT(flat(rex({"dev", "strip", "98"}).error), HasSubstr("there is no solution to strip"));
}

TEST_F(OneExercise, RunsTheProgramInItsFolderAndListsWhatItWrote) {
  addProgramDescription();
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

TEST_F(OneExercise, SaysHowAProgramEnded) {
  write(exercise() / "main.cpp", "#include <csignal>\nint main() { std::raise(SIGKILL); }\n");
  const Ended crashed = rex({"run", "98"});
  EXPECT_EQ(crashed.code, 1);
  EXPECT_THAT(crashed.error, HasSubstr("signal 9 (Killed)"));
  EXPECT_THAT(crashed.error, HasSubstr("rex debug 98-template"));
  write(exercise() / "main.cpp", "int main() { return 5; }\n");
  EXPECT_THAT(rex({"run", "98"}).error, HasSubstr("exit code 5"));
}

TEST_F(OneExercise, SaysInWhichFunctionAProgramThrew) {
  addProgramDescription();
  write(exercise() / "main.cpp", std::string("#include <stdexcept>\n") + kGood);
  std::string text = fileText(exercise() / "main.cpp");
  text.replace(
      text.find("int main() {}"), 13,
      "double halved(double x) {\n  if (x < 0) throw std::runtime_error(\"negative\");\n  return x / 2;\n}\n"
      "int main(int n, char**) { return halved(-n) > 0; }");
  write(exercise() / "main.cpp", text);
  const Ended ended = rex({"run", "98"});
  EXPECT_EQ(ended.code, 1);
  const auto lines = std::count(text.begin(), text.begin() + static_cast<long>(text.find("throw")), '\n') + 1;
  EXPECT_THAT(ended.error, HasSubstr("It was in line " + std::to_string(lines) + " of main.cpp, in halved"));
}

TEST_F(OneExercise, PrintsADebuggerCommand) {
  const Ended ended = rex({"debug", "98", "--solution", "--print"});
  EXPECT_EQ(ended.code, 0) << ended.error;
  EXPECT_THAT(ended.output, ::testing::StartsWith("gdb -q -ex 'set cwd " + out().string() + "-solution' "));
}

TEST_F(OneExercise, SaysOnceThatItNotesTheWork) {
  const auto tells = HasSubstr(
      "From now on, rex notes in .rex/progress.json how long you work on each exercise, "
      "and when its parts first pass. That stays on this machine unless you hand it in "
      "with rex submit --progress.");
  write(exercise() / "main.cpp", kGood);
  EXPECT_THAT(flat(rex({"test", "98", "--main", exercise() / "main.cpp"}).error), Not(tells)) << "not noted";
  EXPECT_THAT(flat(rex({"test", "98", "--check", "quarter-turn"}).error), tells);
  EXPECT_THAT(flat(rex({"test", "98"}).error), Not(tells));
  EXPECT_THAT(fileText(root() / ".rex" / "progress.json"), HasSubstr("\"first_passed\""));
  fs::remove_all(root() / ".rex");
  EXPECT_THAT(flat(rex({"test", "98", "--json"}).error), tells);
}

TEST_F(OneExercise, KeepsRecordsOfTheUsualCases) {
  const std::string name = "Record: largest error of a distance: ";
  write(exercise() / "main.cpp", kGood);
  const std::string first = rex({"test", "98"}).output;
  EXPECT_THAT(first, HasSubstr(name));
  EXPECT_THAT(first, Not(HasSubstr("attempts")));
  rex({"test", "98", "--seed", "7"});
  rex({"test", "98", "--solution"});
  EXPECT_FALSE(fs::exists(out() / "record-keeps-length.png")) << "one attempt is no curve";
  replace(exercise() / "main.cpp", "return {std::cos(a)", "a += 0;\n  return {(1 + 1e-13) * std::cos(a)");
  EXPECT_THAT(flat(rex({"test", "98", "--check", "keeps-length"}).output),
              AllOf(HasSubstr(", your best was "), HasSubstr(" m (2 attempts): "),
                    HasSubstr("/record-keeps-length.png")));
  EXPECT_TRUE(fs::exists(out() / "record-keeps-length.png"));
  replace(exercise() / "main.cpp", "(1 + 1e-13)", "2");
  EXPECT_THAT(rex({"test", "98"}).output, Not(HasSubstr("Record: "))) << "it fails";
}

TEST_F(OneExercise, DebugsTheCallWithWhichACheckFails) {
  write(exercise() / "main.cpp", kGood);
  const Ended passes = rex({"debug", "98", "--check", "quarter-turn"});
  EXPECT_EQ(passes.code, 0) << passes.error;
  EXPECT_EQ(passes.output, "The check passes, so there is no case to stop in: quarter-turn\n");
  const Ended unknown = rex({"debug", "98", "--check", "quarter-trn"});
  EXPECT_EQ(unknown.code, 64);
  EXPECT_THAT(flat(unknown.error),
              HasSubstr("no check is called 'quarter-trn' (did you mean 'quarter-turn'?)"));
  write(exercise() / "main.cpp",
        "#include \"exercise.h\"\nEigen::Vector2d rotated(const Eigen::Vector2d& p, double angle) {\n"
        "  const double twice = 2 * angle;\n  return {twice, p.x()};\n}\nint main() {}\n");
  const Ended fails = rex({"debug", "98", "--check", "quarter-turn", "--print"});
  EXPECT_EQ(fails.code, 0) << fails.error;
  EXPECT_THAT(fails.output, HasSubstr(" -ex 'break -qualified rotated' -ex 'run 3<"));
  if (runProcess({"gdb", "--version"}).ok()) {
    const std::string line = fails.output.substr(0, fails.output.find('\n'));
    const ProcessResult stopped = runProcess({"sh", "-c", line + " -ex next -ex 'print twice' -batch"});
    EXPECT_THAT(stopped.output, HasSubstr("$1 = 3.14")) << stopped.error;
  }
  write(exercise() / "main.cpp",
        "#include \"exercise.h\"\n#include <cstdlib>\n"
        "Eigen::Vector2d rotated(const Eigen::Vector2d&, double) { abort(); }\nint main() {}\n");
  const Ended crashes = rex({"debug", "98", "--check", "quarter-turn"});
  EXPECT_EQ(crashes.code, 3);
  EXPECT_THAT(flat(crashes.error),
              ::testing::AllOf(HasSubstr("there is no call to stop in: the program aborted in rotated"),
                               HasSubstr("scripts/rex test 98-template --check quarter-turn may say more")));
}

TEST_F(OneExercise, SaysHowToGetTheDebugger) {
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

}  // namespace rex::cli::one_exercise_test
