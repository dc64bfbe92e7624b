#include "base/child.h"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>

#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/error.h"

namespace rex {

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
