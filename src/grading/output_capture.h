#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace rex::grading {

/// Collects the output of a pipe in bounded memory: the first 64 kB, and the last 4 kB for the message of a
/// crash. The rest is read and only counted. Owns the descriptor, which must be non-blocking.
class OutputCapture {
 public:
  explicit OutputCapture(int fd) : fd_(fd) {}
  ~OutputCapture();
  OutputCapture(const OutputCapture&) = delete;
  OutputCapture& operator=(const OutputCapture&) = delete;

  /// The descriptor, or -1 after the end of the output.
  int fd() const { return fd_; }
  /// Reads what is there now, at most 256 kB, so that a flood cannot hold the reader up.
  void drain();

  const std::string& head() const { return head_; }
  const std::string& tail() const { return tail_; }
  std::uint64_t total() const { return total_; }

 private:
  int fd_;
  std::string head_;
  std::string tail_;
  std::uint64_t total_ = 0;
};

/// The line of an error output that best explains why a program died: an assertion, a sanitizer's finding,
/// or the last line. Empty if there is none.
[[nodiscard]] std::string tellingLine(const std::string& errorOutput);

}  // namespace rex::grading
