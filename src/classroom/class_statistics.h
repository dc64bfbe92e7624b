#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "classroom/gradebook.h"
#include "classroom/stored_result.h"
#include "grading/results.h"
#include "submission/work_time.h"

namespace rex::classroom {

struct StudentResult {
  std::string student{};
  std::string exercise{};
  grading::GradeResult result{};
  std::optional<std::int64_t> submitted{};  ///< seconds since 1970 in UTC, as the list of tasks has it
  std::string timeFrom{};                   ///< table, platform, git or file
  int attempts = 0;                         ///< 0: nobody counted them
  std::string attemptsFrom{};               ///< see ImportedExercise
  std::optional<submission::WorkTime> work{};
};

/// The results R/STUDENT/EXERCISE/results.json of a folder R, with what its list of tasks and its table of
/// imports say about them.
struct ClassResults {
  std::vector<StudentResult> results{};   ///< by exercise, then by student
  std::vector<std::string> complaints{};  ///< files that are not results, were changed, or of other exercises
  std::map<std::pair<std::string, std::string>, StoredFiles>
      files{};  ///< by student and exercise, as they were read
};

/// Throws Error if the folder itself cannot be read.
[[nodiscard]] ClassResults readClassResults(const std::filesystem::path& folder);

/// The tasks of the folder with what was read there, so that no file is read again.
[[nodiscard]] ClassRun runOf(const std::vector<Task>& tasks, const std::filesystem::path& folder,
                             const ClassResults& read);

/// Those results for the people of a grade book: a result that a group handed in counts for each of its
/// members, one that a later one replaced for nobody, and that of a stranger not at all. Points of checks are
/// those after adjustments by people, rounded; changes of final points and lateness are left out, and so are
/// parts that do not count.
[[nodiscard]] ClassResults resultsByPerson(const ClassResults& read, const Gradebook& book);

struct CheckStatistics {
  std::string id{};
  std::string part{};
  std::string title{};
  grading::Group group = grading::Group::kVisible;
  int failed = 0;                        ///< number of students who did not pass it fully
  std::map<std::string, int> classes{};  ///< how many of them by class: "compile", "crash", "timeout", ...
  /// How many of them were asked what: "Is S never moved?"
  std::map<std::string, int> questions{};
  /// The correlation, over graded results, of the points of this check with those of all others: near 1, it
  /// separates those who master the exercise from those who do not; near 0 or below, it measures something
  /// else. Nothing if either number is the same for all.
  std::optional<double> discrimination{};
};

struct PartStatistics {
  std::string id{};
  int maxPoints = 0;
  double meanPoints = 0;
  int full = 0;            ///< number of students with all of them
  int timed = 0;           ///< number of students who say after how much work it first passed
  double medianHours = 0;  ///< of those
};

/// The student with full points who handed in first, by the times that are known.
struct FirstFull {
  std::string student{};
  std::int64_t submitted = 0;  ///< seconds since 1970 in UTC
  std::string timeFrom{};
};

/// How often students handed in, over those of whom it is known.
struct AttemptStatistics {
  int known = 0;    ///< number of students
  int atLeast = 0;  ///< how many of them by imports, which may have missed some
  double median = 0;
  int most = 0;
  std::string mostBy{};
};

/// How long those worked who handed it in with `rex submit --progress`.
struct WorkStatistics {
  int known = 0;  ///< number of students
  double medianHours = 0;
};

/// From full points down to none: full, at least 75 %, 50 %, 25 %, less, none.
inline constexpr std::array<const char*, 6> kDistribution = {"full", "75 %", "50 %", "25 %", "less", "none"};

/// Statistics of one exercise. Means and medians are over graded results; grader errors are not grades.
struct ExerciseStatistics {
  std::string exercise{};
  int graded = 0;
  int full = 0;
  int graderFailed = 0;
  int versions = 0;  ///< of the exercise among the results: points of different ones are not comparable
  int maxPoints = 0;
  double meanPoints = 0;
  double medianPoints = 0;
  std::array<int, kDistribution.size()> distribution{};
  double medianSeconds = 0;  ///< wall time of the checks of a file that compiles
  double longestSeconds = 0;
  std::string slowest{};                 ///< the student with the longest time
  std::optional<FirstFull> firstFull{};  ///< empty: nobody, or the times are unknown
  AttemptStatistics attempts{};
  WorkStatistics work{};
  std::vector<CheckStatistics> checks{};  ///< most failed first, then in the order of the results
  std::vector<PartStatistics> parts{};    ///< in the order of the results
};

[[nodiscard]] std::vector<ExerciseStatistics> exerciseStatistics(const std::vector<StudentResult>& results);

/// "compile", "crash", "timeout", "memory", "output", "protocol", "security", "non-finite", "shape",
/// "wrong" or "not run", for a check that did not pass.
[[nodiscard]] std::string failureClass(const grading::CheckResult& check, const grading::GradeResult& whole);

/// The question at the end of a message, after the input: "Is S never moved?"; empty if there is none.
[[nodiscard]] std::string askedQuestion(const std::string& message);

/// The median; for an even count the mean of the middle two; 0 if empty.
[[nodiscard]] double medianValue(std::vector<double> values);

}  // namespace rex::classroom
