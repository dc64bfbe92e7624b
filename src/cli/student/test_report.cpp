#include <algorithm>
#include <cstdio>
#include <sstream>
#include <utility>

#include <fmt/format.h>

#include "base/text.h"
#include "cli/out_folder.h"
#include "cli/student/student_file.h"
#include "cli/student/test_run.h"
#include "cli/terminal.h"
#include "submission/compiler_messages.h"

namespace rex::cli {
namespace {

using grading::CheckResult;
using grading::Group;
using grading::Outcome;

constexpr std::size_t kTitles = 13;  // the column at which titles begin
constexpr std::size_t kIndent = 4;   // below messages

std::string verdict(const CheckResult& check) {
  if (!check.status) return paint(Colour::kYellow, " -  ");
  if (*check.status == Outcome::kPass) return paint(Colour::kGreen, " ok ");
  return check.points > 0 ? paint(Colour::kYellow, "part") : paint(Colour::kRed, "FAIL");
}

// Often many numbers, which must not push the question off the screen.
void sayInput(const std::string& input) {
  constexpr std::size_t kMostLines = 4;
  if (input.empty()) return;
  const std::string text =
      std::string(kIndent, ' ') + wrap("input: " + escapeForTerminal(input), kIndent, kIndent);
  std::vector<std::string_view> lines = splitLines(text);
  const bool isCut = lines.size() > kMostLines;
  lines.resize(std::min(lines.size(), kMostLines));
  for (const std::string_view line : lines) say(line);
  if (isCut) say(fmt::format("{:{}}... (the result has the whole input)", "", kIndent));
}

// How close a passed check came to its limit: for those who look at one check.
std::string marginOf(const CheckResult& check, bool isWhole) {
  const auto& worst = check.worst;
  if (isWhole || check.status != Outcome::kPass || worst.property.empty()) return "";
  return fmt::format(": {} {}, {}", escapeForTerminal(worst.property), worst.value, worst.limit);
}

// Students wait for them, and `rex watch` runs them last.
std::string slownessOf(const CheckResult& check) {
  return check.cpuSeconds < kSlowCheck ? "" : fmt::format(" ({:.0f} s)", check.cpuSeconds);
}

// Code is cut, not wrapped, to keep its layout.
std::string cut(const std::string& code, std::size_t columns) {
  if (code.size() <= columns) return code;
  std::size_t end = columns - 4;
  while (end > 0 && (code[end] & 0xc0) == 0x80) --end;  // not within a UTF-8 character
  return code.substr(0, end) + " ...";
}

// Prints the line of the student's file where it happened.
void sayPlace(const CheckResult& check, const submission::Submission& graded) {
  if (check.line == 0 || graded.result.files.empty()) return;
  constexpr std::size_t kColumns = 80, kLeast = 30;
  std::istringstream lines(graded.source);
  std::string line;
  for (int k = 0; k < check.line; ++k) std::getline(lines, line);
  const std::size_t first = std::min(line.find_first_not_of(" \t"), line.size());
  const std::string start =
      fmt::format("{:{}}{}:{}   ", "", kIndent, graded.result.files.front().name, check.line);
  say(start + cut(escapeForTerminal(line.substr(first)),
                  std::max(kLeast, kColumns - std::min(kColumns, start.size()))));
}

void sayEvidence(const CheckResult& check, const std::filesystem::path& folder) {
  for (const auto& [kind, file] : {std::pair{"picture", check.picture}, {"replay", check.replay}})
    if (!file.empty()) say(fmt::format("{:{}}{}: {}", "", kIndent, kind, shown(folder / file)));
}

bool hasFailed(const CheckResult& check) { return check.status && *check.status != Outcome::kPass; }

std::string lineOf(const CheckResult& check, const std::string& remark) {
  const std::string hidden = check.group == Group::kHidden ? ", hidden" : "";
  const auto title = fmt::format("{} [{}{}]{}", escapeForTerminal(check.title), check.id, hidden, remark);
  return fmt::format(" {} {:2}/{:<2}  {}", verdict(check), check.points, check.maxPoints,
                     wrap(title, kTitles, kTitles));
}

void printMessage(const CheckResult& check, const submission::Submission& graded,
                  const std::filesystem::path& folder) {
  const std::string start = fmt::format("[{}] ", check.id);
  say("\n" + start + wrap(escapeForTerminal(check.message), kIndent, start.size()));
  sayPlace(check, graded);
  sayInput(check.input);
  sayEvidence(check, folder);
}

// The list of all, then the messages where eyes rest: of the first failed check, unless all are wanted.
// Returns the number of messages left out.
int printChecks(const ExerciseInfo& exercise, const submission::Submission& graded,
                const std::filesystem::path& folder, const ReportView& view) {
  const std::vector<CheckResult>& checks = graded.result.checks;
  std::vector<const CheckResult*> explained;
  for (const submission::ExercisePart& part : exercise.parts) {
    const auto isOfPart = [&](const CheckResult& check) { return check.part == part.id; };
    if (std::none_of(checks.begin(), checks.end(), isOfPart)) continue;
    say(paint(Colour::kBold, part.title));
    for (const CheckResult& check : checks) {
      if (!isOfPart(check)) continue;
      say(lineOf(check, slownessOf(check) + marginOf(check, view.isWhole)));
      if (!check.remark.empty())
        say(std::string(kTitles, ' ') + wrap(escapeForTerminal(check.remark), kTitles, kTitles));
      if (check.status != Outcome::kPass && !check.message.empty()) explained.push_back(&check);
    }
  }
  const std::size_t shown = view.inFull ? explained.size() : std::min<std::size_t>(explained.size(), 1);
  for (std::size_t k = 0; k < shown; ++k) printMessage(*explained[k], graded, folder);
  if (shown > 0) say();
  return static_cast<int>(explained.size() - shown);
}

// The ids of checks of `now` whose verdict is `passed`, and was the opposite before.
std::vector<std::string> turned(const grading::GradeResult& before, const grading::GradeResult& now,
                                bool passed) {
  std::vector<std::string> ids;
  for (const CheckResult& check : now.checks)
    for (const CheckResult& old : before.checks)
      if (old.id == check.id && old.status && check.status && hasFailed(check) != passed &&
          hasFailed(old) == passed)
        ids.push_back(check.id);
  return ids;
}

void sayChanges(const grading::GradeResult& before, const grading::GradeResult& now) {
  if (before.checks.empty() || now.checks.empty()) return;
  const std::vector<std::string> better = turned(before, now, true), worse = turned(before, now, false);
  std::string text;
  if (!better.empty()) text += fmt::format("These pass now: {}. ", join(better, ", "));
  if (!worse.empty()) text += fmt::format("These no longer pass: {}. ", join(worse, ", "));
  if (before.score != now.score)
    text += fmt::format("The last test gave {} point{}. ", before.score, before.score == 1 ? "" : "s");
  if (text.empty()) text = "No verdict has changed since the last test. ";
  text.pop_back();
  say(wrap(escapeForTerminal(text), 2, 0));
}

// What the functions printed while they were graded. A loop can print much.
void sayPrinted(const grading::GradeResult& result) {
  constexpr int kMostLines = 40;
  std::istringstream lines(result.output.text + result.error.text);
  std::string line;
  for (int count = 0; std::getline(lines, line); ++count) {
    if (count == 0) say("Your functions printed:");
    if (count == kMostLines) return say("  ...");
    say("  " + escapeForTerminal(line));
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
  const auto failed = std::find_if(result.checks.begin(), result.checks.end(), hasFailed);
  if (failed == result.checks.end()) return;
  const std::string seed = result.seedId.substr(result.seedId.find(':') + 1);  // or "1 hidden:HASH"
  say(fmt::format(
      "One check alone: scripts/rex test {} --check {} --seed {}{}", exercise.name, failed->id,
      seed.substr(0, seed.find(' ')),
      failed->group == Group::kHidden && seed.find(' ') != seed.npos ? " --secret-file FILE" : ""));
}

void sayPoints(const grading::GradeResult& result, int unseen) {
  const bool full = result.outcome == Outcome::kPass;
  say(paint(full ? Colour::kGreen : Colour::kBold,
            fmt::format("{} of {} points", result.score, result.maxScore)) +
      (unseen > 0 ? fmt::format("; hidden checks for {} more run when the course grades", unseen) : ""));
}

// Files older than the program show what it did before its last change.
void sayFirst(const std::string& what, std::vector<std::filesystem::path> files,
              const std::filesystem::path& source) {
  std::error_code missing;
  const auto changed = std::filesystem::last_write_time(source, missing);
  if (!missing)
    std::erase_if(files, [&](const auto& file) { return std::filesystem::last_write_time(file) < changed; });
  if (files.empty()) return;
  const std::string more = files.size() > 1 ? fmt::format(" and {} more", files.size() - 1) : "";
  say(fmt::format("{}: {}{}", what, shown(files.front()), more));
}

}  // namespace

void printResult(const ExerciseInfo& exercise, const submission::Submission& graded,
                 const std::filesystem::path& results, const std::filesystem::path& source,
                 const ReportView& view) {
  const grading::GradeResult& result = graded.result;
  say(paint(Colour::kBold, fmt::format("{}: {}", exercise.name, exercise.title)));
  if (result.outcome == Outcome::kCompileError) {
    std::fflush(stdout);
    explain(result.compile.diagnostics, graded.source, results.parent_path() / "build.log");
    say("Not graded: no check could run.");
    return say("Result: " + shown(results));
  }
  const int shortened = printChecks(exercise, graded, results.parent_path(), view);
  for (const auto& message : result.compile.diagnostics)
    say(wrap(escapeForTerminal(toString(message)), 2, 0));
  if (!view.isWhole) sayPrinted(result);
  if (result.outcome == Outcome::kGraderError)
    say(wrap(
        "The grader itself failed: not your fault, and not your grade. " + escapeForTerminal(result.message),
        0, 0));
  sayIfSomeEndedBadly(result.checks);
  if (view.before) sayChanges(*view.before, result);
  if (shortened > 0) say(fmt::format("All messages: scripts/rex test {} --all", exercise.name));
  sayHowToRepeat(exercise, result);
  sayPoints(result, view.isWhole ? exercise.points() - result.maxScore : 0);
  for (const std::string& record : view.records) say(wrap("Record: " + escapeForTerminal(record), 2, 0));
  say("Result: " + shown(results));
  // Beside them are those of `rex run`.
  sayFirst("Replay", filesIn(results.parent_path() / "checks", ".html"), source);
  sayFirst("Picture", filesIn(results.parent_path() / "checks", ".png"), source);
}

}  // namespace rex::cli
