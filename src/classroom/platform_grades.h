#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "classroom/gradebook.h"

namespace rex::classroom {

/// A table of grades in the columns of a platform, and what its reader should know.
struct PlatformGrades {
  std::string csv{};
  std::vector<std::string> notes{};
};

/// For Gradescope and other programs that know people by SID or e-mail: a column per exercise and a total.
[[nodiscard]] PlatformGrades gradescopeGrades(const Gradebook& book);

/// For the import of Canvas: a column per exercise, with the row of possible points.
[[nodiscard]] PlatformGrades canvasGrades(const Gradebook& book);

/// Says that a grade has more points than a platform has as the maximum, for the reader of a table of grades.
[[nodiscard]] std::string aboveMaximum(const GradeRow& row, std::int64_t points, std::int64_t most);

/// A student of Moodle's grading worksheet.
struct WorksheetRow {
  std::string student{};  ///< id in the book; empty: nobody
  std::string name{};
  std::string number{};  ///< of "Participant 501"
};

/// A grading worksheet of Moodle with its grades filled in; all other cells stay as they were.
struct Worksheet {
  std::string csv{};
  std::vector<WorksheetRow> rows{};
  std::vector<std::string> notes{};
};

/// Completes a worksheet that was downloaded. Students are found by what the import knows of this exercise,
/// by e-mail, by number or by a name that only one has. `scale`: to its maximum grade, if that is another
/// than the points that are possible. Throws Error, with the line, if the columns Identifier and Grade are
/// missing, for two rows of one student, if the maximum is another and `scale` is not set, and if it is set
/// and there is none.
[[nodiscard]] Worksheet moodleGrades(const std::filesystem::path& worksheet, const Gradebook& book,
                                     const std::string& exercise, const ImportTable& imported, bool scale);

/// Those of whom an import of this exercise knows the number in Moodle.
[[nodiscard]] std::vector<WorksheetRow> moodleStudents(const Gradebook& book, const std::string& exercise,
                                                       const ImportTable& imported);

/// "Zoe Müller_501_assignsubmission_file_", as Moodle's reader of feedback zips takes it apart.
[[nodiscard]] std::string moodleFolder(const WorksheetRow& row);

}  // namespace rex::classroom
