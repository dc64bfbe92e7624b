#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <string>

#include "base/exit_code.h"
#include "cli/project.h"

namespace rex::cli {

/// What `rex` remembers about one exercise.
struct Progress {
  bool tested = false;
  int points = 0;                      ///< of the last complete test of main.cpp
  int maxPoints = 0;                   ///< of that test: the students' tree lacks hidden checks
  bool solved = false;                 ///< a complete test once had the full score
  std::string fileSha256{};            ///< hash of the main.cpp that was tested last
  std::map<std::string, int> hints{};  ///< number of hints shown, by part
};

struct AllProgress {
  std::map<std::string, Progress> exercises{};
  std::string last{};  ///< the tested exercise that was worked on last; empty: none
};

/// The file .rex/progress.json of a project. It is replaced atomically, so that a killed program leaves
/// either the old text or the new one, and changed under a lock, so that two programs do not overwrite each
/// other's changes. Unknown keys are kept. A file that cannot be parsed is moved aside, which is reported
/// on standard error.
class ProgressFile {
 public:
  explicit ProgressFile(const std::filesystem::path& projectRoot) : folder_(projectRoot / ".rex") {}

  [[nodiscard]] AllProgress read() const;
  /// Changes what is remembered about one exercise, and makes it the last one if it was ever tested. If it
  /// cannot be saved, reports that on standard error and returns false: no command fails because of it.
  bool change(const std::string& exercise, const std::function<void(Progress&)>& edit) const;

 private:
  std::filesystem::path folder_;
};

/// Prints the points of the last test of each exercise, and what to do next.
ExitCode progress(const Project& project);

}  // namespace rex::cli
