#include "cli/instructor/class_grades.h"

#include <algorithm>
#include <cstdio>
#include <map>

#include <fmt/format.h>

#include "base/error.h"
#include "base/text_file.h"
#include "cli/instructor/collect.h"
#include "cli/terminal.h"

namespace rex::cli {

namespace fs = std::filesystem;

grading::Course courseOf(const Project& project, const ClassFiles& files) {
  if (!files.course.empty()) return grading::readCourse(files.course, project.exercises());
  return {.policy = readDeadlines(project, files.deadlines)};
}

grading::Gradebook gradebookOf(const Project& project, const ClassFiles& files,
                               const std::vector<grading::Task>& tasks, const fs::path& out,
                               const std::string& only) {
  grading::GradebookSource source{.tasks = tasks, .out = out, .only = only};
  source.course = courseOf(project, files);
  source.imported = grading::importTableIn(out);
  source.notTaken = grading::readNotTaken(out / kNotTakenFile);
  for (const ExerciseInfo& exercise : project.exercises()) source.points[exercise.name] = exercise.points();
  const fs::path adjustments = files.adjustments.empty() ? source.course.adjustments : files.adjustments;
  if (!adjustments.empty())
    source.adjustments = grading::readAdjustments(
        adjustments, grading::withStudents(source.course, tasks, source.imported), project.exercises());
  return grading::makeGradebook(source);
}

void writeBook(const grading::Gradebook& book, const fs::path& out, bool print) {
  const std::string text = grading::gradesCsv(book.rows);
  replaceTextFile(out / "grades.csv", text, "the table of grades");
  replaceTextFile(out / kTotals, grading::totalsCsv(book), "the table of totals");
  if (book.strangers.empty())
    fs::remove(out / kStrangers);
  else
    replaceTextFile(out / kStrangers, grading::gradesCsv(book.strangers), "the table of strangers");
  if (print) std::fputs(text.c_str(), stdout);
  for (const std::string& sentence : book.notes) note(wrap(harmless(sentence), 2, 0));
  for (const grading::GradeRow& row : book.strangers)
    note(wrap(harmless(fmt::format("'{}' is not on the roster: {} is graded and listed in {}", row.student.id,
                                   row.exercise, kStrangers)),
              2, 0));
  std::map<std::string_view, int> counts;
  for (const grading::GradeRow& row : book.rows) ++counts[toString(row.status)];
  std::vector<std::string> parts;
  for (const auto& [status, count] : counts) parts.push_back(fmt::format("{} {}", count, status));
  note(fmt::format("{} students: {}", book.totals.size(), fmt::join(parts, ", ")));
}

void explainGrade(const grading::Gradebook& book, const Project& project, const std::string& student,
                  const std::string& exercise) {
  const std::string name = project.exercise(exercise).name;
  std::vector<std::string> known;
  for (const auto* rows : {&book.rows, &book.strangers})
    for (const grading::GradeRow& row : *rows) {
      known.push_back(row.student.id);
      if (row.student.id != student || row.exercise != name) continue;
      for (const std::string& line : grading::explain(row)) say(wrap(harmless(line), 2, 0));
      return;
    }
  throw UsageError({.what = fmt::format("no grade of '{}' for {}", student, name),
                    .wanted = "the id of a student, and an exercise that was graded",
                    .nearest = nearestNames(student, known)});
}

}  // namespace rex::cli
