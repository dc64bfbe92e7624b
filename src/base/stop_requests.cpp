#include <csignal>

#include <sys/signalfd.h>
#include <unistd.h>

#include "base/interruption.h"
#include "base/stop_requests_internal.h"

namespace rex {

StopRequests::StopRequests() {
  const sigset_t wanted = stopSignals();
  sigset_t held, both;
  ::sigprocmask(SIG_BLOCK, nullptr, &held);
  ::sigandset(&both, &wanted, &held);
  fd_ = ::signalfd(-1, &both, SFD_CLOEXEC | SFD_NONBLOCK);
}

StopRequests::~StopRequests() {
  if (fd_ >= 0) ::close(fd_);
}

int StopRequests::take() const {
  signalfd_siginfo info{};
  return ::read(fd_, &info, sizeof info) == sizeof info ? static_cast<int>(info.ssi_signo) : 0;
}

}  // namespace rex
