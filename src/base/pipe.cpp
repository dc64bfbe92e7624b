#include "base/pipe.h"

#include <cerrno>
#include <csignal>
#include <cstring>
#include <utility>

#include <fcntl.h>
#include <unistd.h>

#include "base/error.h"

namespace rex {

Pipe::Pipe() {
  constexpr int kLowest = 10;
  std::array<int, 2> low{-1, -1};
  bool made = ::pipe2(low.data(), O_CLOEXEC) == 0;
  for (int k = 0; k < 2 && made; ++k) {
    ends_[k] = ::fcntl(low[k], F_DUPFD_CLOEXEC, kLowest);
    made = ends_[k] >= 0;
  }
  const int cause = errno;
  for (int& fd : low) close(fd);
  if (made) return;
  closeRead(), closeWrite();
  throw Error({.what = "cannot make a pipe", .found = std::strerror(cause)});
}

Pipe::~Pipe() { closeRead(), closeWrite(); }

int Pipe::releaseRead() { return std::exchange(ends_[0], -1); }
int Pipe::releaseWrite() { return std::exchange(ends_[1], -1); }

void Pipe::close(int& fd) {
  if (fd >= 0) ::close(fd);
  fd = -1;
}

namespace {

sigset_t sigpipe() {
  sigset_t signals;
  ::sigemptyset(&signals);
  ::sigaddset(&signals, SIGPIPE);
  return signals;
}

}  // namespace

// The signal goes to the thread that writes, so blocking it there is enough and disturbs no other thread.
SigpipeIgnored::SigpipeIgnored() {
  const sigset_t signals = sigpipe();
  ::pthread_sigmask(SIG_BLOCK, &signals, &before_);
}

SigpipeIgnored::~SigpipeIgnored() {
  const sigset_t signals = sigpipe();
  const timespec now{};
  if (::sigismember(&before_, SIGPIPE) == 0) ::sigtimedwait(&signals, nullptr, &now);
  ::pthread_sigmask(SIG_SETMASK, &before_, nullptr);
}

}  // namespace rex
