#include "submission/program_build.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/text_file.h"
#include "support/expect_error.h"
#include "support/paths.h"
#include "support/temporary_folder.h"

namespace rex::submission::program_build_test {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

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

}  // namespace rex::submission::program_build_test
