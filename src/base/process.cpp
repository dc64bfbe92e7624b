#include "base/process.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <optional>

#include <fcntl.h>
#include <poll.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/child.h"
#include "base/child_internal.h"
#include "base/error.h"
#include "base/interruption.h"

namespace rex {
namespace {

using Clock = std::chrono::steady_clock;

bool applyLimits(const ProcessOptions& options) {
  const std::size_t space = options.addressSpace, file = options.fileSize;
  return (options.cpuSeconds == 0 || lowerCpuSeconds(options.cpuSeconds)) &&
         (space == 0 || lowerLimit(RLIMIT_AS, space, space)) &&
         (file == 0 || lowerLimit(RLIMIT_FSIZE, file, file));
}

// Between fork and exec only async-signal-safe calls are allowed: everything is prepared before.
[[noreturn]] void execProgram(char* const* argv, const char* directory, const ProcessOptions& options,
                              const int (&standard)[3], int statusFd) {
  sigset_t none;
  ::sigemptyset(&none);
  ::sigprocmask(SIG_SETMASK, &none, nullptr);
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

// Our environment with some variables added or replaced.
std::vector<char*> environmentWith(const std::vector<std::string>& more) {
  std::vector<char*> all;
  for (const std::string& variable : more) all.push_back(const_cast<char*>(variable.c_str()));
  for (char** old = ::environ; *old != nullptr; ++old) {
    const std::string_view name = std::string_view(*old).substr(0, std::string_view(*old).find('=') + 1);
    if (std::none_of(more.begin(), more.end(), [&](const auto& one) { return one.starts_with(name); }))
      all.push_back(*old);
  }
  all.push_back(nullptr);
  return all;
}

void append(std::string& kept, const char* data, std::size_t size, std::size_t limit) {
  kept.append(data, std::min(size, limit - std::min(limit, kept.size())));
}

}  // namespace

// A running program and our ends of its pipes.
struct ChildProcess::Running {
  pid_t child = -1;
  bool ownGroup = true;
  std::size_t outputLimit = 0;
  Pipe in{}, out{}, err{};
  StopRequests stop{};
  std::atomic<bool> cancelled = false;
  int interruptedBy = 0;            ///< the signal that asked us to stop
  std::optional<ChildEnd> ended{};  ///< once it has been reaped
  ProcessResult result{};

  bool mustStop();
  bool exchange(std::string_view& input, Deadline deadline);
  void collect(const pollfd& polled, Pipe& pipe, std::string& kept) const;
  bool waitForEnd(Deadline deadline);
  void end();
  void giveUp();
};

// Looks for a request to stop. A program that shares our terminal gets it too and decides for itself.
bool ChildProcess::Running::mustStop() {
  if (cancelled) return true;
  const int signal = stop.take();
  if (signal == 0) return false;
  if (ownGroup) {
    interruptedBy = signal;
    return true;
  }
  if (signal != SIGINT) ::kill(child, signal);  // Ctrl-C has reached it
  return false;
}

void ChildProcess::Running::collect(const pollfd& polled, Pipe& pipe, std::string& kept) const {
  if (polled.revents == 0) return;
  std::array<char, 65536> buffer;
  const ssize_t n = ::read(polled.fd, buffer.data(), buffer.size());
  if (n > 0) append(kept, buffer.data(), static_cast<std::size_t>(n), outputLimit);
  if (n == 0) pipe.closeRead();
}

// One round: writes what fits from the front of `input` and collects output. Returns false at the deadline or
// when asked to stop.
bool ChildProcess::Running::exchange(std::string_view& input, Deadline deadline) {
  constexpr long kLongestSleep = 100;  // milliseconds, until we check whether we are cancelled
  const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(deadline - Clock::now()).count();
  if (left <= 0 || mustStop()) return false;
  std::array<pollfd, 4> polled{{{out.readEnd(), POLLIN, 0},
                                {err.readEnd(), POLLIN, 0},
                                {in.writeEnd(), POLLOUT, 0},
                                {stop.fd(), POLLIN, 0}}};
  const int timeout = static_cast<int>(std::min<long>(left, kLongestSleep));
  if (::poll(polled.data(), polled.size(), timeout) < 0) return errno == EINTR;
  collect(polled[0], out, result.output);
  collect(polled[1], err, result.error);
  if (polled[2].revents == 0) return true;
  const ssize_t n = ::write(in.writeEnd(), input.data(), input.size());
  if (n >= 0) input.remove_prefix(static_cast<std::size_t>(n));
  if (n < 0 && errno != EAGAIN && errno != EINTR) in.closeWrite();
  return true;
}

// Waits for the child's end; returns false at the deadline or when asked to stop.
bool ChildProcess::Running::waitForEnd(Deadline deadline) {
  for (int pause = 0;; pause = std::min(pause + 1, 10)) {  // milliseconds
    ended = waitForChild(child, WNOHANG);
    if (ended) return true;
    if (Clock::now() >= deadline || mustStop()) return false;
    pollfd polled{stop.fd(), POLLIN, 0};
    ::poll(&polled, 1, pause);
  }
}

// Passes on a request to stop, so that the program can tidy up, and kills what is left after a second.
void ChildProcess::Running::end() {
  const int target = ownGroup ? -child : child;
  if (interruptedBy != 0) {
    ::kill(target, interruptedBy);
    for (int k = 0; k < 100; ++k) {
      siginfo_t info{};
      ::waitid(P_PID, static_cast<id_t>(child), &info, WEXITED | WNOHANG | WNOWAIT);
      if (info.si_pid == child) break;
      ::poll(nullptr, 0, 10);
    }
  }
  // Until the child is reaped, no other process can get its ID.
  ::kill(target, SIGKILL);
  ended = waitForChild(child);
}

void ChildProcess::Running::giveUp() {
  result.timedOut = interruptedBy == 0;
  in.closeWrite();
  end();
  if (interruptedBy != 0) throw Interrupted{interruptedBy};
}

ChildProcess::Deadline ChildProcess::after(double seconds) {
  return Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
}

ChildProcess::ChildProcess(const std::vector<std::string>& argv, const ProcessOptions& options) {
  if (argv.empty()) throw Error({.what = "no program to run"});
  std::vector<char*> arguments;
  for (const std::string& argument : argv) arguments.push_back(const_cast<char*>(argument.c_str()));
  arguments.push_back(nullptr);
  const std::string directory = options.directory.string();
  std::vector<char*> environment = environmentWith(options.environment);

  running_ = std::make_unique<Running>();
  Running& running = *running_;
  Pipe failure;
  // A program that shares our terminal stays in our process group, so that Ctrl-C ends both.
  const bool kept = running.ownGroup = !options.inheritOutput;
  running.outputLimit = options.outputLimit;
  const auto become = [&] {
    ::environ = environment.data();
    const int standard[3] = {running.in.readEnd(), kept ? running.out.writeEnd() : -1,
                             kept ? running.err.writeEnd() : -1};
    execProgram(arguments.data(), directory.c_str(), options, standard, failure.writeEnd());
  };
  running.child = forkChild(argv[0], become, {.ownGroup = kept});
  running.in.closeRead(), running.out.closeWrite(), running.err.closeWrite(), failure.closeWrite();
  ::fcntl(running.in.writeEnd(), F_SETFL, O_NONBLOCK);
  int cause = 0;
  running.result.started = ::read(failure.readEnd(), &cause, sizeof cause) != sizeof cause;
  if (!running.result.started) running.result.error = std::strerror(cause);
}

ChildProcess::~ChildProcess() {
  if (running_->child > 0 && !running_->ended) running_->end();
}

bool ChildProcess::write(std::string_view bytes, Deadline deadline) {
  const SigpipeIgnored guard;
  Running& running = *running_;
  while (!bytes.empty() && running.in.writeEnd() >= 0) {
    if (!running.exchange(bytes, deadline)) running.giveUp();
  }
  return running.in.writeEnd() >= 0;
}

ProcessResult ChildProcess::finish(Deadline deadline) {
  auto& running = *running_;
  ProcessResult& result = running.result;
  running.in.closeWrite();
  const auto talks = [&] { return running.out.readEnd() >= 0 || running.err.readEnd() >= 0; };
  std::string_view nothing;
  while (!running.ended && talks()) {
    if (!running.exchange(nothing, deadline)) running.giveUp();
  }
  if (!running.ended && !running.waitForEnd(deadline)) running.giveUp();
  if (!running.ownGroup) static_cast<void>(running.stop.take());  // Ctrl-C was for the program
  result.cpuSeconds = running.ended->cpuSeconds;
  if (result.started) result.exitCode = running.ended->exitCode();
  result.signal = running.ended->signal();
  return result;
}

void ChildProcess::cancel() { running_->cancelled = true; }

ProcessResult runProcess(const std::vector<std::string>& argv, const ProcessOptions& options) {
  const ChildProcess::Deadline deadline = ChildProcess::after(options.timeout);
  ChildProcess child(argv, options);
  // A program need not read all of its input.
  static_cast<void>(child.write(options.input, deadline));
  return child.finish(deadline);
}

}  // namespace rex
