#include "cli/instructor/collect.h"

#include <algorithm>
#include <cstdio>
#include <string>

#include <fmt/format.h>

#include "base/error.h"
#include "base/instant.h"
#include "base/text.h"
#include "base/text_file.h"
#include "classroom/csv.h"
#include "cli/instructor/class_grades.h"
#include "cli/json_internal.h"
#include "cli/report_format.h"
#include "cli/terminal.h"
#include "grading/results.h"

namespace rex::cli {

namespace {

using classroom::ClassRun;
using classroom::StoredResult;
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

Json statesJson(const ClassRun& run) {
  Json list = Json::array();
  bool isComplete = true;
  for (std::size_t k = 0; k < run.tasks.size(); ++k) {
    const StoredResult& stored = run.stored[k];
    const bool isDone = stored.state == TaskState::kDone;
    isComplete = isComplete && isDone;
    list.push_back({{"task", k + 1},
                    {"student", run.tasks[k].student},
                    {"exercise", run.tasks[k].exercise},
                    {"state", toString(stored.state)},
                    {"points", isDone ? Json(stored.result->score) : Json()},
                    {"possible", isDone ? Json(stored.result->maxScore) : Json()},
                    {"waiting", stored.waiting ? Json(*stored.waiting) : Json()}});
  }
  return {{"tasks", list}, {"complete", isComplete}, {"table", (run.out / "grades.csv").string()}};
}

}  // namespace

std::string collectJson(const ClassRun& run) { return dump(statesJson(run)); }

std::string gradingJson(const ClassRun& run, const GradingSummary& summary) {
  Json json = statesJson(run);
  json["level"] = summary.level;
  json["graded"] = summary.graded;
  json["kept"] = static_cast<int>(run.tasks.size()) - summary.graded;
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

std::vector<int> numbersOf(const ClassRun& run, TaskState state) {
  std::vector<int> numbers;
  for (std::size_t k = 0; k < run.stored.size(); ++k)
    if (run.stored[k].state == state) numbers.push_back(static_cast<int>(k) + 1);
  return numbers;
}

std::vector<std::string> rowOf(const Task& task, const grading::GradeResult& result,
                               const classroom::LatePolicy& policy) {
  const auto rule = policy.find(task.exercise);
  const classroom::Lateness late =
      rule == policy.end()
          ? classroom::Lateness{}
          : classroom::computeLateness(rule->second, task.student, task.submitted, result.score);
  return {task.student,
          task.exercise,
          fmt::format("{}", result.score),
          fmt::format("{}", result.maxScore),
          std::string(toString(result.outcome)),
          fmt::format("{}", late.days),
          reports::hundredthsText(late.penalty),
          reports::hundredthsText(std::int64_t{100} * result.score - late.penalty)};
}

// One line per task, in their order. A task without a valid result has no points.
std::string plainTable(const ClassRun& run, const classroom::LatePolicy& policy) {
  std::string csv = classroom::csvLine({"student", "exercise", "points", "possible", "outcome", "late",
                                        "penalty", "final", "submitted", "time_from"});
  for (std::size_t k = 0; k < run.tasks.size(); ++k) {
    const Task& task = run.tasks[k];
    const TaskState state = run.stored[k].state;
    const std::string outcome = state == TaskState::kFailed
                                    ? std::string(grading::toString(grading::Outcome::kGraderError))
                                    : toString(state);
    std::vector<std::string> row = {task.student, task.exercise, "", "", outcome, "", "", ""};
    if (state == TaskState::kDone) row = rowOf(task, *run.stored[k].result, policy);
    row.insert(row.end(), {instantText(task.submitted), task.timeFrom});
    csv += classroom::csvLine(row);
  }
  return csv;
}

// An incomplete file left by an earlier run does not count, as its text differs.
bool holds(const std::filesystem::path& file, const std::string& text) {
  return std::filesystem::exists(file) && readTextFile(file) == text;
}

}  // namespace

ExitCode collectResults(const Project& project, const CollectOptions& options) {
  const ClassRun run = runIn(options.out, options.manifest);
  const classroom::GradebookSource source = readGradebookSource(project, options.files, run);
  const ExitCode roster = tellRoster(source.course);
  const classroom::Gradebook book = classroom::makeGradebook(run, source);
  writeReports(run, parseReportFormats(options.reports), book);
  const bool complete = writeGrades(run, readDeadlines(project, options.files.deadlines),
                                    options.files.hasBook() ? &book : nullptr, options.csv);
  const int held = tellHeldBack(run);
  if (options.json) say(collectJson(run));
  note(fmt::format("{} tasks. Table: {}", run.tasks.size(), shown(options.out / "grades.csv")));
  if (!complete) return ExitCode::kGraderFault;
  if (held > 0) return ExitCode::kBelow;
  return book.conflicts > 0 ? ExitCode::kNotGradable : roster;
}

void writeReports(const ClassRun& run, const std::vector<reports::ReportFormat>& reports,
                  const classroom::Gradebook& book) {
  int written = 0, kept = 0;
  for (std::size_t k = 0; k < run.tasks.size(); ++k) {
    const auto judgement = taskJudgement(book, run.tasks, k);
    const std::filesystem::path folder = classroom::resultFolder(run.out, run.tasks[k]);
    const StoredResult& stored = run.stored[k];
    if (stored.state != TaskState::kDone && stored.state != TaskState::kFailed) {
      classroom::removeReports(folder);
      continue;
    }
    for (const reports::ReportFormat& format : reports::reportFormats()) {
      const std::filesystem::path file = folder / format.file;
      if (!contains(reports, format) && !std::filesystem::exists(file)) continue;
      const std::string text = format.write(*stored.result, judgement ? &*judgement : nullptr);
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

bool writeGrades(const ClassRun& run, const classroom::LatePolicy& policy, const classroom::Gradebook* book,
                 bool print) {
  std::vector<std::string> students;
  for (const Task& task : run.tasks) students.push_back(task.student);
  if (book != nullptr) writeBook(*book, run.out, print);
  for (const std::string& sentence : classroom::unknownExtensions(policy, students))
    note(wrap(escapeForTerminal(sentence), 2, 0));
  if (book == nullptr) {
    const std::string table = plainTable(run, policy);
    replaceTextFile(run.out / "grades.csv", table, "the table of grades");
    for (const char* other : {kTotals, kStrangers}) std::filesystem::remove(run.out / other);
    if (print) std::fputs(table.c_str(), stdout);
  }
  std::vector<int> again;
  const auto tellAll = [&](TaskState state, const char* what) {
    const std::vector<int> numbers = numbersOf(run, state);
    tell(what, numbers, run.tasks);
    again.insert(again.end(), numbers.begin(), numbers.end());
  };
  tellAll(TaskState::kMissing, "no result");
  tellAll(TaskState::kStale, "a result for other inputs");
  tellAll(TaskState::kRefused, "a result that was changed after the grading");
  for (const StoredResult& one : run.stored)
    if (one.state == TaskState::kRefused) note(wrap(escapeForTerminal(one.why), 2, 0));
  tellAll(TaskState::kFailed, "the grader failed");
  if (again.empty()) return true;
  note(fmt::format("To repeat: {}", classroom::numberRanges(again)));
  return false;
}

int tellHeldBack(const ClassRun& run) {
  std::vector<int> held;
  for (std::size_t k = 0; k < run.stored.size(); ++k)
    if (run.stored[k].waiting) held.push_back(static_cast<int>(k) + 1);
  tell("fewer points than before wait for `rex grade --accept`", held, run.tasks);
  return static_cast<int>(held.size());
}

namespace {

constexpr const char* kNotesOfRegrading = "regrading.tsv";

std::string keyOf(const Task& task) {
  return fmt::format("{}\t{}\t{}", task.student, task.exercise, task.sourceSha256);
}

}  // namespace

Regrading::Regrading(ClassRun& run, const std::function<bool(std::size_t)>& isOpen, bool accept) : run_(run) {
  readNotes();
  for (std::size_t k = 0; k < run.tasks.size(); ++k) {
    const StoredResult& stored = run.stored[k];
    const auto noted = noted_.find(keyOf(run.tasks[k]));
    const bool isOld = noted != noted_.end(), isAgain = isOld || isOpen(k);
    before_.push_back(isOld                       ? std::optional<int>(noted->second)
                      : isAgain || stored.waiting ? stored.before
                                                  : std::nullopt);
    isNew_ = isNew_ || (before_.back() && (isAgain || accept));
  }
  writeNotes();
  if (accept) classroom::acceptRegradings(run);
}

void Regrading::readNotes() {
  const std::filesystem::path file = run_.out / kNotesOfRegrading;
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
  for (std::size_t k = 0; k < run_.tasks.size(); ++k)
    if (before_[k]) text += fmt::format("{}\t{}\n", keyOf(run_.tasks[k]), *before_[k]);
  if (!text.empty()) replaceTextFile(run_.out / kNotesOfRegrading, text, "the notes of a regrading");
}

void Regrading::tell() const {
  constexpr int kMostTold = 20;
  std::string table = classroom::csvLine({"student", "exercise", "before", "after", "counts"});
  int changed = 0, same = 0;
  for (std::size_t k = 0; k < run_.tasks.size(); ++k) {
    const Task& task = run_.tasks[k];
    const std::optional<int> after = run_.stored[k].now();
    if (!before_[k] || !after) continue;
    const bool isHeld = run_.stored[k].waiting.has_value();
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
    replaceTextFile(run_.out / kRegradedFile, table, "the table of regradings");
    note(fmt::format("Graded again: {} with other points, {} with the same. Table: {}", changed, same,
                     shown(run_.out / kRegradedFile)));
  }
  std::filesystem::remove(run_.out / kNotesOfRegrading);
}

}  // namespace rex::cli
