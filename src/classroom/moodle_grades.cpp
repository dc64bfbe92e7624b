#include <algorithm>
#include <charconv>
#include <map>

#include <fmt/format.h>

#include "base/error.h"
#include "base/join.h"
#include "base/lower_case.h"
#include "base/printable.h"
#include "base/text_file.h"
#include "classroom/composed_text.h"
#include "classroom/csv.h"
#include "classroom/moodle_worksheet_internal.h"
#include "classroom/platform_grades.h"
#include "classroom/submission_owners.h"

namespace rex::grading {
namespace {

constexpr std::size_t kNoColumn = static_cast<std::size_t>(-1);

std::size_t columnOfAny(const CsvRow& headings, const MoodleHeadings& names) {
  for (const std::string& name : names)
    for (std::size_t k = 0; k < headings.fields.size(); ++k)
      if (caseless(headings.fields[k]) == caseless(name)) return k;
  return kNoColumn;
}

// Quoted where needed, else as it was: Moodle compares what it reads back.
std::string plainLine(const std::vector<std::string>& fields, const std::string& end) {
  std::string line;
  for (std::size_t k = 0; k < fields.size(); ++k) {
    if (k > 0) line += ',';
    if (fields[k].find_first_of(",\"\r\n ;\t") == std::string::npos) {
      line += fields[k];
      continue;
    }
    line += '"';
    for (const char c : fields[k]) line += c == '"' ? std::string("\"\"") : std::string(1, c);
    line += '"';
  }
  return line + end;
}

/// Completes one worksheet.
class WorksheetWriter {
 public:
  WorksheetWriter(const std::filesystem::path& file, const Gradebook& book, const std::string& exercise,
                  const ImportTable& imported, bool scale)
      : file_(file.string()),
        text_(readTextFile(file)),
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
    const std::vector<CsvRow> rows = parseCsv(text_, file_);
    const CsvRow headings = rows.empty() ? CsvRow{} : rows.front();
    findColumns(headings);
    const std::string end = text_.find("\r\n") == std::string::npos ? "\n" : "\r\n";
    const std::string mark = "\xef\xbb\xbf";
    sheet_.csv = (text_.starts_with(mark) ? mark : "") + plainLine(headings.fields, end);
    for (std::size_t k = 1; k < rows.size(); ++k) {
      CsvRow row = rows[k];
      if (row.fields.size() != headings.fields.size())
        throw Error({.what = "not a grading worksheet",
                     .where = {file_, row.line, 0},
                     .found = fmt::format("{} fields", row.fields.size()),
                     .wanted = fmt::format("{}", headings.fields.size())});
      complete(row);
      sheet_.csv += plainLine(row.fields, end);
    }
    tellAbsent();
    return std::move(sheet_);
  }

 private:
  void findColumns(const CsvRow& headings) {
    identifier_ = columnOfAny(headings, kMoodleIdentifier);
    grade_ = columnOfAny(headings, {"Grade", "Bewertung"});
    name_ = columnOfAny(headings, kMoodleName);
    email_ = columnOfAny(headings, kMoodleEmail);
    number_ = columnOfAny(headings, kMoodleIdNumber);
    maximum_ = columnOfAny(headings, kMoodleMaximum);
    if (identifier_ == kNoColumn || grade_ == kNoColumn)
      throw Error({.what = "not a grading worksheet of Moodle",
                   .where = {file_, 1, 0},
                   .found = fmt::format("the columns {}", join(headings.fields, ", ")),
                   .wanted = "Identifier and Grade"});
  }

  static std::string cell(const CsvRow& row, std::size_t column) {
    return column == kNoColumn ? "" : row.fields[column];
  }

  std::string studentIn(const CsvRow& row) const {
    if (const auto found = known_.find(cell(row, identifier_)); found != known_.end()) return found->second;
    return studentOf({.id = cell(row, number_), .name = cell(row, name_), .email = cell(row, email_)},
                     everyone_);
  }

  void complete(CsvRow& row) {
    const std::string id = studentIn(row), who = printable(cell(row, name_));
    sheet_.rows.push_back({id, cell(row, name_), participantNumber(cell(row, identifier_))});
    if (id.empty()) {
      sheet_.notes.push_back(
          fmt::format("{}:{}: '{}' is nobody here; the grade stays as it is", file_, row.line, who));
      return;
    }
    if (!seen_.emplace(id, row.line).second)
      throw Error({.what = fmt::format("a second row for '{}'", id),
                   .where = {file_, row.line, 0},
                   .wanted = fmt::format("one; the first is in line {}", seen_[id])});
    const GradeRow* graded = book_.row(id, exercise_);
    if (graded == nullptr || !graded->final) return;
    row.fields[grade_] = hundredthsText(scaled(*graded, row));
  }

  std::int64_t scaled(const GradeRow& graded, const CsvRow& row) const {
    std::string text = cell(row, maximum_);
    std::replace(text.begin(), text.end(), ',', '.');
    double maximum = 0;
    const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), maximum);
    const std::int64_t most = static_cast<std::int64_t>(100 * maximum + 0.5);
    const bool isNumber = failure == std::errc() && end == text.data() + text.size();
    if (!isNumber && scale_)
      throw Error({.what = fmt::format("the maximum grade of {} in Moodle", exercise_),
                   .where = {file_, row.line, 0},
                   .found = text.empty() ? "none" : text,
                   .wanted = "a number, to scale the points to it"});
    if (!isNumber || most == graded.possible) return *graded.final;
    if (!scale_ || graded.possible == 0)
      throw Error({.what = fmt::format("the maximum grade of {} in Moodle", exercise_),
                   .where = {file_, row.line, 0},
                   .found = cell(row, maximum_),
                   .wanted = fmt::format("{}, the points of the exercise, or --scale",
                                         hundredthsText(graded.possible))});
    return (*graded.final * most + graded.possible / 2) / graded.possible;
  }

  void tellAbsent() {
    for (const GradeRow& row : book_.rows)
      if (row.exercise == exercise_ && row.final && !seen_.contains(row.student.id))
        sheet_.notes.push_back(fmt::format("'{}' has a grade and no row in {}", row.student.id, file_));
  }

  std::string file_, text_;
  const Gradebook& book_;
  std::string exercise_;
  Course everyone_;
  bool scale_;
  std::map<std::string, std::string> known_{};  // by identifier: id
  std::map<std::string, int> seen_{};           // by id: line
  std::size_t identifier_ = kNoColumn, grade_ = kNoColumn, name_ = kNoColumn, email_ = kNoColumn,
              number_ = kNoColumn, maximum_ = kNoColumn;
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
