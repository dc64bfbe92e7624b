#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <utility>

#include <fmt/format.h>

#include "base/error.h"
#include "classroom/class_statistics.h"
#include "classroom/csv.h"
#include "cli/instructor/class_figure.h"
#include "cli/instructor/dev_verbs.h"
#include "cli/json_internal.h"
#include "cli/terminal.h"

namespace rex::cli {
namespace {

using grading::CheckStatistics;
using grading::ExerciseStatistics;
using grading::PartStatistics;

std::string groupOf(const CheckStatistics& check) {
  return check.group == grading::Group::kHidden ? "hidden" : "visible";
}

std::string classesOf(const CheckStatistics& check) {
  std::vector<std::string> parts;
  for (const auto& [name, count] : check.classes) parts.push_back(fmt::format("{} {}", count, name));
  return fmt::format("{}", fmt::join(parts, ", "));
}

// How the parts went, so that one sees which is too hard.
void sayParts(const ExerciseStatistics& all) {
  std::size_t width = 0;
  for (const PartStatistics& part : all.parts) width = std::max(width, part.id.size());
  for (const PartStatistics& part : all.parts) {
    const double share = part.maxPoints > 0 ? part.meanPoints / part.maxPoints : 0;
    say(fmt::format("  part {:{}}  {} {:3.0f} % of {} points, {} of {} have them all", harmless(part.id),
                    width, bar(static_cast<int>(std::lround(share * 1000)), 1000), 100 * share,
                    part.maxPoints, part.full, all.graded));
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

void sayChecks(const ExerciseStatistics& all) {
  const auto passed = std::count_if(all.checks.begin(), all.checks.end(),
                                    [](const CheckStatistics& check) { return check.failed == 0; });
  for (const CheckStatistics& check : all.checks) {
    if (check.failed == 0) continue;
    const std::string mark = check.group == grading::Group::kHidden ? ", hidden" : "";
    const std::string worth =
        check.discrimination ? fmt::format("; correlation with the rest {:.2f}", *check.discrimination) : "";
    const std::string text =
        fmt::format("{} of {} failed: {} [{}{}]: {}{}{}", check.failed, all.graded, harmless(check.title),
                    harmless(check.id), mark, classesOf(check), harmless(commonQuestion(check)), worth);
    say("  " + wrap(text, 6, 6));
  }
  if (passed > 0) say(fmt::format("  {} check{} passed by all", passed, passed == 1 ? "" : "s"));
}

void sayExercise(const ExerciseStatistics& all) {
  say(fmt::format("{}: {} graded, {} with full score", harmless(all.exercise), all.graded, all.full));
  if (all.graderFailed > 0)
    say(fmt::format("  the grader failed on {} more: not counted, to be graded again", all.graderFailed));
  if (all.versions > 1)
    say(fmt::format("  these results are from {} versions of the exercise: grade again to compare them",
                    all.versions));
  if (all.graded == 0) return;
  say(fmt::format("  points   mean {:.4g}, median {:.4g} of {}", all.meanPoints, all.medianPoints,
                  all.maxPoints));
  std::string bins;
  for (std::size_t k = 0; k < all.distribution.size(); ++k)
    bins += fmt::format("{}{}: {}", k == 0 ? "" : "   ", grading::kDistribution[k], all.distribution[k]);
  say("  at least " + bins);
  say(fmt::format("  grading  median {:.1f} s, longest {:.1f} s ({})", all.medianSeconds, all.longestSeconds,
                  harmless(all.slowest)));
  sayParts(all);
  sayChecks(all);
}

Json toJson(const ExerciseStatistics& all) {
  Json distribution = Json::object(), checks = Json::array(), parts = Json::array();
  for (std::size_t k = 0; k < all.distribution.size(); ++k)
    distribution[grading::kDistribution[k]] = all.distribution[k];
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
                     {"full", part.full}});
  return {{"exercise", all.exercise},
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
          {"parts", parts},
          {"checks", checks}};
}

void printCsv(const std::vector<ExerciseStatistics>& all) {
  std::string text = grading::csvLine(
      {"exercise", "part", "check", "group", "graded", "failed", "classes", "question", "discrimination"});
  for (const ExerciseStatistics& exercise : all)
    for (const CheckStatistics& check : exercise.checks)
      text += grading::csvLine({exercise.exercise, check.part, check.id, groupOf(check),
                                fmt::format("{}", exercise.graded), fmt::format("{}", check.failed),
                                classesOf(check), mostAsked(check).first, discriminationText(check)});
  std::fputs(text.c_str(), stdout);
}

void print(const std::vector<ExerciseStatistics>& all, const grading::ClassResults& read,
           const StatsOptions& options) {
  if (options.json) {
    Json list = Json::array();
    for (const ExerciseStatistics& exercise : all) list.push_back(toJson(exercise));
    say(dump(Json{{"exercises", list}, {"not_counted", read.complaints}}));
  } else if (options.csv) {
    printCsv(all);
  } else {
    for (std::size_t k = 0; k < all.size(); ++k) {
      if (k > 0) say();
      sayExercise(all[k]);
    }
  }
}

}  // namespace

ExitCode devStats(const Project&, const StatsOptions& options) {
  if (!std::filesystem::is_directory(options.results))
    throw UsageError({.what = "no such folder",
                      .where = {options.results.string()},
                      .wanted = "the folder of results that rex grade wrote"});
  const grading::ClassResults read = grading::readClassResults(options.results);
  for (const std::string& complaint : read.complaints) note(wrap(harmless(complaint), 2, 0));
  if (read.results.empty())
    throw UsageError({.what = "nothing to evaluate",
                      .where = {options.results.string()},
                      .found = "no results",
                      .wanted = "STUDENT/EXERCISE/results.json in it"});
  const std::vector<ExerciseStatistics> all = grading::statisticsOf(read.results);
  print(all, read, options);
  if (!options.figure.empty()) {
    writeFigure(pointsFigure(read.results), options.figure);
    note(fmt::format("Drawn: {}", shown(options.figure)));
  }
  if (!options.parts.empty()) {
    writeFigure(partsFigure(all), options.parts);
    note(fmt::format("Drawn: {}", shown(options.parts)));
  }
  return read.complaints.empty() ? ExitCode::kFull : ExitCode::kNotGradable;
}

}  // namespace rex::cli
