#pragma once

#include <csignal>

namespace rex {

/// Thrown if the user or the system wants this program to stop. It is not a std::exception, so that no
/// handler on the way to main() takes it for an error.
struct Interrupted {
  int signal = 0;
};

/// The signals that ask a program to stop, by Ctrl-C, by kill or by closing the terminal, except those that
/// it was started to ignore.
[[nodiscard]] sigset_t stopSignals();

/// Holds those signals back during its lifetime. runProcess() checks for them: it ends the program that it
/// runs and throws Interrupted, so that destructors clean up; throwIfInterrupted() is for other long work.
/// A signal that nobody handled takes effect when this object is destroyed.
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
