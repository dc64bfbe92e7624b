#include "base/child.h"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstring>
#include <utility>

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/signalfd.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/child_internal.h"
#include "base/error.h"
#include "base/interruption.h"

namespace rex {

StopRequests::StopRequests() {
  const sigset_t wanted = stopSignals();
  sigset_t held, both;
  ::sigprocmask(SIG_BLOCK, nullptr, &held);
  ::sigandset(&both, &wanted, &held);
  fd_ = ::signalfd(-1, &both, SFD_CLOEXEC | SFD_NONBLOCK);
}

StopRequests::~StopRequests() {
  if (fd_ >= 0) ::close(fd_);
}

int StopRequests::take() const {
  signalfd_siginfo info{};
  return ::read(fd_, &info, sizeof info) == sizeof info ? static_cast<int>(info.ssi_signo) : 0;
}

Pipe::Pipe() {
  constexpr int kLowest = 10;
  std::array<int, 2> low{-1, -1};
  bool made = ::pipe2(low.data(), O_CLOEXEC) == 0;
  for (int k = 0; k < 2 && made; ++k) {
    ends_[k] = ::fcntl(low[k], F_DUPFD_CLOEXEC, kLowest);
    made = ends_[k] >= 0;
  }
  const int cause = errno;
  for (int& fd : low) close(fd);
  if (made) return;
  closeRead(), closeWrite();
  throw Error({.what = "cannot make a pipe", .found = std::strerror(cause)});
}

Pipe::~Pipe() { closeRead(), closeWrite(); }

int Pipe::releaseRead() { return std::exchange(ends_[0], -1); }
int Pipe::releaseWrite() { return std::exchange(ends_[1], -1); }

void Pipe::close(int& fd) {
  if (fd >= 0) ::close(fd);
  fd = -1;
}

namespace {

sigset_t sigpipe() {
  sigset_t signals;
  ::sigemptyset(&signals);
  ::sigaddset(&signals, SIGPIPE);
  return signals;
}

}  // namespace

// The signal goes to the thread that writes, so blocking it there is enough and disturbs no other thread.
SigpipeIgnored::SigpipeIgnored() {
  const sigset_t signals = sigpipe();
  ::pthread_sigmask(SIG_BLOCK, &signals, &before_);
}

SigpipeIgnored::~SigpipeIgnored() {
  const sigset_t signals = sigpipe();
  const timespec now{};
  if (::sigismember(&before_, SIGPIPE) == 0) ::sigtimedwait(&signals, nullptr, &now);
  ::pthread_sigmask(SIG_SETMASK, &before_, nullptr);
}

int ChildEnd::exitCode() const { return WIFEXITED(status) ? WEXITSTATUS(status) : -1; }
int ChildEnd::signal() const { return WIFSIGNALED(status) ? WTERMSIG(status) : 0; }

int forkChild(const std::string& name, const std::function<void()>& body, const ChildOptions& options) {
  const pid_t parent = ::getpid(), child = options.sharesMemory ? ::vfork() : ::fork();
  if (child < 0) throw Error({.what = "cannot start " + name, .found = std::strerror(errno)});
  if (child > 0) {
    if (options.ownGroup) ::setpgid(child, child);  // here, too: we may need the group before the child runs
    return child;
  }
  if (options.ownGroup) ::setpgid(0, 0);
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() == parent) body();
  ::_exit(127);
}

std::optional<ChildEnd> waitForChild(int child, int flags) {
  ChildEnd end;
  rusage usage{};
  pid_t ended = 0;
  do ended = ::wait4(child, &end.status, flags, &usage);
  while (ended < 0 && errno == EINTR);
  if (ended != child && (flags & WNOHANG) != 0) return std::nullopt;
  for (const timeval& time : {usage.ru_utime, usage.ru_stime})
    end.cpuSeconds += static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  end.peakKilobytes = usage.ru_maxrss;
  return end;
}

bool lowerLimit(int resource, unsigned long soft, unsigned long hard) {
  const auto which = static_cast<__rlimit_resource>(resource);
  rlimit present{};
  if (::getrlimit(which, &present) != 0) return false;
  const rlimit wanted{std::min(soft, present.rlim_max), std::min(hard, present.rlim_max)};
  return ::setrlimit(which, &wanted) == 0;
}

bool lowerCpuSeconds(double seconds) {
  const auto whole = static_cast<rlim_t>(std::ceil(seconds));
  return lowerLimit(RLIMIT_CPU, whole, whole + 1);
}

void resetSignalHandlers() {
  for (int signal = 1; signal < NSIG; ++signal) {
    struct sigaction action {};
    if (::sigaction(signal, nullptr, &action) == 0 && action.sa_handler != SIG_IGN) ::signal(signal, SIG_DFL);
  }
}

SignalsBlocked::SignalsBlocked() {
  sigset_t all;
  ::sigfillset(&all);
  ::pthread_sigmask(SIG_SETMASK, &all, &before_);
}

SignalsBlocked::~SignalsBlocked() { ::pthread_sigmask(SIG_SETMASK, &before_, nullptr); }

}  // namespace rex
