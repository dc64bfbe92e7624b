#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <string>

#include "base/exit_code.h"
#include "cli/project.h"
#include "cli/student/records.h"
#include "grading/results.h"

namespace rex::cli {

/// When a part passed for the first time.
struct PassedPart {
  std::int64_t at = 0;      ///< seconds since 1970 in UTC
  std::int64_t worked = 0;  ///< Work::seconds then
};

/// How long a file was worked on, as far as saves tell that a test has seen.
struct Work {
  std::int64_t seconds = 0;   ///< the times between saves that are no pauses
  std::int64_t lastSave = 0;  ///< seconds since 1970 in UTC; 0: none was seen
  std::string fileSha256{};   ///< of the file then
  std::map<std::string, PassedPart> parts{};
};

/// What is between two saves counts as work if it is at most so many seconds.
inline constexpr std::int64_t kLongestPause = 15 * 60;

/// Adds a test that ended at `now`: the time since the last save if it found another file, and, if it had all
/// checks, the parts that passed.
void addTest(Work& work, const grading::GradeResult& result, bool isWhole, std::int64_t now);

/// What `rex` remembers about one exercise.
struct Progress {
  bool tested = false;
  int points = 0;                      ///< of the last complete test of main.cpp
  int maxPoints = 0;                   ///< of that test: the students' tree lacks hidden checks
  bool solved = false;                 ///< a complete test once had the full score
  std::string fileSha256{};            ///< hash of the main.cpp that was tested last
  std::map<std::string, int> hints{};  ///< number of hints shown, by part
  Work work{};
  Records records{};
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
