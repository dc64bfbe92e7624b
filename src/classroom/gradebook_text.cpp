// Grade books as tables and sentences.
#include <fmt/format.h>

#include "base/instant.h"
#include "classroom/csv.h"
#include "classroom/gradebook.h"

namespace rex::grading {
namespace {

std::int64_t changeOf(const GradeRow& row) {
  std::int64_t change = 0;
  for (const AppliedAdjustment& one : row.applied) change += one.after - one.before;
  return change;
}

std::string optionalText(const std::optional<std::int64_t>& hundredths) {
  return hundredths ? hundredthsText(*hundredths) : "";
}

std::string lateText(const GradeRow& row) {
  if (row.late.days == 0) return "";
  return fmt::format("{} day{} late: {} of {} points are taken away.", row.late.days,
                     row.late.days == 1 ? "" : "s", hundredthsText(row.late.penalty),
                     hundredthsText(row.points));
}

std::string changeText(const AppliedAdjustment& one) {
  const Adjustment& by = one.adjustment;
  return fmt::format("{}: {} instead of {} points: {} ({}, {})", one.target, hundredthsText(one.after),
                     hundredthsText(one.before), by.reason, by.author, by.date);
}

std::vector<std::string> cellsOf(const GradeRow& row) {
  const CourseStudent& who = row.student;
  std::vector<std::string> cells = {who.id,    who.name,     who.email,
                                    who.group, row.exercise, std::string(toString(row.status))};
  if (row.result)
    cells.insert(cells.end(), {fmt::format("{}", row.result->score), hundredthsText(row.possible),
                               std::string(toString(row.result->outcome))});
  else
    cells.insert(cells.end(), {"", hundredthsText(row.possible), ""});
  cells.push_back(row.applied.empty() ? "" : hundredthsText(changeOf(row)));
  if (row.result)
    cells.insert(cells.end(), {fmt::format("{}", row.late.days), hundredthsText(row.late.penalty)});
  else
    cells.insert(cells.end(), {"", ""});
  cells.push_back(optionalText(row.final));
  if (row.task)
    cells.insert(cells.end(), {instantText(row.submitted), row.timeFrom, row.handedInAs});
  else
    cells.insert(cells.end(), {"", "", ""});
  cells.push_back(row.remark);
  return cells;
}

void explainChecks(const GradeRow& row, std::vector<std::string>& lines) {
  for (const CheckResult& check : row.result->checks)
    lines.push_back(fmt::format("  {}/{} {} [{}{}]: {}", check.points, check.maxPoints, check.title, check.id,
                                check.group == Group::kHidden ? ", hidden" : "",
                                check.status ? toString(*check.status) : "not run"));
}

void explainTime(const GradeRow& row, std::vector<std::string>& lines) {
  lines.push_back(fmt::format("Handed in at {} (time from {}) as '{}'", instantText(row.submitted),
                              row.timeFrom, row.handedInAs));
  if (row.deadline)
    lines.push_back(fmt::format("Deadline {}{}", instantText(*row.deadline),
                                row.isExtended ? ", an extension of this student" : ""));
  else
    lines.emplace_back("No deadline");
}

}  // namespace

std::string gradesCsv(const std::vector<GradeRow>& rows) {
  std::string text =
      csvLine({"student", "name", "email", "group", "exercise", "status", "points", "possible", "outcome",
               "adjusted", "late", "penalty", "final", "submitted", "time_from", "handed_in_as", "remark"});
  for (const GradeRow& row : rows) text += csvLine(cellsOf(row));
  return text;
}

std::string totalsCsv(const Gradebook& book) {
  std::vector<std::string> headings = {"student", "name", "email", "group"};
  headings.insert(headings.end(), book.exercises.begin(), book.exercises.end());
  headings.insert(headings.end(), {"total", "possible"});
  std::string text = csvLine(headings);
  for (const StudentTotal& sum : book.totals) {
    std::vector<std::string> cells = {sum.student.id, sum.student.name, sum.student.email, sum.student.group};
    for (const std::string& exercise : book.exercises) {
      const GradeRow* row = book.row(sum.student.id, exercise);
      cells.push_back(row == nullptr ? "" : optionalText(row->final));
    }
    cells.push_back(optionalText(sum.total));
    cells.push_back(hundredthsText(sum.possible));
    text += csvLine(cells);
  }
  return text;
}

std::optional<Judgement> judgementOf(const GradeRow& row) {
  if (!row.final) return {};
  Judgement judgement{.student = shownName(row.student),
                      .lateness = lateText(row),
                      .penalty = row.late.penalty,
                      .final = *row.final,
                      .possible = row.possible};
  for (const AppliedAdjustment& one : row.applied) judgement.changes.push_back(changeText(one));
  return judgement;
}

std::vector<std::string> explain(const GradeRow& row) {
  std::vector<std::string> lines = {fmt::format("{} ({}), {}: {}", shownName(row.student), row.student.id,
                                                row.exercise, toString(row.status))};
  if (!row.remark.empty()) lines.push_back(fmt::format("Remark: {}", row.remark));
  if (row.task) explainTime(row, lines);
  if (row.result) {
    lines.push_back(fmt::format("Checks: {} of {} points ({})", row.result->score, row.result->maxScore,
                                toString(row.result->outcome)));
    explainChecks(row, lines);
  }
  for (const AppliedAdjustment& one : row.applied)
    if (!one.adjustment.check.empty())
      lines.push_back(fmt::format("Adjusted, {}: {}", toString(one.adjustment.where), changeText(one)));
  if (row.late.days > 0) lines.push_back(lateText(row));
  for (const AppliedAdjustment& one : row.applied)
    if (one.adjustment.check.empty())
      lines.push_back(fmt::format("Adjusted, {}: {}", toString(one.adjustment.where), changeText(one)));
  lines.push_back(row.final ? fmt::format("Final: {} of {} points", hundredthsText(*row.final),
                                          hundredthsText(row.possible))
                            : fmt::format("No grade (of {} points)", hundredthsText(row.possible)));
  return lines;
}

}  // namespace rex::grading
