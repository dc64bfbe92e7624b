#include "cli/student/test_report.h"

#include <algorithm>
#include <cstdio>
#include <sstream>

#include <fmt/format.h>

#include "cli/result_list.h"
#include "cli/student/student_file.h"
#include "cli/terminal.h"
#include "submission/compiler_messages.h"

namespace rex::cli {
namespace {

using grading::CheckResult;
using grading::Group;
using grading::Outcome;

constexpr std::size_t kIndent = 13;  // the column at which titles begin

std::string verdict(const CheckResult& check) {
  if (!check.status) return paint(Colour::kYellow, " -  ");
  if (*check.status == Outcome::kPass) return paint(Colour::kGreen, " ok ");
  return check.points > 0 ? paint(Colour::kYellow, "part") : paint(Colour::kRed, "FAIL");
}

void sayIndented(const std::string& text) {
  say(std::string(kIndent, ' ') + wrap(harmless(text), kIndent, kIndent));
}

// How close a passed check came to its limit: for those who look at one check.
std::string marginOf(const CheckResult& check, bool isWhole) {
  const auto& worst = check.worst;
  if (isWhole || check.status != Outcome::kPass || worst.property.empty()) return "";
  return fmt::format(": {} {}, {}", harmless(worst.property), worst.value, worst.limit);
}

// Code is cut, not wrapped, to keep its layout.
std::string cut(const std::string& code, std::size_t columns) {
  if (code.size() <= columns) return code;
  std::size_t end = columns - 4;
  while (end > 0 && (code[end] & 0xc0) == 0x80) --end;  // not within a UTF-8 character
  return code.substr(0, end) + " ...";
}

// Prints the line of the student's file where it happened.
void sayPlace(const CheckResult& check, const grading::Submission& graded) {
  if (check.line == 0 || graded.result.files.empty()) return;
  constexpr std::size_t kColumns = 80, kLeast = 30;
  std::istringstream lines(graded.source);
  std::string line;
  for (int k = 0; k < check.line; ++k) std::getline(lines, line);
  const std::size_t first = std::min(line.find_first_not_of(" \t"), line.size());
  const std::string start =
      fmt::format("{:{}}{}:{}   ", "", kIndent, graded.result.files.front().name, check.line);
  say(start +
      cut(harmless(line.substr(first)), std::max(kLeast, kColumns - std::min(kColumns, start.size()))));
}

void sayEvidence(const CheckResult& check, const std::filesystem::path& folder) {
  for (const auto& [kind, file] : {std::pair{"picture", check.picture}, {"replay", check.replay}})
    if (!file.empty()) say(fmt::format("{:{}}{}: {}", "", kIndent, kind, shown(folder / file)));
}

void printCheck(const CheckResult& check, const grading::Submission& graded,
                const std::filesystem::path& folder, bool isWhole) {
  const std::string hidden = check.group == Group::kHidden ? ", hidden" : "";
  const std::string title =
      fmt::format("{} [{}{}]{}", harmless(check.title), check.id, hidden, marginOf(check, isWhole));
  say(fmt::format(" {} {:2}/{:<2}  {}", verdict(check), check.points, check.maxPoints,
                  wrap(title, kIndent, kIndent)));
  if (check.status == Outcome::kPass || check.message.empty()) return;
  sayIndented(check.message);
  sayPlace(check, graded);
  sayEvidence(check, folder);
}

void printChecks(const ExerciseInfo& exercise, const grading::Submission& graded,
                 const std::filesystem::path& folder, bool isWhole) {
  const std::vector<CheckResult>& checks = graded.result.checks;
  for (const grading::ExercisePart& part : exercise.parts) {
    const auto isOfPart = [&](const CheckResult& check) { return check.part == part.id; };
    if (std::none_of(checks.begin(), checks.end(), isOfPart)) continue;
    say(paint(Colour::kBold, part.title));
    for (const CheckResult& check : checks)
      if (isOfPart(check)) printCheck(check, graded, folder, isWhole);
  }
}

// Says that the other checks were graded although some ended badly.
void sayIfSomeEndedBadly(const std::vector<CheckResult>& checks) {
  const auto endedBadly = [](const CheckResult& check) {
    return check.status && *check.status != Outcome::kPass && *check.status != Outcome::kFail;
  };
  const auto bad = std::count_if(checks.begin(), checks.end(), endedBadly);
  const auto others = static_cast<std::ptrdiff_t>(checks.size()) - bad;
  if (bad > 0 && others > 0)
    say(fmt::format("{} check{} ended badly; the other {} {} graded all the same.", bad, bad == 1 ? "" : "s",
                    others, others == 1 ? "was" : "were"));
}

void sayHowToRepeat(const ExerciseInfo& exercise, const grading::GradeResult& result) {
  const auto failed = std::find_if(result.checks.begin(), result.checks.end(), [](const CheckResult& check) {
    return check.status && *check.status != Outcome::kPass;
  });
  if (failed == result.checks.end()) return;
  const std::size_t colon = result.seedId.rfind(':');
  say(fmt::format("One check alone: scripts/rex test {} --check {} --seed {}", exercise.name, failed->id,
                  colon == std::string::npos ? "1" : result.seedId.substr(colon + 1)));
}

void sayPoints(const grading::GradeResult& result, int unseen) {
  const bool full = result.outcome == Outcome::kPass;
  say(paint(full ? Colour::kGreen : Colour::kBold,
            fmt::format("{} of {} points", result.score, result.maxScore)) +
      (unseen > 0 ? fmt::format("; hidden checks for {} more run when the course grades", unseen) : ""));
}

void sayFirst(const std::string& what, const std::vector<std::filesystem::path>& files) {
  if (files.empty()) return;
  const std::string more = files.size() > 1 ? fmt::format(" and {} more", files.size() - 1) : "";
  say(fmt::format("{}: {}{}", what, shown(files.front()), more));
}

}  // namespace

void printResult(const ExerciseInfo& exercise, const grading::Submission& graded,
                 const std::filesystem::path& results, bool isWhole) {
  const grading::GradeResult& result = graded.result;
  say(paint(Colour::kBold, fmt::format("{}: {}", exercise.name, exercise.title)));
  if (result.outcome == Outcome::kCompileError) {
    std::fflush(stdout);
    explain(result.compile.diagnostics, graded.source, results.parent_path() / "build.log");
    say("Not graded: no check could run.");
  } else {
    printChecks(exercise, graded, results.parent_path(), isWhole);
    for (const auto& message : result.compile.diagnostics) say(wrap(harmless(toString(message)), 2, 0));
    if (result.outcome == Outcome::kGraderError)
      say(wrap("The grader itself failed: not your fault, and not your grade. " + harmless(result.message), 0,
               0));
    sayIfSomeEndedBadly(result.checks);
    sayHowToRepeat(exercise, result);
    sayPoints(result, isWhole ? exercise.points() - result.maxScore : 0);
  }
  say("Result: " + shown(results));
  sayFirst("Replay", filesIn(results.parent_path(), ".html"));
  sayFirst("Picture", filesIn(results.parent_path(), ".png"));
}

}  // namespace rex::cli
