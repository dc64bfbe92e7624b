#pragma once

#include <csignal>

namespace rex {

/// The user or the system wants this program to stop. No std::exception, so that nothing takes it for an
/// error on its way to the edge of the program.
struct Interrupted {
  int signal = 0;
};

/// The signals that ask a program to stop, by Ctrl-C, by kill, by closing the terminal, except those that it
/// was started to ignore.
[[nodiscard]] sigset_t stopSignals();

/// While it lives, those signals wait. runProcess() looks for them: it ends the program that it runs and
/// throws Interrupted, so that destructors clean up; throwIfInterrupted() is for other long work. One that
/// nobody took acts at the end of this object.
class HeldSignals {
 public:
  HeldSignals();
  ~HeldSignals();
  HeldSignals(const HeldSignals&) = delete;
  HeldSignals& operator=(const HeldSignals&) = delete;

 private:
  sigset_t before_;
};

/// Throws Interrupted if one of those signals is held back.
void throwIfInterrupted();

}  // namespace rex
