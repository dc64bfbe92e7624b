// The probes hold at every level that stands, and each of them can fail.
#include "sandbox/probes.h"

#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sandbox/landlock.h"
#include "support/paths.h"
#include "support/temporary_folder.h"

namespace rex::sandbox::probes_test {

namespace fs = std::filesystem;

const fs::path kLauncher = ownFolder() / "rex-sandbox", kProbe = ownFolder() / "rex-sandbox-probe";

class Probes : public ::testing::TestWithParam<int> {
 protected:
  TemporaryFolder folder_;
};

TEST_P(Probes, AllHoldWhereTheLevelStands) {
  const Sandbox sandbox{.level = parseLevel(GetParam()), .launcher = kLauncher};
  if (const std::string reason = whyNot(sandbox, kProbe, folder_.path()); !reason.empty())
    GTEST_SKIP() << "sandbox level " << GetParam() << ": " << reason;
  std::vector<std::string> names;
  for (const Probe& probe : attack(sandbox, kProbe, folder_.path())) {
    EXPECT_TRUE(probe.held) << probe.name << ": " << probe.text;
    names.push_back(probe.name);
  }
  EXPECT_THAT(names,
              ::testing::ElementsAre("file", "proc", "net", "fork", "exec", "lock", "calls", "ptrace",
                                     "unshare", "userfaultfd", "bpf", "mem", "fd", "tmpfs size", "leftover"));
}
INSTANTIATE_TEST_SUITE_P(Levels, Probes, ::testing::Values(3, 2, 1));

// The slower attacks would do harm where nothing stops them.
TEST_F(Probes, NoticeThatLimitsAloneAreNoSandbox) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "with sanitizers, the probe needs more addresses than it may have";
#endif
  const Sandbox sandbox{.level = Level{0}, .launcher = kLauncher};
  EXPECT_THAT(whyNot(sandbox, kProbe, folder_.path()), ::testing::HasSubstr("read "));
}

TEST_F(Probes, SayWhyALevelDoesNotStand) {
  const Available available = bestLevel(folder_.path() / "no-launcher", kProbe, folder_.path());
  EXPECT_EQ(available.level, Level::kLimitsOnly);
  ASSERT_EQ(available.reasons.size(), 3u);
  EXPECT_THAT(available.reasons.back(), ::testing::HasSubstr("level 1: the launcher does not start"));
}

// A program that fails as bubblewrap does where it may not make namespaces.
TEST_F(Probes, BlameNoAttackThatNeverRan) {
  const fs::path launcher = folder_.path() / "launcher";
  std::ofstream(launcher) << "#!/bin/sh\necho bwrap: No permissions >&2\nexit 1\n";
  fs::permissions(launcher, fs::perms::owner_all);
  for (const Probe& probe : attack({.level = Level{1}, .launcher = launcher}, kProbe, folder_.path())) {
    EXPECT_FALSE(probe.held || probe.ran) << probe.name;
    EXPECT_EQ(probe.text, "the sandbox cannot be set up: bwrap: No permissions");
  }
}

TEST_F(Probes, WarnBelowTheHighestLevel) {
  EXPECT_EQ(levelWarning(Level::kControlGroup), "");
  for (const int level : {0, 1, 2})
    EXPECT_THAT(levelWarning(parseLevel(level)),
                ::testing::StartsWith("sandbox level " + std::to_string(level) + " of 3: "));
}

}  // namespace rex::sandbox::probes_test
