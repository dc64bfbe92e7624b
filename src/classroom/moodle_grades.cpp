#include <algorithm>
#include <map>

#include <fmt/format.h>

#include "base/error.h"
#include "base/printable.h"
#include "base/text.h"
#include "classroom/csv.h"
#include "classroom/moodle_worksheet_internal.h"
#include "classroom/platform_grades.h"
#include "classroom/submission_owners.h"

namespace rex::grading {
namespace {

/// Completes one worksheet.
class WorksheetWriter {
 public:
  WorksheetWriter(const std::filesystem::path& file, const Gradebook& book, const std::string& exercise,
                  const ImportTable& imported, bool scale)
      : file_(file.string()),
        table_(file, "a grading worksheet of Moodle"),
        book_(book),
        exercise_(exercise),
        everyone_(book.everyone()),
        scale_(scale) {
    for (const ImportedStudent& person : imported.students)
      if (const auto entry = person.exercises.find(exercise); entry != person.exercises.end())
        if (const std::string id = studentOf(person, everyone_);
            !id.empty() && !entry->second.identifier.empty())
          known_[entry->second.identifier] = id;
  }

  Worksheet write() {
    table_.require(kMoodleIdentifier), table_.require(kMoodleGrade);
    table_.requireWholeRows();
    for (std::size_t row = 0; row < table_.size(); ++row) complete(row);
    tellAbsent();
    sheet_.csv = table_.csv();
    return std::move(sheet_);
  }

 private:
  std::string studentIn(std::size_t row) const {
    if (const auto found = known_.find(table_.text(row, kMoodleIdentifier)); found != known_.end())
      return found->second;
    return studentOf({.id = table_.text(row, kMoodleIdNumber),
                      .name = table_.text(row, kMoodleName),
                      .email = table_.text(row, kMoodleEmail)},
                     everyone_);
  }

  void complete(std::size_t row) {
    const std::string id = studentIn(row), name = table_.text(row, kMoodleName);
    sheet_.rows.push_back({id, name, participantNumber(table_.text(row, kMoodleIdentifier))});
    if (id.empty()) {
      sheet_.notes.push_back(fmt::format("{}: '{}' is nobody here; the grade stays as it is",
                                         table_.place(row), printable(name)));
      return;
    }
    if (const auto [first, isNew] = seen_.emplace(id, table_.place(row)); !isNew)
      throw Error({.what = fmt::format("a second row for '{}'", id),
                   .where = {table_.place(row)},
                   .wanted = fmt::format("one; the first is at {}", first->second)});
    const GradeRow* graded = book_.row(id, exercise_);
    if (graded == nullptr || !graded->final) return;
    table_.set(row, kMoodleGrade, hundredthsText(scaled(*graded, row)));
  }

  std::int64_t scaled(const GradeRow& graded, std::size_t row) const {
    const std::string shown = table_.text(row, kMoodleMaximum);
    std::string text = shown;
    std::replace(text.begin(), text.end(), ',', '.');
    const std::optional<double> maximum = parseNumber<double>(text);
    const auto refuse = [&](const std::string& found, const std::string& wanted) {
      throw Error({.what = fmt::format("the maximum grade of {} in Moodle", exercise_),
                   .where = {table_.place(row)},
                   .found = found,
                   .wanted = wanted});
    };
    if (!maximum && scale_) refuse(text.empty() ? "none" : shown, "a number, to scale the points to it");
    const auto most = static_cast<std::int64_t>(100 * maximum.value_or(0) + 0.5);
    if (!maximum || most == graded.possible) return *graded.final;
    if (!scale_ || graded.possible == 0)
      refuse(shown,
             fmt::format("{}, the points of the exercise, or --scale", hundredthsText(graded.possible)));
    return (*graded.final * most + graded.possible / 2) / graded.possible;
  }

  void tellAbsent() {
    for (const GradeRow& row : book_.rows)
      if (row.exercise == exercise_ && row.final && !seen_.contains(row.student.id))
        sheet_.notes.push_back(fmt::format("'{}' has a grade and no row in {}", row.student.id, file_));
  }

  std::string file_;
  CsvTable table_;
  const Gradebook& book_;
  std::string exercise_;
  Course everyone_;
  bool scale_;
  std::map<std::string, std::string> known_{};  // by identifier: id
  std::map<std::string, std::string> seen_{};   // by id: place
  Worksheet sheet_{};
};

}  // namespace

Worksheet moodleGrades(const std::filesystem::path& worksheet, const Gradebook& book,
                       const std::string& exercise, const ImportTable& imported, bool scale) {
  return WorksheetWriter(worksheet, book, exercise, imported, scale).write();
}

std::vector<WorksheetRow> moodleStudents(const Gradebook& book, const std::string& exercise,
                                         const ImportTable& imported) {
  const Course everyone = book.everyone();
  std::vector<WorksheetRow> rows;
  for (const ImportedStudent& person : imported.students) {
    const auto entry = person.exercises.find(exercise);
    const std::string id = studentOf(person, everyone);
    if (entry == person.exercises.end() || entry->second.platform != "moodle" || id.empty()) continue;
    if (const std::string number = participantNumber(entry->second.identifier); !number.empty())
      rows.push_back({id, person.name, number});
  }
  return rows;
}

// Moodle splits the name at underscores; slashes and dots at the start would be folders of their own.
std::string moodleFolder(const WorksheetRow& row) {
  std::string name = printable(row.name);
  for (char& c : name)
    if (std::string_view("_/\\:*?\"<>|\n\t").find(c) != std::string_view::npos) c = ' ';
  while (!name.empty() && (name.front() == '.' || name.front() == ' ' || name.front() == '~'))
    name.erase(0, 1);
  return fmt::format("{}_{}_assignsubmission_file_", name.empty() ? "Student" : name, row.number);
}

}  // namespace rex::grading
