#include "base/process.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstring>

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/signalfd.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/error.h"
#include "base/interruption.h"
#include "base/pipe.h"

namespace rex {
namespace {

using Clock = std::chrono::steady_clock;

// Takes the requests to stop that somebody holds back; without one, nothing ever arrives.
class StopRequests {
 public:
  StopRequests() {
    const sigset_t wanted = stopSignals();
    sigset_t held, both;
    ::sigprocmask(SIG_BLOCK, nullptr, &held);
    ::sigandset(&both, &wanted, &held);
    fd_ = ::signalfd(-1, &both, SFD_CLOEXEC | SFD_NONBLOCK);
  }
  ~StopRequests() {
    if (fd_ >= 0) ::close(fd_);
  }
  StopRequests(const StopRequests&) = delete;
  StopRequests& operator=(const StopRequests&) = delete;

  int fd() const { return fd_; }
  /// The signal that arrived, or 0.
  int take() const {
    signalfd_siginfo info{};
    return ::read(fd_, &info, sizeof info) == sizeof info ? static_cast<int>(info.ssi_signo) : 0;
  }

 private:
  int fd_ = -1;
};

bool limit(int resource, rlim_t soft, rlim_t hard) {
  if (soft == 0) return true;
  const rlimit value{soft, hard};
  return ::setrlimit(static_cast<__rlimit_resource>(resource), &value) == 0;
}

// The soft limit on time sends a signal that a program can ignore; the hard one kills.
bool applyLimits(const ProcessOptions& options) {
  const auto seconds = static_cast<rlim_t>(std::ceil(options.cpuSeconds));
  return limit(RLIMIT_CPU, seconds, seconds + 1) &&
         limit(RLIMIT_AS, options.addressSpace, options.addressSpace) &&
         limit(RLIMIT_FSIZE, options.fileSize, options.fileSize);
}

// Between fork and exec only async-signal-safe calls are allowed: everything is prepared before.
[[noreturn]] void becomeProgram(char* const* argv, const char* directory, const ProcessOptions& options,
                                const int (&standard)[3], pid_t parent, int statusFd) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);  // no program outlives us
  if (::getppid() != parent) ::_exit(127);
  sigset_t none;
  ::sigemptyset(&none);
  ::sigprocmask(SIG_SETMASK, &none, nullptr);
  // A program that shares our terminal stays in our process group, so that Ctrl-C ends both.
  if (!options.inheritOutput) ::setpgid(0, 0);
  for (int fd = 0; fd < 3; ++fd) {
    if (standard[fd] >= 0) ::dup2(standard[fd], fd);
  }
  if (applyLimits(options) && (*directory == '\0' || ::chdir(directory) == 0)) {
    ::signal(SIGPIPE, SIG_DFL);
    ::execvp(argv[0], argv);
  }
  const int cause = errno;
  static_cast<void>(!::write(statusFd, &cause, sizeof cause));
  ::_exit(127);
}

void append(std::string& kept, const char* data, std::size_t size, std::size_t limit) {
  kept.append(data, std::min(size, limit - std::min(limit, kept.size())));
}

// A running program and our ends of its pipes.
struct Running {
  pid_t child = -1;
  bool ownGroup = true;
  Clock::time_point deadline{};
  Pipe in{}, out{}, err{};
  StopRequests stop{};
  int interruptedBy = 0;  ///< the signal that asked us to stop
};

// Looks for a request to stop. A program that shares our terminal gets it too and decides for itself.
bool mustStop(Running& running) {
  const int signal = running.stop.take();
  if (signal == 0) return false;
  if (running.ownGroup) {
    running.interruptedBy = signal;
    return true;
  }
  if (signal != SIGINT) ::kill(running.child, signal);  // Ctrl-C has reached it
  return false;
}

// Feeds input and collects output until both outputs are closed. Returns false at the deadline and when asked
// to stop.
bool exchange(Running& running, const ProcessOptions& options, ProcessResult& result) {
  auto& [child, ownGroup, deadline, in, out, err, stop, interruptedBy] = running;
  std::size_t fed = 0;
  ::fcntl(in.writeEnd(), F_SETFL, O_NONBLOCK);
  if (options.input.empty()) in.closeWrite();
  while (out.readEnd() >= 0 || err.readEnd() >= 0) {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(deadline - Clock::now()).count();
    if (left <= 0 || mustStop(running)) return false;
    std::array<pollfd, 4> polled{{{out.readEnd(), POLLIN, 0},
                                  {err.readEnd(), POLLIN, 0},
                                  {in.writeEnd(), POLLOUT, 0},
                                  {stop.fd(), POLLIN, 0}}};
    if (::poll(polled.data(), polled.size(), static_cast<int>(std::min<long>(left, 1000))) < 0 &&
        errno != EINTR)
      return false;
    std::array<char, 65536> buffer;
    for (int k = 0; k < 2; ++k) {
      if (polled[k].revents == 0) continue;
      const ssize_t n = ::read(polled[k].fd, buffer.data(), buffer.size());
      if (n > 0)
        append(k == 0 ? result.output : result.error, buffer.data(), static_cast<std::size_t>(n),
               options.outputLimit);
      if (n == 0) k == 0 ? out.closeRead() : err.closeRead();
    }
    if (polled[2].revents != 0) {
      const ssize_t n = ::write(in.writeEnd(), options.input.data() + fed, options.input.size() - fed);
      if (n > 0) fed += static_cast<std::size_t>(n);
      if ((n < 0 && errno != EAGAIN && errno != EINTR) || fed == options.input.size()) in.closeWrite();
    }
  }
  return true;
}

double secondsOf(const rusage& usage) {
  const auto seconds = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

// Waits for the child's end; returns false at the deadline and when asked to stop.
bool waitForEnd(Running& running, int& status, rusage& usage) {
  int pause = 0;  // milliseconds
  for (;;) {
    const pid_t got = ::wait4(running.child, &status, WNOHANG, &usage);
    if (got == running.child) return true;
    if (Clock::now() >= running.deadline || mustStop(running)) return false;
    pollfd polled{running.stop.fd(), POLLIN, 0};
    ::poll(&polled, 1, pause);
    pause = std::min(pause + 1, 10);
  }
}

// Passes a request to stop on, so that the program can tidy up, and kills what is left after a second.
int end(Running& running, rusage& usage) {
  int status = 0;
  const int target = running.ownGroup ? -running.child : running.child;
  if (running.interruptedBy != 0) {
    ::kill(target, running.interruptedBy);
    for (int k = 0; k < 100; ++k) {
      siginfo_t ended{};
      ::waitid(P_PID, static_cast<id_t>(running.child), &ended, WEXITED | WNOHANG | WNOWAIT);
      if (ended.si_pid == running.child) break;
      ::poll(nullptr, 0, 10);
    }
  }
  // While the child is not yet reaped, nobody else can get its number.
  ::kill(target, SIGKILL);
  ::wait4(running.child, &status, 0, &usage);
  return status;
}

}  // namespace

ProcessResult runProcess(const std::vector<std::string>& argv, const ProcessOptions& options) {
  if (argv.empty()) throw Error({.what = "no program to run"});
  std::vector<char*> arguments;
  for (const std::string& argument : argv) arguments.push_back(const_cast<char*>(argument.c_str()));
  arguments.push_back(nullptr);
  const std::string directory = options.directory.string();

  const SigpipeIgnored guard;
  Pipe status;
  Running running{.ownGroup = !options.inheritOutput};
  auto& [child, ownGroup, deadline, in, out, err, stop, interruptedBy] = running;
  deadline = Clock::now() +
             std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(options.timeout));
  const pid_t parent = ::getpid();
  child = ::fork();
  if (child < 0) throw Error({.what = "cannot start " + argv[0], .found = std::strerror(errno)});
  if (child == 0) {
    const int outputs[3] = {in.readEnd(), ownGroup ? out.writeEnd() : -1, ownGroup ? err.writeEnd() : -1};
    becomeProgram(arguments.data(), directory.c_str(), options, outputs, parent, status.writeEnd());
  }
  if (ownGroup) ::setpgid(child, child);
  in.closeRead(), out.closeWrite(), err.closeWrite(), status.closeWrite();

  ProcessResult result;
  int cause = 0;
  result.started = ::read(status.readEnd(), &cause, sizeof cause) != sizeof cause;
  if (!result.started) result.error = std::strerror(cause);
  int ended = 0;
  rusage usage{};
  if (!exchange(running, options, result) || !waitForEnd(running, ended, usage)) {
    result.timedOut = interruptedBy == 0;
    ended = end(running, usage);
  }
  result.cpuSeconds = secondsOf(usage);
  if (!ownGroup) static_cast<void>(stop.take());  // Ctrl-C was for the program
  if (interruptedBy != 0) throw Interrupted{interruptedBy};
  if (WIFEXITED(ended) && result.started) result.exitCode = WEXITSTATUS(ended);
  if (WIFSIGNALED(ended)) result.signal = WTERMSIG(ended);
  return result;
}

}  // namespace rex
