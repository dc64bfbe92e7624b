#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/folders.h"
#include "base/text_file.h"
#include "support/temporary_folder.h"

namespace rex::leftovers_test {

namespace fs = std::filesystem;

// A process that has ended, whose number is free.
pid_t endedProcess() {
  const pid_t child = ::fork();
  if (child == 0) ::_exit(0);
  ::waitpid(child, nullptr, 0);
  return child;
}

TEST(Leftovers, AreThoseOfEndedProcesses) {
  const TemporaryFolder temporary;
  const std::string ended = std::to_string(endedProcess()), alive = std::to_string(::getpid());
  const auto write = [&](const std::string& name) { writeTextFile(temporary.path() / name, "x"); };
  write("zoe/01/main.cpp." + ended + ".new"), write("grades.csv." + ended + ".new");
  const std::vector<std::string> kept = {"grades.csv",      "zoe/main.cpp." + alive + ".new",
                                         "notes.new",       "a.b.new",
                                         "zoe/01/main.cpp", "." + ended + ".new",
                                         ended + ".new",    "x.-" + ended + ".new"};
  for (const std::string& name : kept) write(name);
  fs::create_directory_symlink(temporary.path() / "zoe", temporary.path() / ("link." + ended + ".new"));
  removeLeftovers(temporary.path(), 1);
  EXPECT_FALSE(fs::exists(temporary.path() / ("grades.csv." + ended + ".new")));
  EXPECT_TRUE(fs::exists(temporary.path() / ("zoe/01/main.cpp." + ended + ".new"))) << "deeper";
  removeLeftovers(temporary.path(), 2);
  EXPECT_FALSE(fs::exists(temporary.path() / ("zoe/01/main.cpp." + ended + ".new")));
  EXPECT_TRUE(fs::is_symlink(temporary.path() / ("link." + ended + ".new")));
  for (const std::string& name : kept) EXPECT_TRUE(fs::exists(temporary.path() / name)) << name;
  removeLeftovers(temporary.path() / "none");
}

}  // namespace rex::leftovers_test
