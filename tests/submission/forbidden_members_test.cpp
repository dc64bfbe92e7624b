// A member of Simulator that solves an exercise is forbidden in it, but for main().
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/text_file.h"
#include "submission/program_build.h"
#include "submission/student_build.h"
#include "support/paths.h"
#include "support/temporary_folder.h"

namespace rex::submission::forbidden_members_test {

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

}  // namespace rex::submission::forbidden_members_test
