#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace rex::grading {

/// When an exercise is due and what lateness costs. Times in seconds since 1970 in UTC.
struct LateRule {
  std::optional<std::int64_t> deadline{};
  std::map<std::string, std::int64_t> extensions{};  ///< later deadlines of single students
  std::int64_t graceSeconds = 0;                     ///< late by this much is not late
  bool isPercent = true;                             ///< of the points that were reached; else points
  std::int64_t perDay = 0;                           ///< hundredths, for each day begun
  std::optional<std::int64_t> cap{};                 ///< hundredths, at most this altogether
};

/// What lateness costs one submission.
struct Lateness {
  int days = 0;              ///< begun after the deadline; 0: in time
  std::int64_t penalty = 0;  ///< hundredths of points, never more than the points
};

/// Days count from the deadline, also where there is grace. Hundredths are rounded to the nearest, halves up.
[[nodiscard]] Lateness latenessOf(const LateRule& rule, const std::string& student, std::int64_t submitted,
                                  int points);

/// By whole name of the exercise; one that is missing has no deadline.
using LatePolicy = std::map<std::string, LateRule>;

/// Reads a file of deadlines (share/doc/grading-many.md). Throws Error, with the place, for what is no such
/// file, and for names of exercises that do not exist.
[[nodiscard]] LatePolicy readLatePolicy(const std::filesystem::path& file,
                                        const std::vector<std::string>& exercises);

/// A sentence for each student with an extension who is none of these: a name may be misspelt.
[[nodiscard]] std::vector<std::string> unknownExtensions(const LatePolicy& policy,
                                                         const std::vector<std::string>& students);

}  // namespace rex::grading
