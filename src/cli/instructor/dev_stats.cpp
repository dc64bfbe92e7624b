#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <utility>

#include <fmt/format.h>

#include "base/error.h"
#include "base/instant.h"
#include "base/text.h"
#include "classroom/class_statistics.h"
#include "classroom/csv.h"
#include "cli/instructor/class_grades.h"
#include "cli/instructor/collect.h"
#include "cli/instructor/dev_verbs.h"
#include "cli/results_internal.h"
#include "cli/terminal.h"

namespace rex::cli {
namespace {

using classroom::CheckStatistics;
using classroom::ExerciseStatistics;
using classroom::PartStatistics;

std::string groupOf(const CheckStatistics& check) {
  return check.group == grading::Group::kHidden ? "hidden" : "visible";
}

std::string classesOf(const CheckStatistics& check) {
  std::vector<std::string> parts;
  for (const auto& [name, count] : check.classes) parts.push_back(fmt::format("{} {}", count, name));
  return join(parts, ", ");
}

// How the parts went, so that one sees which is too hard.
void addParts(Results& results, const ExerciseStatistics& all) {
  std::size_t width = 0;
  for (const PartStatistics& part : all.parts) width = std::max(width, part.id.size());
  for (const PartStatistics& part : all.parts) {
    const double share = part.maxPoints > 0 ? part.meanPoints / part.maxPoints : 0;
    const std::string after = part.timed == 0 ? ""
                                              : fmt::format("; first passed after {:.1f} h (median of {})",
                                                            part.medianHours, part.timed);
    results.line("  part {:{}}  {} {:3.0f} % of {} points, {} of {} have them all{}",
                 escapeForTerminal(part.id), width, bar(static_cast<int>(std::lround(share * 1000)), 1000),
                 100 * share, part.maxPoints, part.full, all.graded, after);
  }
}

// The question that most of those who failed were asked, and how many.
std::pair<std::string, int> mostAsked(const CheckStatistics& check) {
  const auto most = std::max_element(check.questions.begin(), check.questions.end(),
                                     [](const auto& a, const auto& b) { return a.second < b.second; });
  return most == check.questions.end() ? std::pair<std::string, int>("", 0)
                                       : std::pair<std::string, int>(*most);
}

std::string commonQuestion(const CheckStatistics& check) {
  const auto [question, count] = mostAsked(check);
  return count == 0 ? "" : fmt::format("; {} asked: {}", count, question);
}

std::string discriminationText(const CheckStatistics& check) {
  return check.discrimination ? fmt::format("{:.2f}", *check.discrimination) : "";
}

void addChecks(Results& results, const ExerciseStatistics& all) {
  const auto passed = std::count_if(all.checks.begin(), all.checks.end(),
                                    [](const CheckStatistics& check) { return check.failed == 0; });
  for (const CheckStatistics& check : all.checks) {
    if (check.failed == 0) continue;
    const std::string mark = check.group == grading::Group::kHidden ? ", hidden" : "";
    const std::string worth =
        check.discrimination ? fmt::format("; correlation with the rest {:.2f}", *check.discrimination) : "";
    const std::string text = fmt::format("{} of {} failed: {} [{}{}]: {}{}{}", check.failed, all.graded,
                                         escapeForTerminal(check.title), escapeForTerminal(check.id), mark,
                                         classesOf(check), escapeForTerminal(commonQuestion(check)), worth);
    results.line("  {}", wrap(text, 6, 6));
  }
  if (passed > 0) results.line("  {} check{} passed by all", passed, passed == 1 ? "" : "s");
}

// "2 days 5 h", "5 h 12 min", "12 min".
std::string durationText(std::int64_t seconds) {
  const std::int64_t minutes = seconds / 60, hours = minutes / 60, days = hours / 24;
  if (days > 0) return fmt::format("{} day{} {} h", days, days == 1 ? "" : "s", hours % 24);
  return hours > 0 ? fmt::format("{} h {} min", hours, minutes % 60) : fmt::format("{} min", minutes);
}

std::string relationText(std::int64_t time, const std::optional<std::int64_t>& to, const char* what) {
  if (!to) return "";
  return fmt::format(", {} {} the {}", durationText(std::abs(time - *to)), time <= *to ? "before" : "after",
                     what);
}

classroom::LateRule ruleOf(const classroom::LatePolicy& policy, const std::string& exercise) {
  const auto rule = policy.find(exercise);
  return rule == policy.end() ? classroom::LateRule{} : rule->second;
}

void addFirstFull(Results& results, const ExerciseStatistics& all, const classroom::LateRule& rule) {
  if (all.full == 0) return;
  if (!all.firstFull) {
    results.line("  first full score: at an unknown time, as no list of tasks (tasks.tsv) has it");
    return;
  }
  const classroom::FirstFull& first = *all.firstFull;
  results.lines.push_back(
      "  " + wrap(fmt::format("first full score: {}, handed in {}{}{} (time from {})",
                              escapeForTerminal(first.student), instantText(first.submitted),
                              relationText(first.submitted, rule.opening, "opening"),
                              relationText(first.submitted, rule.deadline, "deadline"),
                              first.timeFrom == "file" ? "files, which may be when they were copied"
                                                       : escapeForTerminal(first.timeFrom)),
                  6, 6));
}

void addAttempts(Results& results, const ExerciseStatistics& all) {
  const classroom::AttemptStatistics& attempts = all.attempts;
  if (attempts.known == 0) {
    results.line("  attempts unknown: neither a platform nor an import has counted them");
    return;
  }
  std::string text =
      fmt::format("attempts median {:.4g}, most {} ({}); known of {} of {}", attempts.median, attempts.most,
                  escapeForTerminal(attempts.mostBy), attempts.known, all.graded + all.graderFailed);
  if (attempts.atLeast > 0)
    text += fmt::format(", of {} as the number of imports that brought another file: at least so many",
                        attempts.atLeast);
  results.line("  {}", wrap(text, 6, 6));
}

void addWork(Results& results, const ExerciseStatistics& all) {
  if (all.work.known == 0) return;
  results.line("  work     median {:.1f} h until the last save, by the {} who handed in their progress",
               all.work.medianHours, all.work.known);
}

void addStatistics(Results& results, const ExerciseStatistics& all, const classroom::LateRule& rule) {
  results.line("{}: {} graded, {} with full score", escapeForTerminal(all.exercise), all.graded, all.full);
  if (all.graderFailed > 0)
    results.line("  the grader failed on {} more: not counted, to be graded again", all.graderFailed);
  if (all.versions > 1)
    results.line("  these results are from {} versions of the exercise: grade again to compare them",
                 all.versions);
  if (all.graded == 0) return;
  results.line("  points   mean {:.4g}, median {:.4g} of {}", all.meanPoints, all.medianPoints,
               all.maxPoints);
  std::string bins;
  for (std::size_t k = 0; k < all.distribution.size(); ++k)
    bins += fmt::format("{}{}: {}", k == 0 ? "" : "   ", classroom::kDistribution[k], all.distribution[k]);
  results.line("  at least {}", bins);
  results.line("  grading  median {:.1f} s, longest {:.1f} s ({})", all.medianSeconds, all.longestSeconds,
               escapeForTerminal(all.slowest));
  addFirstFull(results, all, rule);
  addAttempts(results, all);
  addWork(results, all);
  addParts(results, all);
  addChecks(results, all);
}

Json firstFullJson(const ExerciseStatistics& all, const classroom::LateRule& rule) {
  if (!all.firstFull) return {};
  const classroom::FirstFull& first = *all.firstFull;
  return {{"student", first.student},
          {"submitted", instantText(first.submitted)},
          {"time_from", first.timeFrom},
          {"seconds_after_opening", rule.opening ? Json(first.submitted - *rule.opening) : Json()},
          {"seconds_before_deadline", rule.deadline ? Json(*rule.deadline - first.submitted) : Json()}};
}

Json attemptsJson(const classroom::AttemptStatistics& attempts) {
  if (attempts.known == 0) return {};
  return {{"known", attempts.known},
          {"at_least", attempts.atLeast},
          {"median", attempts.median},
          {"most", attempts.most},
          {"most_by", attempts.mostBy}};
}

Json studentsJson(const std::vector<classroom::StudentResult>& results, const std::string& exercise) {
  Json students = Json::array();
  for (const classroom::StudentResult& one : results)
    if (one.exercise == exercise)
      students.push_back({{"student", one.student},
                          {"points", one.result.score},
                          {"outcome", toString(one.result.outcome)},
                          {"submitted", one.submitted ? Json(instantText(*one.submitted)) : Json()},
                          {"time_from", one.timeFrom},
                          {"attempts", one.attempts > 0 ? Json(one.attempts) : Json()},
                          {"attempts_from", one.attemptsFrom}});
  return students;
}

Json toJson(const ExerciseStatistics& all, const classroom::LateRule& rule,
            const std::vector<classroom::StudentResult>& results) {
  Json distribution = Json::object(), checks = Json::array(), parts = Json::array();
  for (std::size_t k = 0; k < all.distribution.size(); ++k)
    distribution[classroom::kDistribution[k]] = all.distribution[k];
  for (const CheckStatistics& check : all.checks)
    checks.push_back({{"id", check.id},
                      {"part", check.part},
                      {"title", check.title},
                      {"group", groupOf(check)},
                      {"failed", check.failed},
                      {"classes", check.classes},
                      {"questions", check.questions},
                      {"discrimination", check.discrimination ? Json(*check.discrimination) : Json()}});
  for (const PartStatistics& part : all.parts)
    parts.push_back({{"id", part.id},
                     {"max_points", part.maxPoints},
                     {"mean_points", part.meanPoints},
                     {"full", part.full},
                     {"timed", part.timed},
                     {"median_hours", part.timed > 0 ? Json(part.medianHours) : Json()}});
  return {
      {"exercise", all.exercise},
      {"graded", all.graded},
      {"full", all.full},
      {"grader_failed", all.graderFailed},
      {"versions", all.versions},
      {"max_points", all.maxPoints},
      {"mean_points", all.meanPoints},
      {"median_points", all.medianPoints},
      {"distribution", distribution},
      {"median_seconds", all.medianSeconds},
      {"longest_seconds", all.longestSeconds},
      {"slowest", all.slowest},
      {"first_full", firstFullJson(all, rule)},
      {"attempts", attemptsJson(all.attempts)},
      {"work",
       all.work.known > 0 ? Json{{"known", all.work.known}, {"median_hours", all.work.medianHours}} : Json()},
      {"students", studentsJson(results, all.exercise)},
      {"parts", parts},
      {"checks", checks}};
}

void printCsv(const std::vector<ExerciseStatistics>& all) {
  std::string text = classroom::csvLine(
      {"exercise", "part", "check", "group", "graded", "failed", "classes", "question", "discrimination"});
  for (const ExerciseStatistics& exercise : all)
    for (const CheckStatistics& check : exercise.checks)
      text += classroom::csvLine({exercise.exercise, check.part, check.id, groupOf(check),
                                  fmt::format("{}", exercise.graded), fmt::format("{}", check.failed),
                                  classesOf(check), mostAsked(check).first, discriminationText(check)});
  std::fputs(text.c_str(), stdout);
}

void printStudents(const std::vector<classroom::StudentResult>& results) {
  std::string text = classroom::csvLine({"student", "exercise", "points", "possible", "outcome", "submitted",
                                         "time_from", "attempts", "attempts_from"});
  for (const classroom::StudentResult& one : results) {
    const bool isGraded = one.result.outcome != grading::Outcome::kGraderError;
    text +=
        classroom::csvLine({one.student, one.exercise, isGraded ? fmt::format("{}", one.result.score) : "",
                            fmt::format("{}", one.result.maxScore), std::string(toString(one.result.outcome)),
                            one.submitted ? instantText(*one.submitted) : "", one.timeFrom,
                            one.attempts > 0 ? fmt::format("{}", one.attempts) : "", one.attemptsFrom});
  }
  std::fputs(text.c_str(), stdout);
}

void print(const std::vector<ExerciseStatistics>& all, const classroom::ClassResults& read,
           const classroom::LatePolicy& policy, const StatsOptions& options) {
  if (options.csv) return printCsv(all);
  if (options.students) return printStudents(read.results);
  Results results{.json = {{"exercises", Json::array()}, {"not_counted", read.complaints}}};
  for (const ExerciseStatistics& exercise : all) {
    const classroom::LateRule rule = ruleOf(policy, exercise.exercise);
    if (!results.lines.empty()) results.line("");
    addStatistics(results, exercise, rule);
    results.json["exercises"].push_back(toJson(exercise, rule, read.results));
  }
  results.print(options.json);
}

}  // namespace

ExitCode devStats(const Project& project, const StatsOptions& options) {
  requireFolder(options.results, "the folder of results that rex grade wrote");
  const ClassFiles files{.course = options.course, .deadlines = options.deadlines};
  const classroom::Course course = readClassCourse(project, files);
  const ExitCode roster = tellRoster(course);
  classroom::ClassResults read = classroom::readClassResults(options.results);
  if (!options.course.empty())
    read = classroom::resultsByPerson(
        read,
        readGradebook(project, files, classroom::runOf(tasksIn(options.results), options.results, read)));
  for (const std::string& complaint : read.complaints) note(wrap(escapeForTerminal(complaint), 2, 0));
  if (read.results.empty())
    throw UsageError({.what = "nothing to evaluate",
                      .where = {options.results.string()},
                      .found = "no results",
                      .wanted = "STUDENT/EXERCISE/results.json in it"});
  const std::vector<ExerciseStatistics> all = classroom::exerciseStatistics(read.results);
  print(all, read, course.policy, options);
  if (!options.figure.empty()) {
    writeFigure(pointsFigure(read.results), options.figure);
    note(fmt::format("Drawn: {}", shown(options.figure)));
  }
  if (!options.parts.empty()) {
    writeFigure(partsFigure(all), options.parts);
    note(fmt::format("Drawn: {}", shown(options.parts)));
  }
  return read.complaints.empty() ? roster : ExitCode::kNotGradable;
}

}  // namespace rex::cli
