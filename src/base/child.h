#pragma once

#include <csignal>
#include <functional>
#include <optional>
#include <string>

// What all have in common that start processes of ours: a child that ends with us, its limits, and what it
// used.
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
