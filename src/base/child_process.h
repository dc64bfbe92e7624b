#pragma once

#include <chrono>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "base/process.h"

namespace rex {

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

  /// Feeds its standard input and waits until everything is taken. Returns false if nobody reads any more,
  /// also after the deadline, at which the program and its process group are killed. Throws Interrupted as
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
