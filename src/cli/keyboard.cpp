#include "cli/keyboard.h"

#include <unistd.h>

namespace rex::cli {

Keyboard::Keyboard() {
  if (::isatty(STDIN_FILENO) != 1 || ::isatty(STDOUT_FILENO) != 1) return;
  // A program in the background must not touch the terminal.
  if (::tcgetpgrp(STDIN_FILENO) != ::getpgrp() || ::tcgetattr(STDIN_FILENO, &before_) != 0) return;
  termios single = before_;
  single.c_lflag &= ~static_cast<tcflag_t>(ICANON | ECHO);
  single.c_cc[VMIN] = 1;
  single.c_cc[VTIME] = 0;
  isThere_ = ::tcsetattr(STDIN_FILENO, TCSANOW, &single) == 0;
}

Keyboard::~Keyboard() {
  if (isThere_) ::tcsetattr(STDIN_FILENO, TCSANOW, &before_);
}

int Keyboard::descriptor() const { return isThere_ ? STDIN_FILENO : -1; }

char Keyboard::read() const {
  char key = 'q';
  return ::read(STDIN_FILENO, &key, 1) == 1 ? key : 'q';
}

}  // namespace rex::cli
