#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "classroom/adjustments.h"
#include "classroom/course_file.h"
#include "classroom/import_table.h"
#include "classroom/stored_result.h"
#include "classroom/submission_folder.h"
#include "classroom/task_list.h"
#include "grading/results.h"
#include "reports/report.h"

namespace rex::classroom {

/// What became of one exercise of one student.
enum class RowStatus {
  kGraded,
  kLate,      ///< graded, with a penalty or without
  kMissing,   ///< nothing was handed in
  kRejected,  ///< something was handed in that could not be taken as it is
  kToRepeat   ///< there is no valid result: to be graded, again or at all
};
[[nodiscard]] std::string_view toString(RowStatus status);

/// An adjustment as it was applied, in hundredths of points.
struct AppliedAdjustment {
  Adjustment adjustment{};
  std::int64_t before = 0, after = 0;
  std::string target{};  ///< for students: "Check hand", "Hidden check 2", "Total"
};

/// One line of the grade book. Points are in hundredths.
struct GradeRow {
  CourseStudent student{};
  std::string exercise{};
  RowStatus status = RowStatus::kMissing;
  std::string remark{};                          ///< why it was not taken, who else handed it in
  std::optional<std::size_t> task{};             ///< the index of what counts
  std::string handedInAs{};                      ///< the folder of it, which may be that of another member
  std::optional<grading::GradeResult> result{};  ///< as graded, without adjustments
  CourseExercise worth{};                        ///< what the course makes of the exercise
  int score = 0;                                 ///< of the result, in the parts that count
  std::vector<AppliedAdjustment> applied{};      ///< in order: checks, then the final points
  std::vector<Comment> comments{};               ///< by line
  std::int64_t points = 0;                       ///< after adjustments of checks, before lateness
  std::int64_t possible = 0;                     ///< in the parts that count
  Lateness late{};
  std::optional<std::int64_t> deadline{};  ///< with extension
  bool isExtended = false;
  std::int64_t graceSeconds = 0;
  std::string timeZone{};               ///< of the course, for people; empty: UTC
  std::optional<std::int64_t> final{};  ///< empty: no grade
  std::int64_t submitted = 0;
  std::string timeFrom{};

  /// Whether the final points reach the minimum; also without one.
  [[nodiscard]] bool reachesMinimum() const;
};

struct StudentTotal {
  CourseStudent student{};
  std::optional<std::int64_t> total{};  ///< with weights; empty while a grading must be repeated
  std::int64_t possible = 0;            ///< without bonus exercises and those that are left out
  std::vector<std::string> leftOut{};   ///< exercises beyond the best ones that count
  std::optional<bool> passes{};         ///< so far; empty without a total and without rules
  std::vector<std::string> why{};       ///< a phrase for each rule that is not met
};

/// The grades of a class.
struct Gradebook {
  bool hasRoster = false;
  bool hasBest = false, hasPassRules = false;  ///< whether totals leave exercises out, and say who passes
  std::vector<std::string> exercises{};        ///< those that count
  std::vector<GradeRow> rows{};                ///< by student, then by exercise
  std::vector<GradeRow> strangers{};           ///< what people handed in who are not on the roster
  std::vector<StudentTotal> totals{};          ///< by student
  std::vector<std::string> notes{};            ///< for the reader of the grades
  int conflicts = 0;                           ///< between tutors, which are among the notes
  /// The row of that student and exercise; none: nullptr.
  [[nodiscard]] const GradeRow* row(const std::string& student, const std::string& exercise) const;
  /// A course with its students and nothing else, to find people of a platform in it.
  [[nodiscard]] Course everyone() const;
};

/// What grade books are made of, besides results.
struct GradebookSource {
  Course course{};  ///< without students: everybody who handed something in
  Adjustments adjustments{};
  ImportTable imported{};
  std::vector<RejectedSubmission> rejected{};
  std::map<std::string, int>
      points{};        ///< of the parts of each exercise that count, for rows without a result
  std::string only{};  ///< exercise; empty: all
};

/// Everyone on the roster gets a row for each exercise of the course that was graded. If a student and the
/// members of the student's group handed in several, the last one counts for all. Throws Error for
/// adjustments and comments that do not fit what was graded.
[[nodiscard]] Gradebook makeGradebook(const ClassRun& run, const GradebookSource& source);

/// The course, with everybody who handed something in if it has no roster. Names and e-mails that the
/// roster lacks come from the platforms.
[[nodiscard]] Course withStudents(Course course, const std::vector<Task>& tasks, const ImportTable& imported);

/// grades.csv with a roster, or the people who are not on it.
[[nodiscard]] std::string gradesCsv(const std::vector<GradeRow>& rows);
/// A line per student, a column per exercise, and the weighted total; by the rules of the course, what is
/// left out and who passes.
[[nodiscard]] std::string totalsCsv(const Gradebook& book);

/// For reports of this result. Empty if there is no grade.
[[nodiscard]] std::optional<reports::Judgement> rowJudgement(const GradeRow& row);
/// How the grade came about, a line each, for those who grade.
[[nodiscard]] std::vector<std::string> explain(const GradeRow& row);

/// The row of a task: that of the student who handed it in, else of a member of the group. Empty: a later
/// submission counts instead.
[[nodiscard]] const GradeRow* rowOfTask(const Gradebook& book, std::size_t task);

/// What a report of that task says: the grade of all who handed it in, by their names. If a later submission
/// counts instead, it is the grade for that one, and the report says so. Empty if there is no grade.
[[nodiscard]] std::optional<reports::Judgement> taskJudgement(const Gradebook& book,
                                                              const std::vector<Task>& tasks,
                                                              std::size_t task);

/// What a grading could not take, kept beside its results for `rex grade --collect`.
[[nodiscard]] std::string rejectedText(const std::vector<RejectedSubmission>& all);
/// Reads that file; empty if there is none. Throws Error with the line if it is malformed.
[[nodiscard]] std::vector<RejectedSubmission> readRejected(const std::filesystem::path& file);

}  // namespace rex::classroom
