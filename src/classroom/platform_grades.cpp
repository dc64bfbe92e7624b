#include "classroom/platform_grades.h"

#include <fmt/format.h>

#include "classroom/csv.h"

namespace rex::grading {
namespace {

std::string finalText(const GradeRow* row) {
  return row != nullptr && row->final ? hundredthsText(*row->final) : "";
}

// What students have gets a number; what they lack stays empty, and is told.
void tellEmpty(const Gradebook& book, PlatformGrades& grades) {
  for (const GradeRow& row : book.rows)
    if (row.status == RowStatus::kToRepeat)
      grades.notes.push_back(
          fmt::format("{} {}: no grade yet ({})", row.student.id, row.exercise, row.remark));
}

std::string sisOf(const CourseStudent& student) {
  return student.number.empty() ? student.id : student.number;
}

std::int64_t possibleOf(const Gradebook& book, const std::string& exercise) {
  for (const GradeRow& row : book.rows)
    if (row.exercise == exercise) return row.possible;
  return 0;
}

}  // namespace

PlatformGrades gradescopeGrades(const Gradebook& book) {
  std::vector<std::string> headings = {"Name", "SID", "Email"};
  headings.insert(headings.end(), book.exercises.begin(), book.exercises.end());
  headings.emplace_back("Total Score");
  headings.emplace_back("Max Points");
  PlatformGrades grades{.csv = csvLine(headings)};
  for (const StudentTotal& sum : book.totals) {
    std::vector<std::string> cells = {shownName(sum.student), sisOf(sum.student), sum.student.email};
    for (const std::string& exercise : book.exercises)
      cells.push_back(finalText(book.row(sum.student.id, exercise)));
    cells.push_back(sum.total ? hundredthsText(*sum.total) : "");
    cells.push_back(hundredthsText(sum.possible));
    grades.csv += csvLine(cells);
  }
  tellEmpty(book, grades);
  return grades;
}

// The first blanks of the row of possible points are Canvas's own.
PlatformGrades canvasGrades(const Gradebook& book) {
  std::vector<std::string> headings = {"Student", "ID", "SIS User ID", "SIS Login ID", "Section"},
                           possible = {"    Points Possible", "", "", "", ""};
  for (const std::string& exercise : book.exercises) {
    headings.push_back(exercise);
    possible.push_back(hundredthsText(possibleOf(book, exercise)));
  }
  PlatformGrades grades{.csv = csvLine(headings) + csvLine(possible)};
  for (const StudentTotal& sum : book.totals) {
    std::vector<std::string> cells = {shownName(sum.student), "", sisOf(sum.student), sum.student.id,
                                      sum.student.section};
    for (const std::string& exercise : book.exercises)
      cells.push_back(finalText(book.row(sum.student.id, exercise)));
    grades.csv += csvLine(cells);
  }
  tellEmpty(book, grades);
  return grades;
}

}  // namespace rex::grading
