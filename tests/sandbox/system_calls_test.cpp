#include "sandbox/system_calls.h"

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <thread>

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <linux/openat2.h>
#include <sched.h>
#include <sys/file.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include "base/isolated_call.h"
#include "base/process.h"
#include "sandbox/bubblewrap.h"
#include "support/temporary_folder.h"

namespace rex::sandbox::system_calls_test {

// What a program may try on a file and on its parent; 0 or more: it can.
using Attempts = std::map<std::string, std::function<long(const char* file, pid_t parent)>>;

// A lock on all of the file, by a system call that no library looks at.
long locked(const char* file, long command) {
  struct flock lock {};
  lock.l_type = F_RDLCK;
  return ::syscall(SYS_fcntl, ::open(file, O_RDONLY), command, &lock);
}

const Attempts kNever = {
    {"F_SETOWN", [](auto* file, pid_t parent) { return ::fcntl(::open(file, O_RDONLY), F_SETOWN, parent); }},
    {"F_SETOWN_EX",
     [](auto* file, pid_t parent) {
       const f_owner_ex owner{F_OWNER_PID, parent};
       return ::fcntl(::open(file, O_RDONLY), F_SETOWN_EX, &owner);
     }},
    {"F_SETSIG", [](auto* file, pid_t) { return ::fcntl(::open(file, O_RDONLY), F_SETSIG, SIGWINCH); }},
    {"flock", [](auto* file, pid_t) { return ::flock(::open(file, O_RDONLY), LOCK_EX | LOCK_NB); }},
    {"F_SETLK", [](auto* file, pid_t) { return locked(file, F_SETLK); }},
    {"F_SETLK in half", [](auto* file, pid_t) { return locked(file, F_SETLK | 1l << 32); }},
    {"F_GETLK", [](auto* file, pid_t) { return locked(file, F_GETLK); }},
    {"F_OFD_SETLK", [](auto* file, pid_t) { return locked(file, F_OFD_SETLK); }},
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
      if (level > 0) filterSystemCalls({.level = parseLevel(level)}, {}, landlock);
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
  EXPECT_THAT(possible(kNever, 0, 0),
              ::testing::StartsWith("F_GETLK F_OFD_SETLK F_SETLK F_SETLK in half F_SETOWN F_SETOWN_EX "
                                    "F_SETSIG flock "));
  for (const int level : {1, 2}) EXPECT_EQ(possible(kNever, level, 6), "reads") << level;
}

TEST_F(SystemCalls, AreFewerWhereLandlockIsOlder) {
  std::string all = possible(kOldKernels, 0, 0);
  EXPECT_THAT(all, ::testing::HasSubstr("open "));
  EXPECT_EQ(possible(kOldKernels, 1, 6), all);
  EXPECT_EQ(possible(kOldKernels, 1, 3), all.erase(all.find("kill "), 5));
  EXPECT_EQ(possible(kOldKernels, 1, 2), "reads");
}

// Calls that a kernel to come may add, such as the one that changed the rights of a file behind landlock.
TEST_F(SystemCalls, AreUnknownBeyondTheNewestThatWasLookedAt) {
  for (const bool isTool : {false, true}) {
    const IsolatedResult result = callIsolated([&] {
      filterSystemCalls({.level = Level{1}, .mayStartProgramsOfItsOwn = isTool});
      std::string known;
      for (long number = 463; number < 700; ++number)
        if (::syscall(number, -1, 0, 0, 0, 0, 0) >= 0 || errno != ENOSYS)
          known += std::to_string(number) + " ";
      return known + "none";
    });
    EXPECT_EQ(result.bytes, "none") << isTool;
  }
}

// How a program ends that tries this behind the filter of a student's.
IsolatedResult behindFilter(const std::function<long()>& attempt, bool isTool = false) {
  return callIsolated([&] {
    filterSystemCalls({.level = Level{2}, .mayStartProgramsOfItsOwn = isTool});
    return attempt() < 0 ? std::string(std::strerror(errno)) : "done";
  });
}

TEST_F(SystemCalls, EndProgramsThatMeanHarm) {
  char* const none[] = {nullptr};
  const std::map<std::string, std::function<long()>> attempts = {
      {"execve", [&] { return ::syscall(SYS_execve, "/bin/true", none, none); }},
      {"fork", [] { return ::syscall(SYS_clone, SIGCHLD, 0, 0, 0, 0); }},
      {"ptrace", [] { return ::syscall(SYS_ptrace, 0, 0, 0, 0); }},
      {"unshare", [] { return ::unshare(CLONE_NEWUSER); }},
      {"userfaultfd", [] { return ::syscall(SYS_userfaultfd, 0); }},
      {"bpf", [] { return ::syscall(SYS_bpf, 0, nullptr, 0); }}};
  for (const auto& [name, attempt] : attempts) {
    const IsolatedResult result = behindFilter(attempt);
    EXPECT_EQ(result.end, IsolatedEnd::kCrashed) << name;
    EXPECT_EQ(result.signal, SIGSYS) << name;
  }
}

TEST_F(SystemCalls, RefuseWaysToTalkAndToHide) {
  char* const none[] = {nullptr};
  const std::map<std::string, std::function<long()>> attempts = {
      {"socket", [] { return ::syscall(SYS_socket, 1, 1, 0); }},
      {"io_uring", [] { return ::syscall(SYS_io_uring_setup, 1, nullptr); }},
      {"memfd", [] { return ::syscall(SYS_memfd_create, "a", 0); }},
      {"inotify", [] { return ::syscall(SYS_inotify_init1, 0); }},
      {"mincore", [] { return ::syscall(SYS_mincore, nullptr, 0, nullptr); }},
      {"seccomp", [] { return ::syscall(SYS_seccomp, 2, 0, nullptr); }},
      {"owner of a terminal", [] { return ::syscall(SYS_ioctl, 0, 0x8901, nullptr); }},
      {"clone3", [] { return ::syscall(SYS_clone3, nullptr, 0); }},
      {"thread that suspends",
       [] {
         return ::syscall(SYS_clone, CLONE_VM | CLONE_SIGHAND | CLONE_THREAD | CLONE_VFORK, 0, 0, 0, 0);
       }},
      {"execveat", [&] { return ::syscall(SYS_execveat, -1, "/bin/true", none, none, 0); }}};
  for (const auto& [name, attempt] : attempts)
    EXPECT_THAT(behindFilter(attempt).bytes,
                ::testing::AnyOf("Operation not permitted", "Function not implemented"))
        << name;
}

// Only by the very pointers that the filter was told.
TEST_F(SystemCalls, StartTheProgramAndNoOther) {
  const auto become = [](bool sameWords, int program) {
    return callIsolated([&] {
      const int fd = ::open("/bin/true", O_PATH);
      const ProgramStart start{fd, hiddenWord(""), hiddenWords({"true"}), hiddenWords({})};
      filterSystemCalls({.level = Level{2}}, start);
      ::execveat(program < 0 ? program : fd, sameWords ? start.path : "", start.arguments, start.environment,
                 AT_EMPTY_PATH);
      return std::string(std::strerror(errno));
    });
  };
  EXPECT_EQ(become(true, 0).exitCode, 0);
  EXPECT_EQ(become(false, 0).bytes, "Function not implemented");
  EXPECT_EQ(become(true, -2).bytes, "Function not implemented");
  EXPECT_NE(hiddenWord("a"), hiddenWord("a"));
  EXPECT_STREQ(hiddenWords({"a", "bc"})[1], "bc");
}

// What compilers do, and what honest programs do.
TEST_F(SystemCalls, LetToolsAndThreadsStart) {
  const IsolatedResult tool = callIsolated([] {
    filterSystemCalls({.level = Level{2}, .mayStartProgramsOfItsOwn = true});
    return runProcess({"sh", "-c", "echo $(echo runs | cat)"}).output;
  });
  EXPECT_EQ(tool.bytes, "runs\n");
  EXPECT_EQ(behindFilter([] { return ::unshare(CLONE_NEWNET); }, true).signal, SIGSYS);
  const std::string file = temporary_.path() / "written";
  const IsolatedResult honest = callIsolated([&] {
    filterSystemCalls({.level = Level{2}});
    std::string text;
    std::thread([&] { text = "threads "; }).join();
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    std::ofstream(file) << text;
    std::filesystem::rename(file, file + "2");
    std::filesystem::copy_file(file + "2", file);
    std::ifstream(file) >> text;
    return text + (std::filesystem::exists(file) ? " files" : "");
  });
  EXPECT_EQ(honest.bytes, "threads files");
}

}  // namespace rex::sandbox::system_calls_test
