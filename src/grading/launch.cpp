#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <optional>
#include <string>

#include <fcntl.h>
#include <linux/close_range.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/error.h"
#include "base/pipe.h"
#include "grading/launch_internal.h"
#include "remote/worker.h"
#include "sandbox/confinement.h"
#include "sandbox/leave_others.h"

namespace rex::grading {
namespace {

#ifdef __SANITIZE_ADDRESS__
constexpr bool kLimitMemory = false;
// Crashes keep their signals, findings abort, and memory that a killed worker leaves behind is not a leak.
constexpr std::array<const char*, 3> kEnvironment = {
    "ASAN_OPTIONS=handle_segv=0:handle_sigbus=0:handle_sigfpe=0:handle_sigill=0:abort_on_error=1:detect_"
    "leaks=0",
    "UBSAN_OPTIONS=abort_on_error=1", nullptr};
#else
constexpr bool kLimitMemory = true;
constexpr std::array<const char*, 1> kEnvironment = {nullptr};
#endif

constexpr rlim_t kFileBytes = 64u << 20;
constexpr rlim_t kOpenFiles = 64;
// Away from the numbers that the worker's own descriptors get, as the ends of a Pipe are.
constexpr int kAboveFixed = 10;

int notBlocking(int fd) {
  ::fcntl(fd, F_SETFL, O_NONBLOCK);
  return fd;
}

void setLimit(__rlimit_resource resource, rlim_t soft, rlim_t hard) {
  const rlimit limit{soft, hard};
  ::setrlimit(resource, &limit);
}

void setLimits(const Limits& limits) {
  const auto cpu = static_cast<rlim_t>(limits.cpuBudget());
  setLimit(RLIMIT_CPU, cpu, cpu + 1);
  setLimit(RLIMIT_FSIZE, kFileBytes, kFileBytes);
  setLimit(RLIMIT_NOFILE, kOpenFiles, kOpenFiles);
  setLimit(RLIMIT_CORE, 0, 0);
  if (kLimitMemory && !limits.sanitized) setLimit(RLIMIT_AS, limits.memory, limits.memory);
}

// What the new process needs, prepared before it starts: until execve it uses our memory, and only
// async-signal-safe calls are allowed.
struct Prepared {
  const LaunchOrder& order;
  std::vector<char*> arguments{};
  std::vector<int> fds{};  ///< become descriptors 0, 1, 2, ...
  int status = -1;
  pid_t parent = ::getpid();
};

// Blocks all signals while it lives.
class SignalsBlocked {
 public:
  SignalsBlocked() {
    sigset_t all;
    ::sigfillset(&all);
    ::pthread_sigmask(SIG_SETMASK, &all, &before_);
  }
  ~SignalsBlocked() { ::pthread_sigmask(SIG_SETMASK, &before_, nullptr); }
  SignalsBlocked(const SignalsBlocked&) = delete;
  SignalsBlocked& operator=(const SignalsBlocked&) = delete;

 private:
  sigset_t before_;
};

// Our handlers must not run in the new process, which would change our memory.
void forgetHandlers() {
  for (int signal = 1; signal < NSIG; ++signal) {
    struct sigaction action;
    if (::sigaction(signal, nullptr, &action) == 0 && action.sa_handler != SIG_IGN) ::signal(signal, SIG_DFL);
  }
}

[[noreturn]] void becomeWorker(const Prepared& prepared) {
  ::setpgid(0, 0);
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != prepared.parent) ::_exit(1);
  const int count = static_cast<int>(prepared.fds.size());
  for (int k = 0; k < count; ++k) ::dup2(prepared.fds[static_cast<std::size_t>(k)], k);
  ::close_range(static_cast<unsigned>(count), ~0u, CLOSE_RANGE_CLOEXEC);
  forgetHandlers();
  ::signal(SIGPIPE, SIG_DFL);
  sigset_t none;
  ::sigemptyset(&none);
  ::sigprocmask(SIG_SETMASK, &none, nullptr);
  const LaunchOrder& order = prepared.order;
  if (::chdir(order.folder.c_str()) == 0) {
    if (!sandbox::isConfined(order.level)) {
      setLimits(order.limits);
      sandbox::leaveOthersAlone();
    }
    ::execve(order.command.front().c_str(), prepared.arguments.data(),
             const_cast<char* const*>(kEnvironment.data()));
  }
  const int cause = errno;
  static_cast<void>(!::write(prepared.status, &cause, sizeof cause));
  ::_exit(1);
}

std::vector<char*> argumentsOf(const LaunchOrder& order) {
  static const std::string kName = "worker";
  std::vector<char*> arguments;
  for (const std::string& word : order.command) arguments.push_back(const_cast<char*>(word.c_str()));
  if (arguments.size() == 1) arguments[0] = const_cast<char*>(kName.c_str());
  arguments.push_back(nullptr);
  return arguments;
}

}  // namespace

Launched launchWorker(const LaunchOrder& order) {
  static_assert(remote::kWorkerIn == 3 && remote::kWorkerOut == 4 && sandbox::kReport == 5);
  Pipe in, out, output, error, status;
  std::optional<Pipe> report;
  const int nothing = ::open("/dev/null", O_RDONLY | O_CLOEXEC);
  const int nothingHigh = ::fcntl(nothing, F_DUPFD_CLOEXEC, kAboveFixed);
  ::close(nothing);
  Prepared prepared{.order = order,
                    .arguments = argumentsOf(order),
                    .fds = {nothingHigh, output.writeEnd(), error.writeEnd(), in.readEnd(), out.writeEnd()},
                    .status = status.writeEnd()};
  if (sandbox::isConfined(order.level)) prepared.fds.push_back(report.emplace().writeEnd());
  pid_t child = -1;
  {
    // A grader holds much memory, and a copy of its page tables would cost more than all else here.
    const SignalsBlocked guard;
    child = ::vfork();
    if (child == 0) becomeWorker(prepared);
  }
  ::close(nothingHigh);
  if (child < 0) throw Error({.what = "cannot start the worker", .found = std::strerror(errno)});
  ::setpgid(child, child);
  status.closeWrite();
  int cause = 0;
  if (::read(status.readEnd(), &cause, sizeof cause) == sizeof cause) {
    ::waitpid(child, nullptr, 0);
    throw Error({.what = "cannot start the worker " + order.name, .found = std::strerror(cause)});
  }
  return {.process = child,
          .processFd = static_cast<int>(::syscall(SYS_pidfd_open, child, 0)),
          .toWorker = notBlocking(in.releaseWrite()),
          .fromWorker = notBlocking(out.releaseRead()),
          .output = notBlocking(output.releaseRead()),
          .error = notBlocking(error.releaseRead()),
          .report = report ? notBlocking(report->releaseRead()) : -1};
}

}  // namespace rex::grading
