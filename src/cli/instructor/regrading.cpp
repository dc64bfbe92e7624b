#include "cli/instructor/regrading.h"

#include <fmt/format.h>

#include "base/error.h"
#include "base/lines.h"
#include "base/text.h"
#include "base/text_file.h"
#include "classroom/csv.h"
#include "classroom/grade_task.h"
#include "cli/instructor/class_grades.h"
#include "cli/terminal.h"

namespace rex::cli {
namespace {

using grading::Task;

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
    const bool isOld = noted != noted_.end(), isHeld = grading::isHeldBack(task, out_),
               isAgain = isOld || isOpen(task);
    before_.push_back(isOld               ? std::optional<int>(noted->second)
                      : isAgain || isHeld ? grading::pointsBefore(task, out_)
                                          : std::nullopt);
    isNew_ = isNew_ || (before_.back() && (isAgain || accept));
  }
  writeNotes();
  if (!accept) return;
  for (const Task& task : tasks) grading::acceptRegrading(task, out_);
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
                   .wanted = "those of an interrupted `rex grade`; without this file, it begins anew"});
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
  std::string table = grading::csvLine({"student", "exercise", "before", "after", "counts"});
  int changed = 0, same = 0;
  for (std::size_t k = 0; k < tasks_.size(); ++k) {
    const Task& task = tasks_[k];
    const std::optional<int> after = grading::pointsNow(task, out_);
    if (!before_[k] || !after) continue;
    const bool isHeld = grading::isHeldBack(task, out_);
    table += grading::csvLine({task.student, task.exercise, fmt::format("{}", *before_[k]),
                               fmt::format("{}", *after), isHeld ? "before" : "after"});
    if (*before_[k] == *after) {
      ++same;
    } else if (++changed <= kMostTold) {
      note(wrap(
          harmless(fmt::format("{} {}: {} points, {} before{}", task.student, task.exercise, *after,
                               *before_[k], isHeld ? "; the points from before count until --accept" : "")),
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
