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
#include <sys/wait.h>
#include <unistd.h>

#include "base/error.h"

namespace rex {
namespace {

using Clock = std::chrono::steady_clock;

class Pipe {
 public:
  Pipe() {
    if (::pipe2(ends_.data(), O_CLOEXEC) != 0)
      throw Error({.what = "cannot make a pipe", .found = std::strerror(errno)});
  }
  ~Pipe() { closeRead(), closeWrite(); }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;
  int readEnd() const { return ends_[0]; }
  int writeEnd() const { return ends_[1]; }
  void closeRead() { close(ends_[0]); }
  void closeWrite() { close(ends_[1]); }

 private:
  static void close(int& fd) {
    if (fd >= 0) ::close(fd);
    fd = -1;
  }
  std::array<int, 2> ends_{-1, -1};
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
                                const int (&standard)[3], int statusFd) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);  // no program outlives us
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

// Feeds input and collects output until both outputs are closed or the deadline passes.
// Returns false at the deadline.
bool exchange(Pipe& in, Pipe& out, Pipe& err, const ProcessOptions& options, Clock::time_point deadline,
              ProcessResult& result) {
  std::size_t fed = 0;
  ::fcntl(in.writeEnd(), F_SETFL, O_NONBLOCK);
  if (options.input.empty()) in.closeWrite();
  while (out.readEnd() >= 0 || err.readEnd() >= 0) {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(deadline - Clock::now()).count();
    if (left <= 0) return false;
    std::array<pollfd, 3> polled{
        {{out.readEnd(), POLLIN, 0}, {err.readEnd(), POLLIN, 0}, {in.writeEnd(), POLLOUT, 0}}};
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

// Waits for the child until the deadline; returns false if it still runs then.
bool waitUntil(pid_t child, Clock::time_point deadline, int& status) {
  timespec pause{0, 200'000};
  for (;;) {
    const pid_t got = ::waitpid(child, &status, WNOHANG);
    if (got == child) return true;
    if (Clock::now() >= deadline) return false;
    ::nanosleep(&pause, nullptr);
    pause.tv_nsec = std::min(pause.tv_nsec * 2, 10'000'000L);
  }
}

// Writing to a program that has gone must be an error code, not a signal that ends us.
class IgnoreSigpipe {
 public:
  IgnoreSigpipe() { previous_ = ::signal(SIGPIPE, SIG_IGN); }
  ~IgnoreSigpipe() { ::signal(SIGPIPE, previous_); }
  IgnoreSigpipe(const IgnoreSigpipe&) = delete;
  IgnoreSigpipe& operator=(const IgnoreSigpipe&) = delete;

 private:
  void (*previous_)(int);
};

}  // namespace

ProcessResult runProcess(const std::vector<std::string>& argv, const ProcessOptions& options) {
  if (argv.empty()) throw Error({.what = "no program to run"});
  std::vector<char*> arguments;
  for (const std::string& argument : argv) arguments.push_back(const_cast<char*>(argument.c_str()));
  arguments.push_back(nullptr);
  const std::string directory = options.directory.string();

  const IgnoreSigpipe guard;
  Pipe in, out, err, status;
  const auto deadline = Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                           std::chrono::duration<double>(options.timeout));
  const pid_t child = ::fork();
  if (child < 0) throw Error({.what = "cannot start " + argv[0], .found = std::strerror(errno)});
  if (child == 0) {
    const int outputs[3] = {in.readEnd(), options.inheritOutput ? -1 : out.writeEnd(),
                            options.inheritOutput ? -1 : err.writeEnd()};
    becomeProgram(arguments.data(), directory.c_str(), options, outputs, status.writeEnd());
  }
  if (!options.inheritOutput) ::setpgid(child, child);
  in.closeRead(), out.closeWrite(), err.closeWrite(), status.closeWrite();

  ProcessResult result;
  int cause = 0;
  result.started = ::read(status.readEnd(), &cause, sizeof cause) != sizeof cause;
  if (!result.started) result.error = std::strerror(cause);
  int ended = 0;
  const bool finished =
      exchange(in, out, err, options, deadline, result) && waitUntil(child, deadline, ended);
  if (!finished) {
    result.timedOut = true;
    ::kill(options.inheritOutput ? child : -child, SIGKILL);
    ::waitpid(child, &ended, 0);
  }
  if (WIFEXITED(ended) && result.started) result.exitCode = WEXITSTATUS(ended);
  if (WIFSIGNALED(ended)) result.signal = WTERMSIG(ended);
  return result;
}

}  // namespace rex
