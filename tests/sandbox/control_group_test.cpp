#include <optional>

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/error.h"
#include "sandbox/cell.h"

namespace rex::sandbox::control_group_test {

namespace fs = std::filesystem;

std::optional<ControlGroup>& make(std::optional<ControlGroup>& group) {
  try {
    group.emplace(64u << 20, 8);
  } catch (const Error&) {
  }
  return group;
}

// Folders of groups that this process made.
int groupsOf(pid_t owner, const ControlGroup& example) {
  int count = 0;
  for (const fs::path& list : example.processes())
    for (const auto& entry : fs::directory_iterator(list.parent_path().parent_path()))
      count += entry.path().filename().string().starts_with("rex-" + std::to_string(owner) + "-") ? 1 : 0;
  return count;
}

TEST(ControlGroup, RemovesThoseOfKilledOwners) {
  std::optional<ControlGroup> example;
  if (!make(example)) GTEST_SKIP() << "no control group can be made here";
  const pid_t owner = ::fork();
  if (owner == 0) {
    std::optional<ControlGroup> group;
    make(group);
    ::_exit(0);
  }
  ::waitpid(owner, nullptr, 0);
  EXPECT_GT(groupsOf(owner, *example), 0);
  std::optional<ControlGroup> next;
  ASSERT_TRUE(make(next));
  EXPECT_EQ(groupsOf(owner, *example), 0);
  EXPECT_EQ(groupsOf(::getpid(), *example), 2 * static_cast<int>(example->processes().size()));
}

// Numbers of processes come again.
TEST(ControlGroup, IsNotDisturbedByOneOfTheSameNumber) {
  std::optional<ControlGroup> group;
  if (!make(group)) GTEST_SKIP() << "no control group can be made here";
  std::vector<fs::path> left;
  for (const fs::path& list : group->processes())
    for (int k = 1; k < 9; ++k)
      left.push_back(list.parent_path().parent_path() /
                     ("rex-" + std::to_string(::getpid()) + "-" + std::to_string(k)));
  for (const fs::path& folder : left) fs::create_directory(folder);
  std::optional<ControlGroup> next;
  EXPECT_TRUE(make(next));
  for (const fs::path& folder : left) ::rmdir(folder.c_str());
}

}  // namespace rex::sandbox::control_group_test
