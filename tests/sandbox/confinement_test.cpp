#include "sandbox/confinement.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sandbox/bubblewrap.h"
#include "sandbox/probes.h"
#include "support/expect_error.h"

namespace rex::sandbox::confinement_test {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::Not;

Confinement example() {
  return {.level = Level{3},
          .readable = {{"/project/worker", kInsideProgram}, {"/project/a b", "/project/a b"}},
          .writable = "/work folder",
          .environment = {"LC_ALL=C", "EMPTY="},
          .mayStartProgramsOfItsOwn = true,
          .cpuSeconds = 1.5,
          .wallSeconds = 5,
          .addressSpace = std::size_t{2} << 30,
          .fileSize = 4096,
          .openFiles = 17,
          .processes = 5,
          .user = 60706,
          .controlGroups = {"/sys/fs/cgroup/rex/cgroup.procs"},
          .reports = true};
}

TEST(Confinement, ComesBackFromItsArguments) {
  std::vector<std::string> arguments = toArguments(example());
  arguments.insert(arguments.end(), {"program", "--level", "--"});
  const Order order = orderFromArguments(arguments);
  EXPECT_THAT(order.command, ElementsAre("program", "--level", "--"));
  const Confinement& c = order.confinement;
  EXPECT_EQ(toArguments(c), toArguments(example()));
  EXPECT_EQ(c.level, Level::kControlGroup);
  EXPECT_EQ(c.readable.at(1).path, "/project/a b");
  EXPECT_EQ(c.readable.at(0).inside, kInsideProgram);
  EXPECT_EQ(c.writable, "/work folder");
  EXPECT_THAT(c.environment, ElementsAre("LC_ALL=C", "EMPTY="));
  EXPECT_EQ(c.cpuSeconds, 1.5);
  EXPECT_EQ(c.addressSpace, std::size_t{2} << 30);
  EXPECT_EQ(c.user, 60706u);
  EXPECT_TRUE(c.reports);
  EXPECT_TRUE(c.mayStartProgramsOfItsOwn);
}

TEST(Confinement, RefusesOtherArguments) {
  EXPECT_REX_ERROR(orderFromArguments({"--nonsense", "--", "a"}), "the sandbox has no option --nonsense");
  EXPECT_REX_ERROR(orderFromArguments({"--level"}), "an option of the sandbox lacks its value");
  EXPECT_REX_ERROR(orderFromArguments({"--cpu", "1x", "--", "a"}),
                   "an option of the sandbox: found 1x, wanted a number");
  EXPECT_REX_ERROR(orderFromArguments({"--cpu", "-1", "--", "a"}), "found -1");
  EXPECT_REX_ERROR(orderFromArguments({"--level", "1", "--"}), "the sandbox got no program");
}

// Root must be able to become another user inside; others get a namespace of users in which there is no
// other.
TEST(Bubblewrap, LeavesRootOnlyWhatTheLauncherNeeds) {
  const std::vector<std::string> asRoot = bubblewrapOptions(example(), "/build/rex-sandbox");
  EXPECT_THAT(asRoot,
              AllOf(Contains("CAP_SETUID"), Not(Contains("--unshare-user")), Contains("--unshare-net")));
  Confinement plain = example();
  plain.user.reset();
  const std::vector<std::string> asUser = bubblewrapOptions(plain, "/build/rex-sandbox");
  EXPECT_THAT(asUser,
              AllOf(Contains("--unshare-user"), Contains("--disable-userns"), Not(Contains("--cap-add"))));
  EXPECT_EQ(insidePath(plain, "/project/worker"), kInsideProgram);
  EXPECT_EQ(insidePath(plain, "/usr/bin/c++"), "/usr/bin/c++");
}

TEST(Report, TellsHowFarTheSandboxCame) {
  EXPECT_FALSE(readReport("").ready);
  EXPECT_EQ(readReport(errorLine("no room")).error, "no room");
  const Report ended = readReport(kReady + endLine(139));
  EXPECT_TRUE(ended.ready);
  EXPECT_EQ(ended.error, "");
  EXPECT_EQ(ended.status, 139);
  EXPECT_FALSE(readReport("ready\nend soon\n").status.has_value());
}

}  // namespace rex::sandbox::confinement_test
