#pragma once

#include <array>
#include <csignal>

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
