#pragma once

#include <optional>
#include <string>

#include "cli/file_watcher.h"
#include "cli/project.h"
#include "cli/student/keyboard.h"

namespace rex::cli {

/// The keys of `rex watch` for one exercise, if there is a keyboard.
class WatchKeys {
 public:
  enum class Wish { kGrade, kNext, kQuit };

  /// Keeps references to all arguments.
  WatchKeys(const Project& project, const ExerciseInfo& exercise, const Keyboard& keyboard,
            FileWatcher& watcher)
      : project_(project), exercise_(exercise), keyboard_(keyboard), watcher_(watcher) {}

  /// The only check to grade; empty: all.
  [[nodiscard]] const std::string& check() const { return check_; }

  /// Handles keys until the file is saved, or a key asks for another grading, the next exercise or the end.
  /// `isSolved`: there may be a next exercise. Throws Interrupted.
  [[nodiscard]] Wish obey(bool isSolved);

 private:
  void sayKeys(bool isSolved) const;
  std::optional<char> nextKey();
  bool answer(char key);
  bool chooseCheck();
  std::optional<std::string> readDigits();
  bool askAndReset();

  const Project& project_;
  const ExerciseInfo& exercise_;
  const Keyboard& keyboard_;
  FileWatcher& watcher_;
  std::string check_;
};

}  // namespace rex::cli
