#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "submission/exercise_info.h"

namespace rex::grading {

/// When students handed in, as a learning platform records it.
class SubmissionTimes {
 public:
  /// Reads a CSV file with the columns student, submitted (a time with its zone, or empty) and, if
  /// exercises differ, exercise. Throws Error with the line for anything else and for two times of one
  /// submission.
  SubmissionTimes(const std::filesystem::path& file, const std::vector<ExerciseInfo>& exercises);

  /// Seconds since 1970 in UTC; empty if the file does not have it.
  [[nodiscard]] std::optional<std::int64_t> of(const std::string& student, const std::string& exercise) const;

 private:
  std::map<std::pair<std::string, std::string>, std::int64_t> times_;  ///< exercise "": all
};

}  // namespace rex::grading
