#include "submission/program_build.h"

#include <chrono>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/process.h"
#include "base/text_file.h"
#include "submission/student_build.h"
#include "support/expect_error.h"
#include "support/paths.h"
#include "support/temporary_folder.h"

namespace rex::submission::program_build_test {

using std::filesystem::path;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using namespace std::chrono_literals;

// Four libraries in three folders: solver is a part of kinematics that is built apart.
ProgramToolchain fourLibraries() {
  return {.toolchain = {},
          .sourceFolder = "/rex/src",
          .libraries = {{.target = "rex_base", .folder = "base", .headers = {"rng.h"}},
                        {.target = "rex_kinematics",
                         .folder = "kinematics",
                         .headers = {"jacobians.h"},
                         .uses = {"rex_base"}},
                        {.target = "rex_solver",
                         .folder = "kinematics",
                         .headers = {"solver.h"},
                         .symbols = {"rex::Robot::solve"},
                         .uses = {"rex_kinematics"}},
                        {.target = "rex_planning",
                         .folder = "planning",
                         .headers = {"rrt.h"},
                         .uses = {"rex_kinematics"}}}};
}

std::vector<std::string> targetsFor(const std::vector<std::filesystem::path>& files,
                                    std::string_view symbols = "") {
  std::vector<std::string> targets;
  for (const LibraryPart& one : librariesFor(fourLibraries(), files, symbols)) targets.push_back(one.target);
  return targets;
}

TEST(ProgramBuild, TakesTheLibrariesOfHeadersAndWhatTheyUse) {
  EXPECT_THAT(targetsFor({"/rex/src/base/rng.h"}), ElementsAre("rex_base"));
  EXPECT_THAT(targetsFor({"/rex/src/planning/rrt.h"}),
              ElementsAre("rex_base", "rex_kinematics", "rex_planning"));
  EXPECT_THAT(targetsFor({"/rex/src/kinematics/solver.h"}),
              ElementsAre("rex_base", "rex_kinematics", "rex_solver"));
  // A header without a source of its name belongs to the first library of its folder.
  EXPECT_THAT(targetsFor({"/rex/src/kinematics/task.h"}), ElementsAre("rex_base", "rex_kinematics"));
  EXPECT_THAT(targetsFor({"/usr/include/stdio.h", "/home/me/rrt.h", "/rex/src/nowhere/a.h", "relative.h"}),
              IsEmpty());
}

TEST(ProgramBuild, TakesTheLibrariesOfUndefinedSymbols) {
  const std::string lines =
      "0000000000000000         *UND*\t0000000000000000 rex::Robot::solve(int)\n"
      "0000000000000000         *UND*\t0000000000000000 _GLOBAL_OFFSET_TABLE_\n";
  EXPECT_THAT(targetsFor({}, lines), ElementsAre("rex_base", "rex_kinematics", "rex_solver"));
  for (const char* other : {"0000000000000000 g     F .text\t0000000000000001 rex::Robot::solve(int)\n",
                            "0000000000000000         *UND*\t0000000000000000 rex::Robot::solveAll(int)\n",
                            "0000000000000000         *UND*\t0000000000000000 my::rex::Robot::solve(int)"})
    EXPECT_THAT(targetsFor({}, other), IsEmpty()) << other;
}

TEST(ProgramBuild, ReadsWhatTheBuildWrote) {
  const ProgramToolchain real = readProgramToolchain(buildPath("student/program.json"));
  std::vector<std::string> targets;
  for (const LibraryPart& one : librariesFor(real, {real.sourceFolder / "planning/rrt.h"}, ""))
    targets.push_back(one.target);
  EXPECT_THAT(targets, ::testing::IsSupersetOf({"rex_base", "rex_collision", "rex_planning"}));
  EXPECT_THAT(targets, ::testing::Not(::testing::Contains("rex_estimation")));
}

TEST(ProgramBuild, RefusesOtherFiles) {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "program.json";
  EXPECT_REX_ERROR(readProgramToolchain(file), "program.json: the project is not built: wanted this file");
  writeTextFile(file, "{}");
  EXPECT_REX_ERROR(readProgramToolchain(file), "program.json: not a build description: found ");
}

const std::vector<std::string>& flags() {
  static const std::vector<std::string> kFlags = {"-O1", "-iquote", sourcePath("tests/grading/sample"),
                                                  "-isystem", sourcePath("src")};
  return kFlags;
}

TEST(OpensWithCourseHeader, BehindOtherHeadersAndComments) {
  EXPECT_TRUE(opensWithCourseHeader("#include \"exercise.h\"", {}));
  EXPECT_TRUE(opensWithCourseHeader("#include <cmath>\n#include \"course/course.h\"\nint x;\n", {}));
  EXPECT_FALSE(opensWithCourseHeader("#include \"course/print.h\"\nint x;\n", flags()));
  EXPECT_TRUE(
      opensWithCourseHeader("// Mine.\r\n\n#include <cmath>\n  #include\t\"control/pid.h\"  // why\n"
                            "#include <exercise.h>\nint x;\n",
                            flags()));
}

TEST(OpensWithCourseHeader, NotBehindWhatCouldChangeIt) {
  for (const char* first :
       {"#define EIGEN_NO_IO", "#include \"/tmp/a.h\"", "#include \"../src/control/pid.h\"", "int x;",
        "#include \"main.cpp\"", "#include NAME", "/*", "// on and on \\", "#if 0", "#include <cmath",
        "#pragma GCC system_header", "#include <cstdlib> /*", "#include <X11/Xlib.h>", "#include \"mine.h\"",
        "#include <math.h>", "#include \"good.cpp\""})
    EXPECT_FALSE(opensWithCourseHeader(std::string(first) + "\n#include \"exercise.h\"\n", flags())) << first;
  EXPECT_FALSE(opensWithCourseHeader("", flags()));
  EXPECT_FALSE(opensWithCourseHeader("#include <cmath>\n", flags()));
}

constexpr const char* kSource = "#include \"exercise.h\"\n";

// A small exercise in a folder with a blank in its name, and the precompiled header of its course.
class PrefixTest : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    shared_ = std::make_unique<TemporaryFolder>();
    writeTextFile(
        folder() / "src/course/course.h",
        "#pragma once\n#include <Eigen/Core>\n#include <vector>\nnamespace rex { double same(double); "
        "inline int half(int a) { return a / 2; } }\n");
    writeTextFile(folder() / "exercise/exercise.h",
                  "#pragma once\n#include \"course/course.h\"\nint twice(int a);\n");
    setAge(header(), 1h);
    makePrefix(prefix(), toolchain());
  }
  static void TearDownTestSuite() { shared_.reset(); }
  void TearDown() override { setAge(header(), 1h); }

  static path folder() { return shared_->path() / "a folder"; }
  static path prefix() { return folder() / "prefix.h"; }
  static path header() { return folder() / "src/course/course.h"; }
  static void setAge(const path& file, std::chrono::hours age) {
    static const auto kNow = std::filesystem::file_time_type::clock::now();
    std::filesystem::last_write_time(file, kNow - age);
  }

  static Toolchain toolchain() {
    return {.compiler = "g++",
            .flags = {"-std=c++20", "-O1", "-Wall", "-Wextra", "-iquote", folder() / "exercise", "-isystem",
                      folder() / "src", "-isystem", "/usr/include/eigen3"},
            .linkFlags = {},
            .workerObject = {},
            .grader = {},
            .libraries = {},
            .prefix = prefix()};
  }

  static StudentObject compile(const Toolchain& toolchain, const std::string& source) {
    writeTextFile(shared_->path() / "main.cpp", source);
    return compileStudent(toolchain, {},
                          {.main = shared_->path() / "main.cpp", .workFolder = shared_->path() / "work"});
  }

  static std::unique_ptr<TemporaryFolder> shared_;
};
std::unique_ptr<TemporaryFolder> PrefixTest::shared_;

TEST_F(PrefixTest, GivesFlagsWhileItIsCurrent) {
  EXPECT_EQ(prefixFlags(prefix(), kSource, {}), (std::vector<std::string>{"-include", prefix()}));
  EXPECT_TRUE(prefixFlags(prefix(), "int x;\n", {}).empty());
  EXPECT_TRUE(prefixFlags({}, kSource, {}).empty());
  EXPECT_FALSE(prefixFlags(prefix(), kSource, {"-isystem", (folder() / "src").string()}).empty());
  writeTextFile(folder() / "moved/course/course.h", readTextFile(folder() / "src/course/course.h"));
  EXPECT_TRUE(prefixFlags(prefix(), kSource, {"-isystem", (folder() / "moved").string()}).empty())
      << "made with the header of another rex";
  for (const std::chrono::hours age : {-1h, 2h}) {
    setAge(header(), age);
    EXPECT_TRUE(prefixFlags(prefix(), kSource, {}).empty()) << "an updated rex may have older headers";
  }
  setAge(header(), 1h);
  EXPECT_FALSE(prefixFlags(prefix(), kSource, {}).empty());
}

TEST_F(PrefixTest, IsMadeOnceForTheSameFiles) {
  const path precompiled = prefix().string() + ".gch";
  const auto made = std::filesystem::last_write_time(precompiled);
  makePrefix(prefix(), toolchain());
  EXPECT_EQ(std::filesystem::last_write_time(precompiled), made);
  setAge(header(), 2h);
  makePrefix(prefix(), toolchain());
  EXPECT_NE(std::filesystem::last_write_time(precompiled), made);
  EXPECT_FALSE(prefixFlags(prefix(), kSource, {}).empty());
  setAge(header(), 1h);
  makePrefix(prefix(), toolchain());
  std::filesystem::remove(prefix().string() + ".gch.made-from");
  EXPECT_FALSE(prefixFlags(prefix(), kSource, {}).empty()) << "a build program looks after this one";
  setAge(header(), -1h);
  EXPECT_TRUE(prefixFlags(prefix(), kSource, {}).empty());
  setAge(header(), 1h);
  makePrefix(prefix(), toolchain());
}

TEST_F(PrefixTest, LeavesNothingWhereTheCompilerIsTooSlowOrRefuses) {
  const path other = folder() / "other" / "prefix.h";
  std::filesystem::create_directories(other.parent_path());
  const path slow = other.parent_path() / "slow";
  writeTextFile(slow, "#!/bin/sh\nfor word; do :; done\necho half >\"$word\"\nexec sleep 60\n");
  std::filesystem::permissions(slow, std::filesystem::perms::owner_all);
  const auto filesLeft = [&] {
    return std::distance(std::filesystem::directory_iterator(other.parent_path()), {});
  };
  Toolchain real = toolchain();
  real.compiler = slow;
  EXPECT_REX_ERROR(makePrefix(other, real, 0.5),
                   "slow: the compiler did not read the library within 0.5 s: wanted a machine that is less "
                   "busy: `rex update` tries again");
  EXPECT_EQ(filesLeft(), 2) << "prefix.h and the compiler";
  real.compiler = "g++";
  real.flags.insert(real.flags.end(), {"-include", "no_such_file.h"});
  EXPECT_REX_ERROR(makePrefix(other, real), "g++: the compiler cannot read the library: found ");
  EXPECT_EQ(filesLeft(), 2);
}

TEST_F(PrefixTest, GivesNoFlagsWhereAFileIsMissing) {
  const path other = folder() / "other.h";
  EXPECT_TRUE(prefixFlags(other, kSource, {}).empty());
  writeTextFile(other.string() + ".gch", "");
  EXPECT_TRUE(prefixFlags(other, kSource, {}).empty());
  writeTextFile(other.string() + ".d", "other.h.gch: no\\ such\\ file.h\n");
  EXPECT_TRUE(prefixFlags(other, kSource, {}).empty());
  writeTextFile(other.string() + ".d", "");
  EXPECT_TRUE(prefixFlags(other, kSource, {}).empty());
}

TEST_F(PrefixTest, IsTakenByTheCompiler) {
  // The compiler reads this only if it does not take what was made before.
  const auto written = std::filesystem::last_write_time(prefix());
  writeTextFile(prefix(), "#error not precompiled\n");
  std::filesystem::last_write_time(prefix(), written);
  const StudentObject object =
      compile(toolchain(), "#include \"exercise.h\"\nint twice(int a) { return a; }\n");
  writeTextFile(prefix(), "#include \"course/course.h\"\n");
  std::filesystem::last_write_time(prefix(), written);
  EXPECT_TRUE(object.ok) << object.log;
}

TEST_F(PrefixTest, ChangesNoMessageAndNoSymbol) {
  Toolchain without = toolchain();
  without.prefix.clear();
  const std::string good =
      "int twice(int a) {\n  int unused;\n  return rex::half(4 * a) + (int)std::vector<int>(3).size();\n}\n";
  const std::string bad =
      "long twice(int a) { return a; }\nnamespace rex {\nint same(double);\nint half(int a) { return a; "
      "}\n}\n"
      "std::vector<int&> all;\nstd::map<int, int> unknown;\nint x = ;\nint y = z;\n"
      "Eigen::Vector3d f(Eigen::Vector3d a, Eigen::Vector2d b) {\n  return a + b;\n}\n";
  for (const std::string& rest : {good, bad, std::string("#include \"none.h\"\n")}) {
    const std::string source = std::string("#include <cassert>\n\n// Mine.\n") + kSource + rest;
    ASSERT_FALSE(prefixFlags(prefix(), source, toolchain().flags).empty()) << source;
    const StudentObject a = compile(toolchain(), source);
    const std::string symbols = a.ok ? runProcess({"nm", a.object}).output : "";
    const StudentObject b = compile(without, source);
    EXPECT_EQ(a.ok, rest == good) << source;
    EXPECT_EQ(a.ok, b.ok) << source;
    if (b.ok) {
      EXPECT_EQ(symbols, runProcess({"nm", b.object}).output) << source;
    }
    EXPECT_FALSE(a.messages.empty()) << source;
    ASSERT_EQ(a.messages.size(), b.messages.size()) << source;
    for (std::size_t k = 0; k < a.messages.size(); ++k)
      EXPECT_EQ(toString(a.messages[k]), toString(b.messages[k])) << source;
  }
}

// Builds with sanitizers have no precompiled header.
#ifndef __SANITIZE_ADDRESS__
// The header of the course itself, by the flags of an exercise: g++ names what it takes behind a "!".
TEST(Prefix, OfTheCourseIsTakenForAnExercise) {
  const Toolchain toolchain = readToolchain(ownFolder() / "exercises/04-rrt/build.json");
  if (toolchain.prefix.empty()) GTEST_SKIP() << "this build, not by g++, has no precompiled header";
  const std::vector<std::string> prefix = prefixFlags(toolchain.prefix, kSource, toolchain.flags);
  ASSERT_FALSE(prefix.empty());
  const TemporaryFolder folder;
  writeTextFile(folder.path() / "main.cpp", kSource);
  std::vector<std::string> command = {toolchain.compiler};
  command.insert(command.end(), toolchain.flags.begin(), toolchain.flags.end());
  command.insert(command.end(), prefix.begin(), prefix.end());
  command.insert(command.end(), {"-H", "-Winvalid-pch", "-fsyntax-only", folder.path() / "main.cpp"});
  const ProcessResult made = runProcess(command, {.directory = folder.path()});
  EXPECT_TRUE(made.ok()) << made.error;
  EXPECT_EQ(made.error.find("! " + toolchain.prefix.string() + ".gch"), 0u) << made.error.substr(0, 400);
}
#endif

TEST(Prefix, IsForWhatStudentsStartFrom) {
  int exercises = 0;
  for (const auto& folder : std::filesystem::directory_iterator(ownFolder() / "exercises")) {
    if (!std::filesystem::exists(folder.path() / "build.json")) continue;
    const Toolchain toolchain = readToolchain(folder.path() / "build.json");
    const path main = sourcePath("exercises") / folder.path().filename() / "main.cpp";
    EXPECT_TRUE(opensWithCourseHeader(readTextFile(main), toolchain.flags)) << main;
    ++exercises;
  }
  EXPECT_GT(exercises, 5);
}

// A member of Simulator that solves an exercise is forbidden in it, but for main().
constexpr const char* kAsks =
    "#include \"course/course.h\"\n"
    "rex::ReachedPosture reached(const rex::Simulator& S) {\n"
    "  return S.inverseKinematics(\"hand\", Eigen::Vector3d(1, 0, 0));\n"
    "}\n"
    "int main() {}\n";
constexpr const char* kCompares =
    "#include \"course/course.h\"\n"
    "int main() {\n"
    "  return rex::Simulator(\"man.ors\").inverseKinematics(\"handR\", rex::Pose{}).isReached ? 0 : 1;\n"
    "}\n";

// Compiled with what all students have; each list of forbidden functions is looked for in the same file.
TEST(ForbiddenMembers, OfTheSimulatorInExercisesThatAskForThem) {
  const TemporaryFolder folder;
  const Toolchain toolchain = readProgramToolchain(buildPath("student/program.json")).toolchain;
  std::vector<ForbiddenFunction> forbidden;
  for (const char* exercise : {"00-basics", "01-kinematics", "02-pegInAHole"}) {
    const ExerciseInfo info = readExerciseInfo(sourcePath(std::string("exercises/") + exercise));
    const auto member =
        std::ranges::find(info.forbidden, "rex::Simulator::inverseKinematics", &ForbiddenFunction::function);
    ASSERT_NE(member, info.forbidden.end()) << exercise;
    forbidden.push_back(*member);
  }
  const auto compile = [&](const char* source) {
    writeTextFile(folder.path() / "main.cpp", source);
    return compileStudent(
        toolchain, {forbidden.front()},
        {.main = folder.path() / "main.cpp", .workFolder = folder.path() / "work", .graded = true});
  };
  const StudentObject refused = compile(kAsks);
  EXPECT_FALSE(refused.ok);
  ASSERT_EQ(refused.messages.size(), 1u) << refused.log;
  EXPECT_EQ(refused.messages[0].rule, "forbidden-call");
  EXPECT_EQ(refused.messages[0].line, 3);
  EXPECT_THAT(refused.messages[0].message, testing::HasSubstr("rex::Simulator::inverseKinematics"));
  EXPECT_TRUE(compile(kCompares).ok);
}

}  // namespace rex::submission::program_build_test
