#include "sandbox/system_calls.h"

#include <csignal>
#include <fstream>
#include <functional>
#include <map>

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <linux/openat2.h>
#include <sched.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include "base/isolated_call.h"
#include "support/temporary_folder.h"

namespace rex::sandbox::system_calls_test {

// What a program may try on a file and on its parent; 0 or more: it can.
using Attempts = std::map<std::string, std::function<long(const char* file, pid_t parent)>>;

const Attempts kNever = {
    {"F_SETOWN", [](auto* file, pid_t parent) { return ::fcntl(::open(file, O_RDONLY), F_SETOWN, parent); }},
    {"F_SETOWN_EX",
     [](auto* file, pid_t parent) {
       const f_owner_ex owner{F_OWNER_PID, parent};
       return ::fcntl(::open(file, O_RDONLY), F_SETOWN_EX, &owner);
     }},
    {"F_SETSIG", [](auto* file, pid_t) { return ::fcntl(::open(file, O_RDONLY), F_SETSIG, SIGWINCH); }},
    {"setpriority",
     [](auto*, pid_t parent) {
       return ::setpriority(PRIO_PROCESS, static_cast<id_t>(parent), ::getpriority(PRIO_PROCESS, 0));
     }},
    {"sched_setaffinity",
     [](auto*, pid_t parent) {
       cpu_set_t all;
       ::sched_getaffinity(parent, sizeof all, &all);
       return ::sched_setaffinity(parent, sizeof all, &all);
     }},
    {"sched_setscheduler",
     [](auto*, pid_t parent) {
       const sched_param none{};
       return ::sched_setscheduler(parent, SCHED_OTHER, &none);
     }},
    {"ioprio_set", [](auto*, pid_t parent) { return ::syscall(SYS_ioprio_set, 1, parent, 2 << 13); }},
    {"move_pages",
     [](auto*, pid_t parent) { return ::syscall(SYS_move_pages, parent, 0, nullptr, nullptr, nullptr, 0); }}};

const Attempts kOldKernels = {
    {"open", [](auto* file, pid_t) { return ::syscall(SYS_openat, AT_FDCWD, file, O_RDONLY | O_TRUNC); }},
#ifdef SYS_open
    {"old open", [](auto* file, pid_t) { return ::syscall(SYS_open, file, O_RDONLY | O_TRUNC); }},
    {"creat", [](auto* file, pid_t) { return ::syscall(SYS_creat, file, 0600); }},
#endif
    {"openat2",
     [](auto* file, pid_t) {
       open_how how{};
       how.flags = O_TRUNC;
       return ::syscall(SYS_openat2, AT_FDCWD, file, &how, sizeof how);
     }},
    {"kill", [](auto*, pid_t parent) { return ::kill(parent, 0); }}};

class SystemCalls : public ::testing::Test {
 protected:
  // The names of those that succeed behind a filter; no filter at level 0.
  std::string possible(const Attempts& attempts, int level, int landlock) const {
    const std::string file = temporary_.path() / "file";
    std::ofstream(file) << "text";
    const pid_t parent = ::getpid();
    const IsolatedResult result = callIsolated([&] {
      if (level > 0) filterSystemCalls({.level = level}, landlock);
      std::string names;
      for (const auto& [name, attempt] : attempts)
        if (attempt(file.c_str(), parent) >= 0) names += name + " ";
      return names + (::open(file.c_str(), O_RDONLY) >= 0 ? "reads" : "");
    });
    EXPECT_EQ(result.end, IsolatedEnd::kReturned);
    return result.bytes;
  }

  TemporaryFolder temporary_;
};

// Containers may forbid some of them without us.
TEST_F(SystemCalls, ReachNoOtherProcess) {
  EXPECT_THAT(possible(kNever, 0, 0), ::testing::StartsWith("F_SETOWN F_SETOWN_EX F_SETSIG "));
  for (const int level : {1, 2}) EXPECT_EQ(possible(kNever, level, 6), "reads") << level;
}

TEST_F(SystemCalls, AreFewerWhereLandlockIsOlder) {
  std::string all = possible(kOldKernels, 0, 0);
  EXPECT_THAT(all, ::testing::HasSubstr("open "));
  EXPECT_EQ(possible(kOldKernels, 1, 6), all);
  EXPECT_EQ(possible(kOldKernels, 1, 3), all.erase(all.find("kill "), 5));
  EXPECT_EQ(possible(kOldKernels, 1, 2), "reads");
}

}  // namespace rex::sandbox::system_calls_test
