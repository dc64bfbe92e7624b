#include "cli/instructor/class_grades.h"

#include <algorithm>
#include <cstdio>
#include <map>

#include <fmt/format.h>

#include "base/error.h"
#include "base/is_below.h"
#include "base/join.h"
#include "base/text_file.h"
#include "cli/instructor/collect.h"
#include "cli/json_internal.h"
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
  note(fmt::format("{} students: {}", book.totals.size(), join(parts, ", ")));
}

ExitCode explainResults(const Project& project, const ExplainOptions& options) {
  const std::string name = project.exercise(options.exercise).name;
  const grading::Gradebook book =
      gradebookOf(project, options.files, tasksIn(options.out, options.manifest), options.out);
  std::vector<std::string> known;
  for (const auto* rows : {&book.rows, &book.strangers})
    for (const grading::GradeRow& row : *rows) {
      known.push_back(row.student.id);
      if (row.student.id != options.student || row.exercise != name) continue;
      const std::vector<std::string> lines = grading::explain(row);
      if (options.json)
        say(dump(Json{{"student", options.student}, {"exercise", name}, {"lines", lines}}));
      else
        for (const std::string& line : lines) say(wrap(harmless(line), 2, 0));
      return ExitCode::kFull;
    }
  throw UsageError({.what = fmt::format("no grade of '{}' for {}", options.student, name),
                    .wanted = "the id of a student, and an exercise that was graded",
                    .nearest = nearestNames(options.student, known)});
}

void requireApart(const std::string& option, const fs::path& folder, const fs::path& other) {
  const fs::path here = fs::weakly_canonical(folder), there = fs::weakly_canonical(other);
  if (isBelow(here, there) || isBelow(there, here))
    throw UsageError(
        {.what = option, .found = here.string(), .wanted = "a folder apart from " + there.string()});
}

void requireFolder(const fs::path& folder, const std::string& wanted) {
  if (fs::is_directory(folder)) return;
  const fs::path whole = fs::absolute(folder).lexically_normal(),
                 path = whole.has_filename() ? whole : whole.parent_path();
  std::vector<std::string> beside;
  std::error_code failure;
  for (fs::directory_iterator entry(path.parent_path(), failure), end; !failure && entry != end;
       entry.increment(failure))
    if (entry->is_directory(failure)) beside.push_back(entry->path().filename().string());
  throw UsageError({.what = fs::exists(folder) ? "not a folder" : "no such folder",
                    .where = {folder.string()},
                    .wanted = wanted,
                    .nearest = nearestNames(path.filename().string(), beside)});
}

std::vector<grading::Task> tasksIn(const fs::path& results, const fs::path& manifest) {
  requireFolder(results, "the folder of results that rex grade wrote");
  const fs::path file = manifest.empty() ? results / "tasks.tsv" : manifest;
  if (manifest.empty() && !fs::is_regular_file(file))
    throw UsageError({.what = "no folder of results",
                      .where = {results.string()},
                      .wanted = "the one that rex grade wrote, with tasks.tsv"});
  if (!fs::is_regular_file(file))
    throw UsageError({.what = "no such list of tasks",
                      .where = {file.string()},
                      .wanted = "one that rex grade --manifest wrote"});
  return grading::readManifest(file);
}

}  // namespace rex::cli
