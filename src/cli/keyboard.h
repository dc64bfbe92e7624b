#pragma once

#include <termios.h>

namespace rex::cli {

/// While it lives, keys reach the program one by one, without Enter and unseen; only where standard input and
/// output are a terminal. Ctrl-C still stops the program.
class Keyboard {
 public:
  Keyboard();
  ~Keyboard();
  Keyboard(const Keyboard&) = delete;
  Keyboard& operator=(const Keyboard&) = delete;

  [[nodiscard]] bool isThere() const { return isThere_; }
  /// For poll(); -1 where there is no keyboard.
  [[nodiscard]] int descriptor() const;
  /// The key that was pressed; 'q' when the terminal is gone.
  [[nodiscard]] char read() const;

 private:
  bool isThere_ = false;
  termios before_{};
};

}  // namespace rex::cli
