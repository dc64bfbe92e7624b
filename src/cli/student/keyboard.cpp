#include "cli/student/keyboard.h"

#include <termios.h>
#include <unistd.h>

namespace rex::cli {

Keyboard::Keyboard() {
  if (::isatty(STDIN_FILENO) != 1 || ::isatty(STDOUT_FILENO) != 1) return;
  // A program in the background must not touch the terminal.
  termios before{};
  if (::tcgetpgrp(STDIN_FILENO) != ::getpgrp() || ::tcgetattr(STDIN_FILENO, &before) != 0) return;
  termios single = before;
  single.c_lflag &= ~static_cast<tcflag_t>(ICANON | ECHO);
  single.c_cc[VMIN] = 1;
  single.c_cc[VTIME] = 0;
  if (::tcsetattr(STDIN_FILENO, TCSANOW, &single) == 0) before_ = std::make_unique<termios>(before);
}

Keyboard::~Keyboard() {
  if (before_) ::tcsetattr(STDIN_FILENO, TCSANOW, before_.get());
}

int Keyboard::descriptor() const { return isThere() ? STDIN_FILENO : -1; }

char Keyboard::read() const {
  char key = 'q';
  return ::read(STDIN_FILENO, &key, 1) == 1 ? key : 'q';
}

}  // namespace rex::cli
