#pragma once

#include <memory>

struct termios;  // of the system

namespace rex::cli {

/// While it lives, keys reach the program one by one, without Enter and without echo, if standard input and
/// output are a terminal. Ctrl-C still stops the program.
class Keyboard {
 public:
  Keyboard();
  ~Keyboard();
  Keyboard(const Keyboard&) = delete;
  Keyboard& operator=(const Keyboard&) = delete;

  [[nodiscard]] bool isThere() const { return before_ != nullptr; }
  /// For poll(); -1 if there is no keyboard.
  [[nodiscard]] int descriptor() const;
  /// The key that was pressed; 'q' if the terminal is gone.
  [[nodiscard]] char read() const;

 private:
  std::unique_ptr<termios> before_;  // previous state of the terminal; null: there is no keyboard
};

}  // namespace rex::cli
