#pragma once

#include <condition_variable>
#include <functional>
#include <mutex>
#include <string>
#include <thread>

namespace rex::cli {

/// While it lives, the last line of the terminal says what long work is doing, some times a second; nothing
/// where standard error is not a terminal. The line is gone afterwards. It needs no escape sequences.
class ProgressLine {
 public:
  /// `text` is called from a thread of its own.
  explicit ProgressLine(std::function<std::string()> text);
  ~ProgressLine();
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  /// Takes the line away while `print` writes to the terminal.
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
