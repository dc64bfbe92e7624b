#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "classroom/late_policy.h"
#include "submission/exercise_info.h"

namespace rex::classroom {

/// One person on the roster.
struct CourseStudent {
  std::string id{};       ///< the name of the folder that is handed in, and the key of everything
  std::string name{};     ///< empty: unknown
  std::string email{};    ///< empty: unknown
  std::string group{};    ///< those who hand in together; empty: alone
  std::string number{};   ///< what a platform calls this person: a matriculation number; empty: the id
  std::string section{};  ///< of the course, for Canvas
};

/// A row of the roster that was not taken; the others were.
struct RosterFault {
  CourseStudent student{};  ///< as far as it could be read
  std::string why{};        ///< place, what was found and what is wanted
};

/// What a course is graded with, unless an option says otherwise.
struct GradingSettings {
  std::filesystem::path secret{};  ///< file; empty: none
  std::optional<std::uint64_t> seed{};
  std::optional<int> level{};  ///< of the sandbox
  bool evidence = false;       ///< keep pictures and replays
  std::string reports{};       ///< names of formats with commas; empty: none
};

/// What an exercise counts for.
struct CourseExercise {
  std::int64_t weight = 100;              ///< hundredths
  std::vector<std::string> parts{};       ///< ids of those that count; empty: all
  bool isBonus = false;                   ///< adds to the total, but not to the points that are possible
  std::optional<std::int64_t> minimum{};  ///< to pass, hundredths of a percent of its points; empty: none

  [[nodiscard]] bool counts(const std::string& part) const;
};

/// Somebody who grades a share of the class.
struct Tutor {
  std::string name{};
  std::string section{};  ///< of the roster, whose students are the tutor's; empty: an even share
  std::filesystem::path adjustments{};  ///< that the tutor writes; empty: none
};

/// What the total is made of, and who passes.
struct TotalRules {
  std::optional<int> best{};                  ///< only so many exercises count, for each student the best
  std::optional<std::int64_t> passPercent{};  ///< hundredths of a percent of the possible points
  std::optional<int> passExercises{};         ///< so many reach their minimum; empty: all that have one
};

/// The contents of a course file (share/doc/grading.md).
struct Course {
  std::string title{};
  std::vector<CourseStudent> students{};              ///< by id
  std::vector<RosterFault> faults{};                  ///< by place
  std::vector<std::string> notes{};                   ///< what names of the roster lost
  LatePolicy policy{};                                ///< extensions of groups are listed for each member
  std::map<std::string, CourseExercise> exercises{};  ///< of the course, by full name; empty: all there are
  TotalRules total{};
  std::vector<Tutor> tutors{};                 ///< in the order of the file
  std::filesystem::path results{};             ///< where results go; empty: not said
  std::filesystem::path adjustments{};         ///< empty: none
  std::vector<std::filesystem::path> files{};  ///< that the course file names and people write
  GradingSettings settings{};
  std::string timeZone{};  ///< in which times are shown to people; empty: UTC

  /// What that exercise counts for, also if the course names none.
  [[nodiscard]] CourseExercise exercise(const std::string& name) const;
  /// Whether anybody can fail.
  [[nodiscard]] bool hasPassRules() const;
  [[nodiscard]] bool hasRoster() const { return !students.empty() || !faults.empty(); }
  [[nodiscard]] const CourseStudent* student(const std::string& id) const;
  [[nodiscard]] std::vector<std::string> ids() const;
  [[nodiscard]] std::vector<std::string> groups() const;
  [[nodiscard]] std::vector<std::string> members(const std::string& group) const;
};

enum class RosterUse { kRead, kLeave };

/// Paths in the file are relative to its folder. A row of the roster that is malformed, without id or with
/// that of another becomes a fault. Throws Error with file, line and column for malformed files, unknown
/// exercises and parts, rules that nobody can meet, and extensions and sections of nobody. kLeave: as if
/// there were no roster.
[[nodiscard]] Course readCourse(const std::filesystem::path& file,
                                const std::vector<submission::ExerciseInfo>& exercises,
                                RosterUse roster = RosterUse::kRead);

/// A name as people write it: "Zoe Müller", or the id if none is known.
[[nodiscard]] std::string shownName(const CourseStudent& student);

}  // namespace rex::classroom
