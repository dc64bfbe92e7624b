#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "grading/results.h"

namespace rex::grading {

struct StudentResult {
  std::string student{};
  std::string exercise{};
  GradeResult result{};
};

/// What R/STUDENT/EXERCISE/results.json of a folder R say.
struct ClassResults {
  std::vector<StudentResult> results{};  ///< by exercise, then by student
  std::vector<std::string>
      complaints{};  ///< files that are no results, or not of that exercise; none is lost
};

/// Throws Error where the folder itself cannot be read.
[[nodiscard]] ClassResults readClassResults(const std::filesystem::path& folder);

struct CheckStatistics {
  std::string id{};
  std::string title{};
  Group group = Group::kVisible;
  int failed = 0;  ///< did not pass in full
  std::map<std::string, int>
      classes{};  ///< of those: "compile", "crash", "timeout", "non-finite", "wrong", ...
};

/// From full points down to none: full, at least 75 %, 50 %, 25 %, less, none.
inline constexpr std::array<const char*, 6> kDistribution = {"full", "75 %", "50 %", "25 %", "less", "none"};

/// Of one exercise. Means and medians are over those graded; faults of the grader are no grades.
struct ExerciseStatistics {
  std::string exercise{};
  int graded = 0;
  int full = 0;
  int graderFailed = 0;
  int versions = 0;  ///< of the exercise, among the results: points of two cannot be compared
  int maxPoints = 0;
  double meanPoints = 0;
  double medianPoints = 0;
  std::array<int, kDistribution.size()> distribution{};
  double medianSeconds = 0;  ///< of wall time that the checks of a file that compiles took
  double longestSeconds = 0;
  std::string slowest{};                  ///< the student of the longest
  std::vector<CheckStatistics> checks{};  ///< the most failed first, then in the order of the results
};

[[nodiscard]] std::vector<ExerciseStatistics> statisticsOf(const std::vector<StudentResult>& results);

/// "compile", "crash", "timeout", "memory", "output", "protocol", "security", "non-finite", "shape",
/// "wrong" or "not run", of a check that did not pass.
[[nodiscard]] std::string classOf(const CheckResult& check, const GradeResult& whole);

/// The middle one; of an even number the mean of the two in the middle; 0 of none.
[[nodiscard]] double medianOf(std::vector<double> values);

}  // namespace rex::grading
