// `rex dev check` and `dev new`: what the gates of an exercise find.
#include <set>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/process.h"
#include "cli/command_schema.h"
#include "commands/built_project.h"
#include "submission/exercise_info.h"
#include "support/paths.h"
#include "support/registered_tests.h"

namespace rex::cli::gates_test {

using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

class ExerciseGates : public BuiltProject {
 protected:
  void SetUp() override {
    BuiltProject::SetUp();
    fs::create_directories(root() / "share");
    write(root() / "share" / "layers.txt", "0 base public\n");
  }
  void expectOpenGate(const std::string& gate, const std::string& message) const {
    const Ended ended = rex({"dev", "check", "98", "--gate", gate});
    EXPECT_EQ(ended.code, 1) << gate;
    EXPECT_THAT(ended.output, HasSubstr("FAIL  98-template  " + gate));
    EXPECT_THAT(flat(ended.output), HasSubstr(message));
  }
};

TEST_F(ExerciseGates, PassesTheTemplateThroughAllGates) {
  const Ended ended = rex({"dev", "check", "98", "--runs", "2"});
  EXPECT_EQ(ended.code, 0) << ended.output << ended.error;
  const std::string gates = rex({"dev", "check", "98", "--list-gates"}).output;
  EXPECT_EQ(gates,
            "main-current\nnames\nrelease\npoints\nmain-floor\nmains\nsolution\nsanitizers\nhostile\n"
            "grown\nliars\npasted\nmutants\nwrong\n");
  EXPECT_THAT(ended.output, StartsWith("98-template is private, as its exercise.toml says: the gates "
                                       "handed-out and evidence do not\napply"));
}

TEST_F(ExerciseGates, TestsOneVariant) {
  const Ended ended = rex({"dev", "check", "98", "--variant", "clockwise"});
  EXPECT_EQ(ended.code, 0) << ended.output << ended.error;
  EXPECT_EQ(ended.output, "  ok   98-template  wrong\n");
  const Ended unknown = rex({"dev", "check", "98", "--variant", "clockwize"});
  EXPECT_EQ(unknown.code, 64);
  EXPECT_THAT(flat(unknown.error), HasSubstr("98-template has no wrong variant 'clockwize' (did you mean "
                                             "'clockwise'?)"));
  const Ended idle = rex({"dev", "check", "98", "--variant", "clockwise", "--gate", "points"});
  EXPECT_EQ(idle.code, 64);
  EXPECT_THAT(flat(idle.error), HasSubstr("--variant has no effect without --gate wrong"));
}

TEST_F(ExerciseGates, FindsWhatIsWrongWithTheTexts) {
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
                 "README.md:13: the heading promises 3 points, exercise.toml says 4 for part 'rotate'");
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

TEST_F(ExerciseGates, FindsWhatIsWrongWithTheStarter) {
  replace(exercise() / "exercise.toml", "floor = 0", "floor = 1");
  expectOpenGate("main-floor",
                 "the untouched main.cpp gets 0 points (no check passes), exercise.toml says floor = 1");
  replace(exercise() / "exercise.toml", "floor = 1", "floor = 0");
  replace(exercise() / "main.cpp", "return Eigen::Vector2d::Zero();", "return angle < 9 ? p : p;");
  expectOpenGate("main-floor", "gets 2 points (keeps-length 1, angles-add 1), exercise.toml says floor = 0");
  replace(exercise() / "main.cpp", "return angle", "int unused;\n  return angle");
  expectOpenGate("main-floor", "main.cpp does not compile cleanly");
}

TEST_F(ExerciseGates, FindsWhatIsWrongWithTheSolution) {
  replace(exercise() / "solution.cpp", "s * p.x() + c * p.y()", "s * p.x() + c * p.x()");
  expectOpenGate("solution", "under seed 1");
  replace(exercise() / "solution.cpp", "const double s = std::sin(angle);",
          "double sines[2] = {std::sin(angle), 0};\n  const double s = sines[angle > 99 ? 0 : 2];");
  expectOpenGate("sanitizers", "solution.cpp does not pass with the sanitizers:");
}

TEST_F(ExerciseGates, FindsWhatMainDoes) {
  const std::string whole = fileText(exercise() / "main.cpp");
  write(exercise() / "main.cpp",
        "#include <cstdlib>\n" + whole.substr(0, whole.find("int main(")) + "int main() { std::abort(); }\n");
  expectOpenGate("mains", "main() of main.cpp ends with signal 6");
}

TEST_F(ExerciseGates, FindsMistakesThatAreNotCaught) {
  replace(exercise() / "wrong.cpp", "caught by: quarter-turn", "caught by: keeps-length");
  expectOpenGate("wrong/clockwise", "check 'keeps-length' does not catch this mistake: turns clockwise.");
  replace(exercise() / "wrong.cpp", "keeps-length", "keeps-lenght");
  expectOpenGate("wrong/clockwise", "no check is called 'keeps-lenght'");
  replace(exercise() / "wrong.cpp", "shown by: quarter-turn", "shown by: keeps-length");
  replace(exercise() / "wrong.cpp", "keeps-lenght", "quarter-turn");
  expectOpenGate("wrong/clockwise", "check 'keeps-length' leaves no picture");
  const Ended isPrivate = rex({"dev", "check", "98", "--gate", "evidence"});
  EXPECT_EQ(isPrivate.code, 64);
  EXPECT_THAT(flat(isPrivate.error), HasSubstr("the gate evidence does not apply to 98-template: found "
                                               "profile = \"private\" in its exercise.toml"));
  replace(exercise() / "exercise.toml", "\"private\"", "\"public\"");
  replace(exercise() / "wrong.cpp", "// shown by: keeps-length\n", "");
  expectOpenGate("evidence", "no wrong variant names a check that shows its mistake");
  const std::string wrong = fileText(exercise() / "wrong.cpp");
  write(exercise() / "wrong.cpp", wrong.substr(wrong.find("// <variant library>")));
  expectOpenGate("evidence", "part 'rotate': no wrong variant is caught by one of its checks");
  replace(exercise() / "wrong.cpp", "rex::rotationAboutAxis(angle, Eigen::Vector3d::UnitZ())",
          "Eigen::Matrix3d::Identity()");
  expectOpenGate("wrong/library", "no call was found");
}

TEST_F(ExerciseGates, FindsShownCodeThatGetsPoints) {
  EXPECT_EQ(rex({"dev", "check", "98", "--gate", "pasted"}).code, 0);
  write(exercise() / "help.h",
        "#pragma once\n#include \"exercise.h\"\n"
        "inline Eigen::Vector2d turnedBy(double a, Eigen::Vector2d v, bool isLeft = true) {\n"
        "  const double s = isLeft ? std::sin(a) : -std::sin(a), c = std::cos(a);\n"
        "  return {c * v.x() - s * v.y(), s * v.x() + c * v.y()};\n}\n");
  write(exercise() / "show.cpp",
        "#include <cmath>\n#include \"help.h\"\n"
        "void show(const Eigen::Vector2d& at, double turn) {\n"
        "  const Eigen::Vector2d end = Eigen::Vector2d(std::cos(turn) * at.x() - std::sin(turn) * at.y(),\n"
        "                                              std::sin(turn) * at.x() + std::cos(turn) * at.y());\n"
        "  rex::print(\"end\", Eigen::MatrixXd(end));\n}\n");
  expectOpenGate("pasted",
                 "show.cpp: the function 'turnedBy', pasted into 'rotated', passes keeps-length, "
                 "quarter-turn");
  expectOpenGate("pasted", "show.cpp: the expression 'Eigen::Vector2d(std::cos(turn) * at.x()");
  expectOpenGate("pasted", "pasted 1 functions and 1 expressions");
}

TEST_F(ExerciseGates, RunsTheChosenGatesAndPrintsThemAsJson) {
  const Ended ended = rex({"dev", "check", "98", "--gate", "points", "--gate", "names", "--json"});
  EXPECT_EQ(ended.code, 0) << ended.error;
  EXPECT_EQ(
      ended.output,
      "{\"gates\":[{\"exercise\":\"98-template\",\"gate\":\"names\",\"passed\":true,\"message\":\"\","
      "\"note\":\"\"},{\"exercise\":\"98-template\",\"gate\":\"points\",\"passed\":true,\"message\":\"\","
      "\"note\":\"\"}],\"blocked\":[]}\n");
  EXPECT_EQ(schemaFaultsOf(ended.output, "dev_check"), "");
  EXPECT_EQ(schemaFaultsOf("{\"gates\": [], \"blokced\": []}", "dev_check").empty(), false);
  const std::string names = rex({"dev", "check", "98", "--list-gates", "--json"}).output;
  EXPECT_EQ(schemaFaultsOf(names, "dev_check_gates"), "");
  EXPECT_THAT(names, HasSubstr("{\"98-template\":[\"main-current\",\"names\","));
}

TEST_F(ExerciseGates, ABrokenDescriptionFailsItsOwnExerciseOnly) {
  fs::create_directory(root() / "exercises" / "99-broken");
  write(root() / "exercises" / "99-broken" / "exercise.toml", "title = \"no end\n");
  EXPECT_EQ(rex({"dev", "check", "98", "--gate", "points"}).code, 0);
  const Ended broken = rex({"dev", "check", "--gate", "points"});
  EXPECT_EQ(broken.code, 1);
  EXPECT_THAT(broken.output, HasSubstr(" ok   98-template  points\n FAIL  99-broken  exercise.toml\n"));
  EXPECT_THAT(flat(broken.output), HasSubstr("99-broken/exercise.toml:1:"));
}

TEST_F(ExerciseGates, MakesANewExercise) {
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

TEST_F(ExerciseGates, MakesAnExerciseForAHeader) {
  fs::copy_file(sourcePath("tests/authoring/made/exercise.h"), root() / "mine.h");
  const Ended made = rex({"dev", "new", "97-made", (root() / "mine.h").string()});
  EXPECT_EQ(made.code, 0) << made.error;
  EXPECT_EQ(fileText(root() / "exercises/CMakeLists.txt"),
            "rex_exercise(97-made FUNCTIONS turned angles isStill posed longest)\n");
  for (const std::string file :
       {"README.md", "exercise.toml", "solution.cpp", "main.cpp", "show.cpp", "check.cpp"})
    EXPECT_EQ(fileText(root() / "exercises/97-made" / file),
              fileText(sourcePath("tests/authoring/made/" + file)));
  write(root() / "mine.h", "#include \"course/course.h\"\nvoid turn(double angle);\n");
  const Ended bad = rex({"dev", "new", "96-bad", (root() / "mine.h").string()});
  EXPECT_THAT(flat(bad.error),
              HasSubstr("mine.h:2:1: the value of turn: found 'void', wanted the type of a value"));
  EXPECT_FALSE(fs::exists(root() / "exercises/96-bad"));
}

TEST_F(ExerciseGates, SaysWhereTheReleaseOfEarlierVersionsWent) {
  for (const std::vector<std::string>& arguments : std::vector<std::vector<std::string>>{
           {"dev", "strip", "--release", "-o", "students"}, {"dev", "strip", "-o", "students"}}) {
    const Ended ended = rex(arguments);
    EXPECT_EQ(ended.code, 64);
    EXPECT_THAT(ended.error, HasSubstr("to make the student release, use: scripts/rex dev release students"));
  }
  EXPECT_THAT(rex({"dev", "strip"}).error, HasSubstr("EXERCISE is required"));
}

TEST_F(ExerciseGates, SaysHowToGetTheBenchmarks) {
  const Ended ended = rex({"dev", "bench"});
  EXPECT_EQ(ended.code, 3);
  EXPECT_THAT(ended.error, HasSubstr("the benchmarks are not built: wanted scripts/rex dev bench"));
}

std::set<std::string> linesOf(const std::string& output) {
  std::set<std::string> lines;
  std::istringstream text(output);
  for (std::string line; std::getline(text, line);) lines.insert(line);
  return lines;
}

// The tests of an exercise with this label that CMake registered, without "  Test #12:
// exercise/01-kinematics/".
std::set<std::string> registered(const std::string& exercise, const std::string& label) {
  std::set<std::string> gates;
  for (const std::string& line : linesOf(registeredTests({"-L", "^" + label + "$"}))) {
    const std::string prefix = "exercise/" + exercise + "/";
    const std::size_t at = line.find(prefix);
    if (at != std::string::npos) gates.insert(line.substr(at + prefix.size()));
  }
  return gates;
}

std::set<std::string> listed(const std::string& exercise) {
  const ProcessResult result = runProcess({buildPath("rex-teach"), "dev", "check", exercise, "--list-gates"});
  EXPECT_TRUE(result.ok()) << result.error;
  return linesOf(result.output);
}

TEST(Gates, AreAllTestsOfTheSuite) {
  const auto exercises = submission::listExercises(sourcePath("exercises"));
  ASSERT_FALSE(exercises.empty());
  for (const submission::ExerciseInfo& exercise : exercises) {
#ifdef __SANITIZE_ADDRESS__
    EXPECT_EQ(registered(exercise.name, exercise.name), std::set<std::string>{"hostile"})
        << "see RexGates.cmake";
#else
    EXPECT_EQ(registered(exercise.name, "sample-" + exercise.name), std::set<std::string>{"sample"})
        << "see scripts/test";
    EXPECT_EQ(registered(exercise.name, exercise.name), listed(exercise.name));
#endif
  }
}

}  // namespace rex::cli::gates_test
