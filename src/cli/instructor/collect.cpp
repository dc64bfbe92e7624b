#include "cli/instructor/collect.h"

#include <algorithm>
#include <cstdio>
#include <string>

#include <fmt/format.h>

#include "base/error.h"
#include "base/text.h"
#include "base/text_file.h"
#include "classroom/csv.h"
#include "classroom/grade_task.h"
#include "cli/instructor/class_grades.h"
#include "cli/json_internal.h"
#include "cli/report_format.h"
#include "cli/terminal.h"
#include "grading/results.h"

namespace rex::cli {

namespace {

using classroom::Task;
using classroom::TaskState;

const char* toString(TaskState state) {
  switch (state) {
    case TaskState::kMissing:
      return "missing";
    case TaskState::kStale:
      return "stale";
    case TaskState::kFailed:
      return "failed";
    case TaskState::kRefused:
      return "refused";
    case TaskState::kDone:
      return "graded";
  }
  return "";
}

Json optionalJson(const std::optional<int>& number) { return number ? Json(*number) : Json(); }

Json statesJson(const std::vector<Task>& tasks, const std::filesystem::path& out) {
  Json list = Json::array();
  bool isComplete = true;
  for (std::size_t k = 0; k < tasks.size(); ++k) {
    const Task& task = tasks[k];
    const TaskState state = classroom::taskState(task, out);
    isComplete = isComplete && state == TaskState::kDone;
    std::optional<int> points, possible;
    if (state == TaskState::kDone) {
      const grading::GradeResult result =
          grading::loadResult(classroom::resultFolder(out, task) / "results.json");
      points = result.score, possible = result.maxScore;
    }
    list.push_back(
        {{"task", k + 1},
         {"student", task.student},
         {"exercise", task.exercise},
         {"state", toString(state)},
         {"points", optionalJson(points)},
         {"possible", optionalJson(possible)},
         {"waiting",
          classroom::isHeldBack(task, out) ? optionalJson(classroom::pointsNow(task, out)) : Json()}});
  }
  return {{"tasks", list}, {"complete", isComplete}, {"table", (out / "grades.csv").string()}};
}

}  // namespace

std::string collectJson(const std::vector<Task>& tasks, const std::filesystem::path& out) {
  return dump(statesJson(tasks, out));
}

std::string gradingJson(const std::vector<Task>& tasks, const std::filesystem::path& out,
                        const GradingSummary& summary) {
  Json json = statesJson(tasks, out);
  json["level"] = summary.level;
  json["graded"] = summary.graded;
  json["kept"] = static_cast<int>(tasks.size()) - summary.graded;
  json["not_taken"] = summary.rejected;
  json["blocked"] = summary.blocked;
  return dump(json);
}

namespace {

void tell(const std::string& what, const std::vector<int>& numbers, const std::vector<Task>& tasks) {
  if (numbers.empty()) return;
  constexpr std::size_t kMostNamed = 10;
  note(fmt::format("{}: tasks {}", what, classroom::numberRanges(numbers)));
  for (std::size_t k = 0; k < std::min(numbers.size(), kMostNamed); ++k) {
    const Task& task = tasks[static_cast<std::size_t>(numbers[k]) - 1];
    note(fmt::format("  {} {}", task.student, task.exercise));
  }
  if (numbers.size() > kMostNamed) note(fmt::format("  and {} more", numbers.size() - kMostNamed));
}

// Says of each refused result which file, what was found and what was wanted.
void tellRefused(const std::vector<int>& numbers, const std::vector<Task>& tasks,
                 const std::filesystem::path& out) {
  for (const int number : numbers)
    note(wrap(escapeForTerminal(classroom::whyRefused(tasks[static_cast<std::size_t>(number) - 1], out)), 2,
              0));
}

// An incomplete file left by an earlier run does not count, as its text differs.
bool holds(const std::filesystem::path& file, const std::string& text) {
  return std::filesystem::exists(file) && readTextFile(file) == text;
}

}  // namespace

ExitCode collectResults(const Project& project, const CollectOptions& options) {
  const std::vector<Task> tasks = tasksIn(options.out, options.manifest);
  const classroom::GradebookSource source = readGradebookSource(project, options.files, tasks, options.out);
  const ExitCode roster = tellRoster(source.course);
  const classroom::Gradebook book = classroom::makeGradebook(source);
  writeReports(tasks, options.out, parseReportFormats(options.reports), book);
  const bool complete = writeGrades(tasks, options.out, readDeadlines(project, options.files.deadlines),
                                    options.files.hasBook() ? &book : nullptr, options.csv);
  const int held = tellHeldBack(tasks, options.out);
  if (options.json) say(collectJson(tasks, options.out));
  note(fmt::format("{} tasks. Table: {}", tasks.size(), shown(options.out / "grades.csv")));
  if (!complete) return ExitCode::kGraderFault;
  return held > 0 ? ExitCode::kBelow : roster;
}

void writeReports(const std::vector<Task>& tasks, const std::filesystem::path& out,
                  const std::vector<reports::ReportFormat>& reports, const classroom::Gradebook& book) {
  int written = 0, kept = 0;
  for (std::size_t k = 0; k < tasks.size(); ++k) {
    const Task& task = tasks[k];
    const auto judgement = taskJudgement(book, tasks, k);
    const std::filesystem::path folder = classroom::resultFolder(out, task);
    const classroom::TaskState state = classroom::taskState(task, out);
    if (state != classroom::TaskState::kDone && state != classroom::TaskState::kFailed) {
      classroom::removeReports(folder);
      continue;
    }
    for (const reports::ReportFormat& format : reports::reportFormats()) {
      const std::filesystem::path file = folder / format.file;
      if (!contains(reports, format) && !std::filesystem::exists(file)) continue;
      const std::string text =
          format.write(grading::loadResult(folder / "results.json"), judgement ? &*judgement : nullptr);
      const bool isThere = holds(file, text);
      if (!isThere) replaceTextFile(file, text, "the report");
      if (!isThere) ++written;
      if (isThere && contains(reports, format)) ++kept;
    }
  }
  if (!reports.empty() || written > 0) note(fmt::format("Reports: {} written, {} kept", written, kept));
}

classroom::LatePolicy readDeadlines(const Project& project, const std::filesystem::path& file) {
  if (file.empty()) return {};
  std::vector<std::string> names;
  for (const ExerciseInfo& exercise : project.exercises()) names.push_back(exercise.name);
  return classroom::readLatePolicy(file, names);
}

bool writeGrades(const std::vector<Task>& tasks, const std::filesystem::path& out,
                 const classroom::LatePolicy& policy, const classroom::Gradebook* book, bool print) {
  std::vector<std::string> students;
  for (const Task& task : tasks) students.push_back(task.student);
  if (book != nullptr) writeBook(*book, out, print);
  for (const std::string& sentence : classroom::unknownExtensions(policy, students))
    note(wrap(escapeForTerminal(sentence), 2, 0));
  const classroom::Collected found = classroom::collect(tasks, out, policy);
  if (book == nullptr) {
    replaceTextFile(out / "grades.csv", found.csv, "the table of grades");
    for (const char* other : {kTotals, kStrangers}) std::filesystem::remove(out / other);
    if (print) std::fputs(found.csv.c_str(), stdout);
  }
  tell("no result", found.missing, tasks);
  tell("a result for other inputs", found.stale, tasks);
  tell("a result that was changed after the grading", found.refused, tasks);
  tellRefused(found.refused, tasks, out);
  tell("the grader failed", found.failed, tasks);
  std::vector<int> again = found.missing;
  again.insert(again.end(), found.stale.begin(), found.stale.end());
  again.insert(again.end(), found.refused.begin(), found.refused.end());
  again.insert(again.end(), found.failed.begin(), found.failed.end());
  if (again.empty()) return true;
  note(fmt::format("To repeat: {}", classroom::numberRanges(again)));
  return false;
}

int tellHeldBack(const std::vector<Task>& tasks, const std::filesystem::path& out) {
  std::vector<int> held;
  for (std::size_t k = 0; k < tasks.size(); ++k)
    if (classroom::isHeldBack(tasks[k], out)) held.push_back(static_cast<int>(k) + 1);
  tell("fewer points than before wait for `rex grade --accept`", held, tasks);
  return static_cast<int>(held.size());
}

namespace {

constexpr const char* kNotesOfRegrading = "regrading.tsv";

std::string keyOf(const Task& task) {
  return fmt::format("{}\t{}\t{}", task.student, task.exercise, task.sourceSha256);
}

}  // namespace

Regrading::Regrading(const std::vector<Task>& tasks, const std::filesystem::path& out,
                     const std::function<bool(const Task&)>& isOpen, bool accept)
    : tasks_(tasks), out_(out) {
  readNotes();
  for (const Task& task : tasks) {
    const auto noted = noted_.find(keyOf(task));
    const bool isOld = noted != noted_.end(), isHeld = classroom::isHeldBack(task, out_),
               isAgain = isOld || isOpen(task);
    before_.push_back(isOld               ? std::optional<int>(noted->second)
                      : isAgain || isHeld ? classroom::pointsBefore(task, out_)
                                          : std::nullopt);
    isNew_ = isNew_ || (before_.back() && (isAgain || accept));
  }
  writeNotes();
  if (!accept) return;
  for (const Task& task : tasks) classroom::acceptRegrading(task, out_);
}

void Regrading::readNotes() {
  const std::filesystem::path file = out_ / kNotesOfRegrading;
  if (!std::filesystem::exists(file)) return;
  const std::string text = readTextFile(file);
  int number = 0;
  for (const std::string_view line : splitLines(text)) {
    ++number;
    const std::size_t tab = std::min(line.rfind('\t'), line.size());
    const std::optional<int> points = parseNumber<int>(line.substr(std::min(tab + 1, line.size())));
    if (!points)
      throw Error({.what = "not the notes of a regrading",
                   .where = {file.string(), number, 0},
                   .wanted = "those of an interrupted `rex grade`; without this file, it starts again"});
    noted_[std::string(line.substr(0, tab))] = *points;
  }
}

void Regrading::writeNotes() const {
  std::string text;
  for (std::size_t k = 0; k < tasks_.size(); ++k)
    if (before_[k]) text += fmt::format("{}\t{}\n", keyOf(tasks_[k]), *before_[k]);
  if (!text.empty()) replaceTextFile(out_ / kNotesOfRegrading, text, "the notes of a regrading");
}

void Regrading::tell() const {
  constexpr int kMostTold = 20;
  std::string table = classroom::csvLine({"student", "exercise", "before", "after", "counts"});
  int changed = 0, same = 0;
  for (std::size_t k = 0; k < tasks_.size(); ++k) {
    const Task& task = tasks_[k];
    const std::optional<int> after = classroom::pointsNow(task, out_);
    if (!before_[k] || !after) continue;
    const bool isHeld = classroom::isHeldBack(task, out_);
    table += classroom::csvLine({task.student, task.exercise, fmt::format("{}", *before_[k]),
                                 fmt::format("{}", *after), isHeld ? "before" : "after"});
    if (*before_[k] == *after) {
      ++same;
    } else if (++changed <= kMostTold) {
      note(wrap(escapeForTerminal(fmt::format("{} {}: {} points, {} before{}", task.student, task.exercise,
                                              *after, *before_[k],
                                              isHeld ? "; the points from before count until --accept" : "")),
                2, 0));
    }
  }
  if (isNew_ && changed + same > 0) {
    replaceTextFile(out_ / kRegradedFile, table, "the table of regradings");
    note(fmt::format("Graded again: {} with other points, {} with the same. Table: {}", changed, same,
                     shown(out_ / kRegradedFile)));
  }
  std::filesystem::remove(out_ / kNotesOfRegrading);
}

}  // namespace rex::cli
