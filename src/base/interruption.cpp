#include "base/interruption.h"

#include <ctime>
#include <initializer_list>

namespace rex {

sigset_t stopSignals() {
  sigset_t signals;
  ::sigemptyset(&signals);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction action {};
    ::sigaction(signal, nullptr, &action);
    if (action.sa_handler != SIG_IGN) ::sigaddset(&signals, signal);
  }
  return signals;
}

HeldSignals::HeldSignals() {
  const sigset_t signals = stopSignals();
  ::sigprocmask(SIG_BLOCK, &signals, &before_);
}

HeldSignals::~HeldSignals() { ::sigprocmask(SIG_SETMASK, &before_, nullptr); }

void throwIfInterrupted() {
  sigset_t blocked;
  ::sigprocmask(SIG_BLOCK, nullptr, &blocked);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    // A signal that is not blocked takes effect by itself; waiting for it would be a race.
    if (::sigismember(&blocked, signal) != 1) continue;
    sigset_t one;
    ::sigemptyset(&one);
    ::sigaddset(&one, signal);
    const timespec now{};
    if (::sigtimedwait(&one, nullptr, &now) == signal) throw Interrupted{signal};
  }
}

}  // namespace rex
