#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/error.h"
#include "classroom/course_file.h"

namespace rex::classroom {

/// What a person decides about a grade. It changes a check before the penalty for lateness, or the final
/// points after it.
struct Adjustment {
  std::vector<std::string> students{};   ///< ids: one, or the members of a group
  std::string exercise{};                ///< full name
  std::string check{};                   ///< empty: the final points
  std::optional<std::int64_t> points{};  ///< hundredths that replace the points; empty: `add` is added
  std::int64_t add = 0;                  ///< hundredths
  std::string reason{}, author{}, date{};
  SourceLocation where{};
};

/// What a person writes to a student about main.cpp.
struct Comment {
  std::vector<std::string> students{};
  std::string exercise{};
  int line = 0;  ///< 0: the whole file
  std::string text{}, author{};
  SourceLocation where{};
};

/// What a student objects to.
struct Complaint {
  std::vector<std::string> students{};
  std::string exercise{};
  std::string text{}, date{};
  std::string answer{};  ///< empty: it is open
  SourceLocation where{};
};

struct Adjustments {
  std::vector<Adjustment> adjustments{};  ///< in the order of the file, in which they are applied
  std::vector<Comment> comments{};
  std::vector<Complaint> complaints{};
  std::vector<std::string> conflicts{};  ///< between tutors, a sentence for each: see mergeAdjustments()
  std::vector<std::string> notes{};      ///< for the reader of the grades
};

/// Ids of students by what tutors see instead: see blindId().
using BlindIds = std::map<std::string, std::string>;

/// Reads a file of adjustments (share/doc/grading.md) for the students of a course. Throws Error with
/// the position for malformed files, and for students, groups and exercises that do not exist.
[[nodiscard]] Adjustments readAdjustments(const std::filesystem::path& file, const Course& course,
                                          const std::vector<submission::ExerciseInfo>& exercises,
                                          const BlindIds& blind = {});

}  // namespace rex::classroom
