#include "classroom/gradebook_text.h"

#include <algorithm>
#include <cstdlib>
#include <memory>
#include <optional>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <utf8proc.h>

#include "base/error.h"
#include "base/escape.h"
#include "base/instant.h"
#include "base/text.h"
#include "base/text_file.h"
#include "classroom/csv.h"
#include "classroom/gradebook.h"
#include "classroom/platform_time.h"
#include "classroom/submission_folder.h"

namespace rex::classroom {
namespace {

// Nothing if the text is not UTF-8.
std::optional<std::string> mapped(std::string_view text, int options) {
  utf8proc_uint8_t* result = nullptr;
  const utf8proc_ssize_t size = ::utf8proc_map(reinterpret_cast<const utf8proc_uint8_t*>(text.data()),
                                               static_cast<utf8proc_ssize_t>(text.size()), &result,
                                               static_cast<utf8proc_option_t>(options));
  const std::unique_ptr<utf8proc_uint8_t, void (*)(void*)> owner(result, std::free);
  if (size < 0) return {};
  return std::string(reinterpret_cast<const char*>(result), static_cast<std::size_t>(size));
}

constexpr int kComposed = UTF8PROC_STABLE | UTF8PROC_COMPOSE;

}  // namespace

std::string composed(std::string_view text) { return mapped(text, kComposed).value_or(std::string(text)); }

std::string caseless(std::string_view text) {
  // Most names, and quicker: tables compare each with each.
  if (std::all_of(text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < 0x80; }))
    return lowerCase(text);
  return composed(mapped(text, kComposed | UTF8PROC_CASEFOLD | UTF8PROC_IGNORE).value_or(std::string(text)));
}

bool isUtf8(std::string_view text) { return mapped(text, kComposed).has_value(); }

namespace fs = std::filesystem;

namespace {

constexpr const char* kFeedbackPage = "feedback.html";

// Removes what an earlier export wrote, also an interrupted one. Other files are somebody's work.
void clearFeedback(const fs::path& folder) {
  if (!fs::exists(folder)) return;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (name != "checks" && !name.starts_with(kFeedbackPage))
      throw Error({.what = "not replaced by feedback",
                   .where = {folder.string()},
                   .found = fmt::format("'{}', which no export wrote", printable(name, 100)),
                   .wanted = "another folder for feedback"});
  }
  fs::remove_all(folder);
}

}  // namespace

std::optional<reports::Feedback> rowFeedback(const GradeRow& row, const fs::path& out) {
  if (!row.result) return {};
  reports::Feedback feedback{.student = shownName(row.student),
                             .result = *row.result,
                             .judgement = rowJudgement(row),
                             .source = readTextFile(out / row.handedInAs / row.exercise / "main.cpp")};
  for (const Comment& comment : row.comments)
    feedback.comments.push_back({comment.line, comment.text, comment.author});
  return feedback;
}

std::vector<reports::FeedbackFile> evidenceFiles(const GradeRow& row, const fs::path& out) {
  std::vector<reports::FeedbackFile> files;
  if (!row.result) return files;
  const fs::path folder = out / row.handedInAs / row.exercise;
  for (const grading::CheckResult& check : row.result->checks) {
    if (check.group == grading::Group::kHidden) continue;
    for (const std::string& name : {check.picture, check.replay}) {
      const fs::path path(name);
      const bool isBeside = !name.empty() && path.is_relative() && path.lexically_normal() == path &&
                            *path.begin() != ".." && path.parent_path() == "checks";
      if (isBeside && fs::is_regular_file(fs::symlink_status(folder / path)))
        files.push_back({check.id, name, readTextFile(folder / path)});
    }
  }
  return files;
}

int writeFeedbackFolders(const Gradebook& book, const fs::path& results, const fs::path& out) {
  int written = 0;
  for (const GradeRow& row : book.rows) {
    if (const std::string why = whyNoStudentName(row.student.id); !why.empty())
      throw Error({.what = fmt::format("no folder for '{}'", row.student.id),
                   .found = why,
                   .wanted = "a plain name"});
    const fs::path folder = out / row.student.id / row.exercise;
    clearFeedback(folder);
    const auto feedback = rowFeedback(row, results);
    if (!feedback) continue;
    fs::create_directories(folder / "checks");
    const std::vector<reports::FeedbackFile> files = evidenceFiles(row, results);
    for (const reports::FeedbackFile& file : files)
      if (!file.name.ends_with(".png")) replaceTextFile(folder / file.name, file.bytes, "a replay");
    if (fs::is_empty(folder / "checks")) fs::remove(folder / "checks");
    replaceTextFile(folder / kFeedbackPage, reports::feedbackPage(*feedback, files), "the feedback");
    ++written;
  }
  return written;
}

namespace {

using GradesJson = nlohmann::ordered_json;

GradesJson pointsJson(std::int64_t hundredths) {
  if (hundredths % 100 == 0) return hundredths / 100;
  return static_cast<double>(hundredths) / 100;
}

GradesJson pointsJson(const std::optional<std::int64_t>& hundredths) {
  return hundredths ? pointsJson(*hundredths) : GradesJson();
}

GradesJson whoJson(const CourseStudent& student) {
  return {{"id", student.id},
          {"name", student.name},
          {"email", student.email},
          {"group", student.group},
          {"number", student.number}};
}

GradesJson rowJson(const GradeRow& row) {
  GradesJson adjustments = GradesJson::array(), comments = GradesJson::array();
  for (const AppliedAdjustment& one : row.applied)
    adjustments.push_back({{"check", one.adjustment.check},
                           {"before", pointsJson(one.before)},
                           {"after", pointsJson(one.after)},
                           {"reason", one.adjustment.reason},
                           {"author", one.adjustment.author},
                           {"date", one.adjustment.date}});
  for (const Comment& comment : row.comments)
    comments.push_back({{"line", comment.line}, {"text", comment.text}, {"author", comment.author}});
  return {{"exercise", row.exercise},
          {"status", toString(row.status)},
          {"remark", row.remark},
          {"points", row.result ? GradesJson(row.score) : GradesJson()},
          {"possible", pointsJson(row.possible)},
          {"outcome", row.result ? GradesJson(toString(row.result->outcome)) : GradesJson()},
          {"adjustments", adjustments},
          {"comments", comments},
          {"late_days", row.late.days},
          {"penalty", pointsJson(row.late.penalty)},
          {"final", pointsJson(row.final)},
          {"submitted", row.task ? GradesJson(instantText(row.submitted)) : GradesJson()},
          {"time_from", row.timeFrom},
          {"handed_in_as", row.handedInAs},
          {"deadline", row.deadline ? GradesJson(instantText(*row.deadline)) : GradesJson()},
          {"extended", row.isExtended}};
}

}  // namespace

std::string gradesJson(const Gradebook& book, const Course& course) {
  GradesJson exercises = GradesJson::array(), students = GradesJson::array(), strangers = GradesJson::array();
  for (const std::string& name : book.exercises) {
    const CourseExercise worth = course.exercise(name);
    exercises.push_back({{"exercise", name},
                         {"weight", pointsJson(worth.weight)},
                         {"parts", worth.parts},
                         {"bonus", worth.isBonus},
                         {"minimum_percent", pointsJson(worth.minimum)}});
  }
  for (const StudentTotal& sum : book.totals) {
    GradesJson student = whoJson(sum.student), grades = GradesJson::array();
    for (const GradeRow& row : book.rows)
      if (row.student.id == sum.student.id) grades.push_back(rowJson(row));
    student["total"] = pointsJson(sum.total);
    student["possible"] = pointsJson(sum.possible);
    student["left_out"] = sum.leftOut;
    student["passes"] = sum.passes ? GradesJson(*sum.passes) : GradesJson();
    student["why_not"] = sum.why;
    student["grades"] = grades;
    students.push_back(student);
  }
  for (const GradeRow& row : book.strangers) {
    GradesJson student = whoJson(row.student);
    student["grades"] = GradesJson::array({rowJson(row)});
    strangers.push_back(student);
  }
  const GradesJson json = {{"schema", "rex-grades/1"}, {"title", course.title},      {"exercises", exercises},
                           {"students", students},     {"not_on_roster", strangers}, {"notes", book.notes}};
  return visibleJson(json.dump(2, ' ', false, GradesJson::error_handler_t::replace)) + "\n";
}

}  // namespace rex::classroom

// Grade books as tables and sentences.
namespace rex::classroom {
namespace {

std::int64_t changeOf(const GradeRow& row) {
  std::int64_t change = 0;
  for (const AppliedAdjustment& one : row.applied) change += one.after - one.before;
  return change;
}

std::string optionalText(const std::optional<std::int64_t>& hundredths) {
  return hundredths ? reports::hundredthsText(*hundredths) : "";
}

// After the deadline, but not late.
std::string graceText(const GradeRow& row) {
  if (!row.task || !row.deadline || row.submitted <= *row.deadline ||
      row.submitted > *row.deadline + row.graceSeconds)
    return "";
  return fmt::format("; {} minutes after it, within the grace of {}",
                     (row.submitted - *row.deadline + 59) / 60, row.graceSeconds / 60);
}

// For the student: of what the days count, or that the grace was used.
std::string timesText(const GradeRow& row) {
  if (!row.task || !row.deadline || row.submitted <= *row.deadline) return "";
  const PlatformZone zone(row.timeZone);
  return fmt::format("Handed in at {}, deadline {}{}.", zone.toText(row.submitted),
                     zone.toText(*row.deadline), graceText(row));
}

std::string lateText(const GradeRow& row) {
  if (row.late.days == 0) return "";
  return fmt::format("{} day{} late: {} of {} points are taken away.", row.late.days,
                     row.late.days == 1 ? "" : "s", reports::hundredthsText(row.late.penalty),
                     reports::hundredthsText(row.points));
}

std::string changeText(const AppliedAdjustment& one) {
  const Adjustment& by = one.adjustment;
  return fmt::format("{}: {} instead of {} points: {} ({}, {})", one.target,
                     reports::hundredthsText(one.after), reports::hundredthsText(one.before), by.reason,
                     by.author, by.date);
}

std::vector<std::string> cellsOf(const GradeRow& row) {
  const CourseStudent& who = row.student;
  std::vector<std::string> cells = {who.id,    who.name,     who.email,
                                    who.group, row.exercise, std::string(toString(row.status))};
  if (row.result)
    cells.insert(cells.end(), {fmt::format("{}", row.score), reports::hundredthsText(row.possible),
                               std::string(toString(row.result->outcome))});
  else
    cells.insert(cells.end(), {"", reports::hundredthsText(row.possible), ""});
  cells.push_back(row.applied.empty() ? "" : reports::hundredthsText(changeOf(row)));
  if (row.result)
    cells.insert(cells.end(), {fmt::format("{}", row.late.days), reports::hundredthsText(row.late.penalty)});
  else
    cells.insert(cells.end(), {"", ""});
  cells.push_back(optionalText(row.final));
  if (row.task)
    cells.insert(cells.end(),
                 {PlatformZone(row.timeZone).toText(row.submitted), row.timeFrom, row.handedInAs});
  else
    cells.insert(cells.end(), {"", "", ""});
  cells.push_back(row.remark);
  return cells;
}

void explainChecks(const GradeRow& row, std::vector<std::string>& lines) {
  for (const grading::CheckResult& check : row.result->checks)
    lines.push_back(fmt::format("  {}/{} {} [{}{}{}]: {}", check.points, check.maxPoints, check.title,
                                check.id, check.group == grading::Group::kHidden ? ", hidden" : "",
                                row.worth.counts(check.part) ? "" : ", does not count",
                                check.status ? toString(*check.status) : "not run"));
}

// What the course says about the exercise, for students, too.
std::vector<std::string> worthSentences(const GradeRow& row) {
  std::vector<std::string> sentences;
  if (!row.worth.parts.empty())
    sentences.push_back(fmt::format("Only these parts count: {}.", join(row.worth.parts, ", ")));
  if (row.worth.isBonus) sentences.emplace_back("The exercise is a bonus: its points come on top.");
  if (row.worth.minimum && row.final)
    sentences.push_back(fmt::format("The minimum of {} % is {}.", reports::hundredthsText(*row.worth.minimum),
                                    row.reachesMinimum() ? "reached" : "not reached"));
  return sentences;
}

void explainTime(const GradeRow& row, std::vector<std::string>& lines) {
  const PlatformZone zone(row.timeZone);
  lines.push_back(fmt::format("Handed in at {} (time from {}) as '{}'", zone.toText(row.submitted),
                              row.timeFrom, row.handedInAs));
  if (row.deadline)
    lines.push_back(fmt::format("Deadline {}{}{}", zone.toText(*row.deadline),
                                row.isExtended ? ", an extension of this student" : "", graceText(row)));
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
  if (book.hasBest) headings.emplace_back("left_out");
  if (book.hasPassRules) headings.insert(headings.end(), {"passes", "why_not"});
  std::string text = csvLine(headings);
  for (const StudentTotal& sum : book.totals) {
    std::vector<std::string> cells = {sum.student.id, sum.student.name, sum.student.email, sum.student.group};
    for (const std::string& exercise : book.exercises) {
      const GradeRow* row = book.row(sum.student.id, exercise);
      cells.push_back(row == nullptr ? "" : optionalText(row->final));
    }
    cells.push_back(optionalText(sum.total));
    cells.push_back(reports::hundredthsText(sum.possible));
    if (book.hasBest) cells.push_back(join(sum.leftOut, ", "));
    if (book.hasPassRules)
      cells.insert(cells.end(), {!sum.passes ? "" : *sum.passes ? "yes" : "no", join(sum.why, "; ")});
    text += csvLine(cells);
  }
  return text;
}

std::optional<reports::Judgement> rowJudgement(const GradeRow& row) {
  if (!row.final) return {};
  reports::Judgement judgement{.student = shownName(row.student),
                               .lateness = timesText(row) + (row.late.days > 0 ? " " : "") + lateText(row),
                               .penalty = row.late.penalty,
                               .final = *row.final,
                               .possible = row.possible};
  judgement.changes = worthSentences(row);
  for (const AppliedAdjustment& one : row.applied) {
    judgement.changes.push_back(changeText(one));
    if (!one.adjustment.check.empty()) judgement.checks[one.adjustment.check] = one.after;
  }
  return judgement;
}

std::vector<std::string> explain(const GradeRow& row) {
  std::vector<std::string> lines = {fmt::format("{} ({}), {}: {}", shownName(row.student), row.student.id,
                                                row.exercise, toString(row.status))};
  if (!row.remark.empty()) lines.push_back(fmt::format("Remark: {}", row.remark));
  if (row.task) explainTime(row, lines);
  if (row.result) {
    lines.push_back(fmt::format("Checks: {} of {} points ({})", row.score,
                                reports::hundredthsText(row.possible), toString(row.result->outcome)));
    explainChecks(row, lines);
  }
  for (const AppliedAdjustment& one : row.applied)
    if (!one.adjustment.check.empty())
      lines.push_back(fmt::format("Adjusted, {}: {}", toString(one.adjustment.where), changeText(one)));
  if (row.late.days > 0) lines.push_back(lateText(row));
  for (const AppliedAdjustment& one : row.applied)
    if (one.adjustment.check.empty())
      lines.push_back(fmt::format("Adjusted, {}: {}", toString(one.adjustment.where), changeText(one)));
  lines.push_back(row.final ? fmt::format("Final: {} of {} points", reports::hundredthsText(*row.final),
                                          reports::hundredthsText(row.possible))
                            : fmt::format("No grade (of {} points)", reports::hundredthsText(row.possible)));
  for (const std::string& sentence : worthSentences(row)) lines.push_back(sentence);
  return lines;
}

}  // namespace rex::classroom
