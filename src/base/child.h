#pragma once

#include <array>
#include <csignal>
#include <functional>
#include <optional>
#include <string>

namespace rex {

/// Both ends of a new pipe, closed when it is destroyed and when another program is executed. Their numbers
/// are 10 or more, so that a new process can move them to lower numbers in any order.
class Pipe {
 public:
  /// Throws Error if the system has no descriptors left.
  Pipe();
  ~Pipe();
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;

  /// The descriptors; -1 once closed or released.
  int readEnd() const { return ends_[0]; }
  int writeEnd() const { return ends_[1]; }
  void closeRead() { close(ends_[0]); }
  void closeWrite() { close(ends_[1]); }
  /// Hands an end to the caller, who closes it.
  [[nodiscard]] int releaseRead();
  [[nodiscard]] int releaseWrite();

 private:
  static void close(int& fd);
  std::array<int, 2> ends_{-1, -1};
};

/// During its lifetime, writing to a pipe that nobody reads gives the thread that made it an error code
/// instead of a signal that ends this process.
class SigpipeIgnored {
 public:
  SigpipeIgnored();
  ~SigpipeIgnored();
  SigpipeIgnored(const SigpipeIgnored&) = delete;
  SigpipeIgnored& operator=(const SigpipeIgnored&) = delete;

 private:
  sigset_t before_;
};

}  // namespace rex

// Shared by all code that starts our processes: a child that ends with us, its limits, and the resources
// that it used.
namespace rex {

/// How a child ended, and what it and the children it waited for used.
struct ChildEnd {
  int status = 0;  ///< as wait4() gives it
  double cpuSeconds = 0;
  long peakKilobytes = 0;  ///< of resident memory

  /// -1 unless it exited by itself.
  [[nodiscard]] int exitCode() const;
  /// The signal that ended it, or 0.
  [[nodiscard]] int signal() const;
};

struct ChildOptions {
  bool ownGroup = true;  ///< it leads a process group, which Ctrl-C does not reach
  /// It uses our memory and we wait until it executes a program, as after vfork(): for a process with much
  /// memory. The body may then change nothing that we need.
  bool sharesMemory = false;
};

/// Runs `body` in a new process, a copy of this one, and returns its id. It is killed when the thread that
/// started it ends; if `body` returns, it exits with 127. Where other threads run, and with shared memory,
/// `body` makes only async-signal-safe calls. Throws Error "cannot start NAME".
[[nodiscard]] int forkChild(const std::string& name, const std::function<void()>& body,
                            const ChildOptions& options = {});

/// Waits for the end of a child. With WNOHANG as flag, returns nothing if it still runs.
std::optional<ChildEnd> waitForChild(int child, int flags = 0);

/// For the body of a child: lowers a limit of setrlimit(), as far as it is not lower already. Returns false,
/// with errno, if the system refuses. Processor time ends with SIGXCPU, and a second later with SIGKILL.
bool lowerLimit(int resource, unsigned long soft, unsigned long hard);
bool lowerCpuSeconds(double seconds);  ///< rounded up

/// For the body of a child: our handlers, which would do our work twice, do not run in it. Signals that are
/// ignored stay so.
void resetSignalHandlers();

/// Blocks all signals in this thread during its lifetime.
class SignalsBlocked {
 public:
  SignalsBlocked();
  ~SignalsBlocked();
  SignalsBlocked(const SignalsBlocked&) = delete;
  SignalsBlocked& operator=(const SignalsBlocked&) = delete;

  const sigset_t& before() const { return before_; }  ///< those that were blocked

 private:
  sigset_t before_;
};

}  // namespace rex
