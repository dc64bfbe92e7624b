#include "cli/student/watch_keys.h"

#include <algorithm>
#include <cctype>
#include <cstdio>

#include <fmt/format.h>
#include <termios.h>
#include <unistd.h>

#include "base/text.h"
#include "cli/student/exercise_commands.h"
#include "cli/student/progress.h"
#include "cli/terminal.h"
#include "grading/unknown_check.h"
#include "submission/submission.h"

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

WatchKeys::Wish WatchKeys::obey(bool isSolved) {
  for (;;) {
    sayKeys(isSolved);
    const std::optional<char> key = nextKey();
    if (!key || *key == 't') return Wish::kGrade;
    if (*key == 'q') return Wish::kQuit;
    if (*key == 'n' && isSolved) return Wish::kNext;
    try {
      if (answer(*key)) return Wish::kGrade;
    } catch (const std::exception& error) {
      note(wrap(fmt::format("rex: {}", error.what()), 2, 0));
    }
  }
}

void WatchKeys::sayKeys(bool isSolved) const {
  say(std::string("[t]est  [h]int  [p]ictures  [l]ist  ") +
      (check_.empty() ? "[s]ingle check" : "[a]ll checks") + "  [x] reset  " + (isSolved ? "[n]ext  " : "") +
      "[q]uit");
}

// Empty if the file was saved first.
std::optional<char> WatchKeys::nextKey() {
  std::fflush(stdout);
  if (watcher_.wait(keyboard_.descriptor()) == FileWatcher::Event::kSaved) return {};
  return keyboard_.read();
}

// Returns true if it is time to grade.
bool WatchKeys::answer(char key) {
  switch (key) {
    case 'h':
      static_cast<void>(hint(project_, HintOptions{.exercise = exercise_.name, .part = {}}));
      return false;
    case 'p':
      static_cast<void>(show(project_, {.exercise = exercise_.name}));
      return false;
    case 'l':
      static_cast<void>(progress(project_));
      return false;
    case 's':
      return chooseCheck();
    case 'a':
      if (check_.empty()) return false;
      check_.clear();
      return true;
    case 'x':
      return askAndReset();
    default:
      return false;
  }
}

bool WatchKeys::chooseCheck() {
  const std::vector<grading::CheckResult> checks = submission::listChecks(prepare(project_, exercise_));
  for (std::size_t k = 0; k < checks.size(); ++k)
    say(fmt::format(" {:2}  {}", k + 1,
                    wrap(fmt::format("{} [{}]", escapeForTerminal(checks[k].title), checks[k].id), 5, 5)));
  fmt::print("number or name and Enter, or Enter alone to go back: ");
  const std::optional<std::string> typed = readWord();
  if (!typed) return true;
  if (typed->empty()) return false;
  const std::size_t number = parseNumber<std::size_t>(*typed).value_or(0);
  std::vector<std::string> ids;
  for (const grading::CheckResult& check : checks) ids.push_back(check.id);
  const std::string id = number >= 1 && number <= ids.size() ? ids[number - 1] : *typed;
  if (std::find(ids.begin(), ids.end(), id) == ids.end()) throw grading::unknownCheck(id, ids);
  check_ = id;
  return true;
}

// Reads and echoes a number or name until Enter; "" after a key that belongs to neither. Empty if the file
// was saved.
std::optional<std::string> WatchKeys::readWord() {
  constexpr std::size_t kMost = 60;
  constexpr char kDelete = 127;
  std::string word;
  for (;;) {
    const std::optional<char> key = nextKey();
    if (key && (*key == kDelete || *key == '\b')) {
      if (word.empty()) continue;
      word.pop_back();
      fmt::print("\b \b");
    } else if (key && (std::isalnum(static_cast<unsigned char>(*key)) != 0 || *key == '-') &&
               word.size() < kMost) {
      word += *key;
      fmt::print("{}", *key);
    } else {
      say();
      if (!key) return {};
      return *key == '\n' || *key == '\r' ? word : "";
    }
  }
}

bool WatchKeys::askAndReset() {
  say(fmt::format("Start again with {} as it was handed out? Yours is kept next to it.",
                  shown(exercise_.folder / "main.cpp")));
  fmt::print("[y]es, or any other key: ");
  const std::optional<char> key = nextKey();
  say();
  if (!key) return true;
  // The file that was handed out counts as saved.
  if (*key == 'y') static_cast<void>(reset(project_, exercise_.name));
  return false;
}

}  // namespace rex::cli
