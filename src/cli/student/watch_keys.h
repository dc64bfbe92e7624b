#pragma once

#include <memory>
#include <optional>
#include <string>

#include "cli/file_watcher.h"
#include "cli/project.h"

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

/// The keys of `rex watch` for one exercise, if there is a keyboard.
class WatchKeys {
 public:
  enum class Wish { kGrade, kNext, kQuit };

  /// Keeps references to all arguments but `check`.
  WatchKeys(const Project& project, const ExerciseInfo& exercise, const Keyboard& keyboard,
            FileWatcher& watcher, std::string check)
      : project_(project),
        exercise_(exercise),
        keyboard_(keyboard),
        watcher_(watcher),
        check_(std::move(check)) {}

  /// The only check, part or failed function to grade; empty: all.
  [[nodiscard]] const std::string& check() const { return check_; }

  /// Handles keys until the file is saved, or a key asks for another grading, the next exercise or the end.
  /// `isSolved`: there may be a next exercise. Throws Interrupted.
  [[nodiscard]] Wish obey(bool isSolved);

 private:
  void sayKeys(bool isSolved) const;
  std::optional<char> nextKey();
  bool answer(char key);
  bool chooseCheck();
  std::optional<std::string> readWord();
  bool askAndReset();

  const Project& project_;
  const ExerciseInfo& exercise_;
  const Keyboard& keyboard_;
  FileWatcher& watcher_;
  std::string check_;
};

}  // namespace rex::cli
