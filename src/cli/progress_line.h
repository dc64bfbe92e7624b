#pragma once

#include <condition_variable>
#include <functional>
#include <mutex>
#include <string>
#include <thread>

namespace rex::cli {

/// While it lives, the last line of the terminal shows the progress of long work, updated several times a
/// second, if standard error is a terminal. The line is erased at the end. It needs no escape sequences.
class ProgressLine {
 public:
  /// `text` is called from another thread.
  explicit ProgressLine(std::function<std::string()> text);
  ~ProgressLine();
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  /// Erases the line while `print` writes to the terminal.
  void stepAside(const std::function<void()>& print);

 private:
  void show();

  std::function<std::string()> text_;
  std::mutex mutex_;
  std::condition_variable wake_;
  bool isOver_ = false;
  std::thread thread_;
};

}  // namespace rex::cli
