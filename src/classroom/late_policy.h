#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/toml_table.h"

namespace rex::classroom {

/// When an exercise is given out and due, and the penalty for lateness. Times in seconds since 1970 in UTC.
struct LateRule {
  std::optional<std::int64_t> opening{};
  std::optional<std::int64_t> deadline{};
  std::map<std::string, std::int64_t> extensions{};  ///< later deadlines of individual students
  std::map<std::string, SourceLocation> places{};    ///< where each extension was read
  std::int64_t graceSeconds = 0;                     ///< lateness up to this is tolerated
  bool isPercent = true;              ///< the penalty is a percentage of the points reached; else points
  std::int64_t perDay = 0;            ///< hundredths, per day or part of a day
  std::optional<std::int64_t> cap{};  ///< hundredths, the largest total
};

/// The penalty of one submission.
struct Lateness {
  int days = 0;              ///< after the deadline, counting a part as one; 0: in time
  std::int64_t penalty = 0;  ///< hundredths of points, never more than the points
};

/// The lateness of a submission. Days count from the deadline even if there is grace. Hundredths are
/// rounded to the nearest, halves up.
[[nodiscard]] Lateness computeLateness(const LateRule& rule, const std::string& student,
                                       std::int64_t submitted, int points);

/// The same for hundredths of points.
[[nodiscard]] Lateness latenessOfHundredths(const LateRule& rule, const std::string& student,
                                            std::int64_t submitted, std::int64_t points);

/// The deadline of a student, with an extension that is later; empty: none.
[[nodiscard]] std::optional<std::int64_t> studentDeadline(const LateRule& rule, const std::string& student);

/// Rules by full exercise name; a missing exercise has no deadline.
using LatePolicy = std::map<std::string, LateRule>;

/// Reads a file of deadlines, or the deadlines of a course file (share/doc/grading.md). Throws Error
/// with the position for malformed files and for exercises that do not exist.
[[nodiscard]] LatePolicy readLatePolicy(const std::filesystem::path& file,
                                        const std::vector<std::string>& exercises);

/// The same from the tables [all] and [exercise.NAME] of a file in that folder, and the table of extensions
/// that it names.
[[nodiscard]] LatePolicy parseLatePolicy(const TomlTable& file, const std::filesystem::path& folder,
                                         const std::vector<std::string>& exercises);

/// All keys at the top of a course file; those of a file of deadlines are the first three.
inline const std::vector<std::string> kCourseKeys = {
    "all",         "exercise", "extensions", "title",    "students", "student",   "adjustments", "results",
    "secret_file", "seed",     "level",      "evidence", "reports",  "time_zone", "total",       "tutor"};

/// A sentence for each student with an extension who is not in `students`, as the name may be misspelt.
[[nodiscard]] std::vector<std::string> unknownExtensions(const LatePolicy& policy,
                                                         const std::vector<std::string>& students);

}  // namespace rex::classroom
