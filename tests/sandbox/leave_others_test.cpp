#include "sandbox/leave_others.h"

#include <fstream>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "base/isolated_call.h"
#include "base/process.h"

namespace rex::sandbox::leave_others_test {

// Which of these files of a process a copy of ours, or a shell that it becomes, opens.
std::string opened(pid_t process, bool leaves, bool becomesShell) {
  const std::string folder = "/proc/" + std::to_string(process) + "/";
  const IsolatedResult result = callIsolated([&] {
    if (leaves && !leaveOthersAlone()) return std::string("cannot");
    std::string names;
    for (const char* file : {"environ", "mem", "maps", "auxv"}) {
      const std::string path = folder + file;
      const bool opens = becomesShell ? runProcess({"sh", "-c", "exec < " + path}).ok()
                                      : ::open(path.c_str(), O_RDONLY) >= 0;
      if (opens) names += std::string(file) + " ";
    }
    return names;
  });
  EXPECT_EQ(result.end, IsolatedEnd::kReturned);
  return result.bytes;
}

// Whether their variables can be read as well depends on the kernel.
TEST(LeaveOthersAlone, HidesTheMemoryOfOthers) {
  EXPECT_EQ(opened(::getpid(), false, false), "environ mem maps auxv ");
  for (const pid_t process : {::getpid(), ::getppid()}) {
    const std::string left = opened(process, true, true);
    if (left == "cannot") GTEST_SKIP() << "neither landlock nor root";
    EXPECT_EQ(left.find("mem"), left.npos) << left;
  }
}

TEST(LeaveOthersAlone, ForbidsNothingElse) {
  const IsolatedResult result = callIsolated([&] {
    leaveOthersAlone();
    const bool writes = std::ofstream("/dev/null") << "text" ? true : false;
    return std::string(writes ? "writes " : "") + runProcess({"echo", "runs"}).output;
  });
  EXPECT_EQ(result.bytes, "writes runs\n");
}

}  // namespace rex::sandbox::leave_others_test
