#pragma once

#include <array>
#include <csignal>

namespace rex {

/// Both ends of a new pipe, closed at the end of its life and when another program starts. Their numbers are
/// 10 or more, so that in a new process they can be moved to any lower number in any order.
class Pipe {
 public:
  /// Throws Error when the system has no descriptors left.
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

/// While it lives, writing to a pipe that nobody reads is an error code for the thread that made it, not a
/// signal that ends this process.
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
