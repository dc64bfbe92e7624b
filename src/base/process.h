#pragma once
// Runs other programs, with limits of time and output.
#include <chrono>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace rex {

/// Repeats an attempt once if it was killed. A machine short of memory kills programs that did nothing
/// wrong, while a program that gets itself killed does so again.
template <typename Attempt, typename Killed>
auto onceMoreIfKilled(const Attempt& attempt, const Killed& wasKilled) {
  auto first = attempt();
  return wasKilled(first) ? attempt() : first;
}

/// Options for running another program. Nothing ever passes through a shell.
struct ProcessOptions {
  std::string input{};                     ///< fed to its standard input, which is empty otherwise
  std::filesystem::path directory{};       ///< its working directory; empty: ours
  std::vector<std::string> environment{};  ///< NAME=VALUE, added to ours or replacing one of that name
  double timeout = 60;                     ///< wall seconds; then it and its process group are killed
  std::size_t outputLimit = 1u << 20;      ///< bytes kept of each output stream; the rest is read and dropped
  bool inheritOutput = false;    ///< outputs go where ours go, unkept; Ctrl-C reaches the program too
  double cpuSeconds = 0;         ///< processor seconds, rounded up, then SIGKILL or SIGXCPU; 0: no limit
  std::size_t addressSpace = 0;  ///< bytes of virtual memory; 0: no limit
  std::size_t fileSize = 0;      ///< bytes of the largest file it may write; 0: no limit
};

/// How the program ended.
struct ProcessResult {
  bool started = false;  ///< false: the program was not found or could not be executed
  bool timedOut = false;
  int exitCode = -1;      ///< -1 unless it exited by itself
  int signal = 0;         ///< the signal that ended it, or 0
  double cpuSeconds = 0;  ///< processor time of it and of the children it waited for
  std::string output;     ///< standard output, at most outputLimit bytes
  std::string error;      ///< standard error, at most outputLimit bytes
  [[nodiscard]] bool ok() const { return started && !timedOut && exitCode == 0; }
};

/// Runs argv[0] (looked up in PATH) and waits for its end or the timeout. Throws Error for an empty argv or
/// if no pipe or process can be made. Throws Interrupted if a signal of HeldSignals arrives, after the
/// program and its process group have ended. A program that inherits our outputs gets the signal itself and
/// is waited for.
[[nodiscard]] ProcessResult runProcess(const std::vector<std::string>& argv,
                                       const ProcessOptions& options = {});

/// A program that runs beside this one and is fed piece by piece while its output is collected. It is
/// killed with this object, and with the thread that started it. For use by one thread, except cancel().
class ChildProcess {
 public:
  using Deadline = std::chrono::steady_clock::time_point;
  static Deadline after(double seconds);

  /// Starts argv[0] (looked up in PATH); `input` and `timeout` of the options are ignored. The result says
  /// if a program could not be started. Throws Error for an empty argv or if no pipe or process can be made.
  explicit ChildProcess(const std::vector<std::string>& argv, const ProcessOptions& options = {});
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  /// Feeds its standard input and waits until everything is taken. Returns false if it stopped reading, or
  /// at the deadline, when the program and its process group are killed. Throws Interrupted as
  /// runProcess() does.
  [[nodiscard]] bool write(std::string_view bytes, Deadline deadline);

  /// Closes its standard input and waits for its end, with the deadline as in write(). Throws Interrupted.
  [[nodiscard]] ProcessResult finish(Deadline deadline);

  /// From any thread: makes write() and finish() act as if the deadline had come.
  void cancel();

 private:
  struct Running;
  std::unique_ptr<Running> running_;
};

}  // namespace rex
