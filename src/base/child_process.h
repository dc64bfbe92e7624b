#pragma once

#include <chrono>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "base/process.h"

namespace rex {

/// A program that runs beside this one and is fed piece by piece; what it writes is collected meanwhile. It
/// dies with this object, and with the thread that started it. For one thread, but for cancel().
class ChildProcess {
 public:
  using Deadline = std::chrono::steady_clock::time_point;
  static Deadline after(double seconds);

  /// Starts argv[0] (looked up in PATH); `input` and `timeout` of the options do not count. A program that
  /// cannot be started shows in the result. Throws Error for an empty argv or when no pipe or process can be
  /// made.
  explicit ChildProcess(const std::vector<std::string>& argv, const ProcessOptions& options = {});
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  /// Feeds its standard input and waits until all is taken. Returns false when nobody reads any more, also
  /// after the deadline, at which the program and its process group are killed. Throws Interrupted as
  /// runProcess() does.
  [[nodiscard]] bool write(std::string_view bytes, Deadline deadline);

  /// Closes its standard input and waits for its end, until the deadline as write(). Throws Interrupted.
  [[nodiscard]] ProcessResult finish(Deadline deadline);

  /// From any thread: makes write() and finish() act as if the deadline had come.
  void cancel();

 private:
  struct Running;
  std::unique_ptr<Running> running_;
};

}  // namespace rex
