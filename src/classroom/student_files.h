#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "classroom/download.h"
#include "submission/exercise_info.h"
#include "submission/work_time.h"

namespace rex::classroom {

/// One main.cpp that a student handed in.
struct PickedFile {
  std::string exercise{};  ///< full name
  std::string text{};
  std::string source{};         ///< path in the download, through archives: "zoe.zip/01/main.cpp"
  std::int64_t modifiedAt = 0;  ///< seconds since 1970 in UTC; 0: unknown
  int attempts = 0;             ///< how often it was handed in; 0: unknown
  std::optional<submission::WorkTime> work{};  ///< as the receipt says, if the student wants that
};

/// What was found in the files of one student.
struct PickedFiles {
  std::vector<PickedFile> files{};        ///< one for each exercise, by exercise
  std::vector<std::string> complaints{};  ///< what was not taken: file, finding, what was wanted
  std::vector<std::string> notes{};       ///< other things that were found
  /// The first complaint about each exercise; "": about what could be any.
  std::map<std::string, std::string> whyNone{};
};

/// How to find exercises.
struct PickOptions {
  const std::vector<submission::ExerciseInfo>& exercises;
  std::string exercise{};  ///< full name of the only one wanted, also for files outside of exercise folders
  std::map<std::string, std::string>
      handedOut{};  ///< texts by exercise; a file that is the same is not taken
};

/// Finds the main.cpp of each exercise among the files that one student handed in, also inside archives. The
/// folder around it names the exercise. For the exercise of the options, a main.cpp anywhere else will do,
/// and so will a single source file of any other name. Of two files for one exercise, with different texts,
/// neither is taken. Never throws for what a student handed in.
[[nodiscard]] PickedFiles pickFiles(const std::vector<DownloadedFile>& files, const PickOptions& options);

}  // namespace rex::classroom
