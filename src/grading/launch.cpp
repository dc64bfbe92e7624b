#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
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

namespace rex::grading {
namespace {

#ifdef __SANITIZE_ADDRESS__
constexpr bool kLimitMemory = false;
// Crashes keep their signals, findings abort, and what a killed worker leaves behind is no leak.
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

void setLimits(const WorkerLimits& limits) {
  const auto cpu = static_cast<rlim_t>(limits.cpuBudget());
  setLimit(RLIMIT_CPU, cpu, cpu + 1);
  setLimit(RLIMIT_FSIZE, kFileBytes, kFileBytes);
  setLimit(RLIMIT_NOFILE, kOpenFiles, kOpenFiles);
  setLimit(RLIMIT_CORE, 0, 0);
  const rlim_t memory = static_cast<rlim_t>(limits.memoryMegabytes) << 20;
  if (kLimitMemory) setLimit(RLIMIT_AS, memory, memory);
}

// Between fork and exec only async-signal-safe calls are allowed: everything is prepared before.
[[noreturn]] void becomeWorker(const char* program, const char* folder, const WorkerLimits& limits,
                               pid_t parent, const std::array<int, 5>& fds, int status) {
  ::setpgid(0, 0);
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(1);
  for (int k = 0; k < static_cast<int>(fds.size()); ++k) ::dup2(fds[k], k);
  ::close_range(static_cast<unsigned>(fds.size()), ~0u, CLOSE_RANGE_CLOEXEC);
  sigset_t none;
  ::sigemptyset(&none);
  ::sigprocmask(SIG_SETMASK, &none, nullptr);
  ::signal(SIGPIPE, SIG_DFL);
  if (::chdir(folder) == 0) {
    setLimits(limits);
    const std::array<char*, 2> arguments = {const_cast<char*>("worker"), nullptr};
    ::execve(program, arguments.data(), const_cast<char* const*>(kEnvironment.data()));
  }
  const int cause = errno;
  static_cast<void>(!::write(status, &cause, sizeof cause));
  ::_exit(1);
}

}  // namespace

Launched launchWorker(const std::filesystem::path& program, const std::filesystem::path& folder,
                      const WorkerLimits& limits) {
  static_assert(remote::kWorkerIn == 3 && remote::kWorkerOut == 4);
  const std::string programPath = std::filesystem::absolute(program).string();
  const std::string folderPath = folder.string();
  Pipe in, out, output, error, status;
  const int nothing = ::open("/dev/null", O_RDONLY | O_CLOEXEC);
  const int nothingHigh = ::fcntl(nothing, F_DUPFD_CLOEXEC, kAboveFixed);
  ::close(nothing);
  const pid_t parent = ::getpid();
  const pid_t child = ::fork();
  if (child == 0)
    becomeWorker(programPath.c_str(), folderPath.c_str(), limits, parent,
                 {nothingHigh, output.writeEnd(), error.writeEnd(), in.readEnd(), out.writeEnd()},
                 status.writeEnd());
  ::close(nothingHigh);
  if (child < 0) throw Error({.what = "cannot start the worker", .found = std::strerror(errno)});
  ::setpgid(child, child);
  status.closeWrite();
  int cause = 0;
  if (::read(status.readEnd(), &cause, sizeof cause) == sizeof cause) {
    ::waitpid(child, nullptr, 0);
    throw Error({.what = "cannot start the worker " + program.string(), .found = std::strerror(cause)});
  }
  return {.process = child,
          .processFd = static_cast<int>(::syscall(SYS_pidfd_open, child, 0)),
          .toWorker = notBlocking(in.releaseWrite()),
          .fromWorker = notBlocking(out.releaseRead()),
          .output = notBlocking(output.releaseRead()),
          .error = notBlocking(error.releaseRead())};
}

}  // namespace rex::grading
