#include <string>

#include <fmt/format.h>

#include "base/escape.h"
#include "reports/report.h"
#include "reports/report_text_internal.h"

namespace rex::reports {
namespace {

using namespace internal;

constexpr std::size_t kLongestCell = 600, kMostPrinted = 16'000;

// A character written by its number is never markup, so no text can end a cell or open anything.
std::string cell(const std::string& text) { return markdownText(shownText(text, kLongestCell)); }

// Text as it is, in an HTML block that continues until its end tag, whatever it contains.
std::string block(const char* title, const std::string& text) {
  const std::string shown = shownText(text.substr(0, text.find_last_not_of('\n') + 1), kMostPrinted);
  return fmt::format("\n{}\n\n<pre>\n{}\n</pre>\n", title, markdownBlock(shown));
}

std::string row(const grading::CheckResult& check, const grading::GradeResult& result, int& hidden) {
  const std::string name = isHidden(check) ? fmt::format("Hidden check {}", ++hidden)
                                           : fmt::format("{} ({})", cell(check.title), cell(check.id));
  const std::string found = isPassed(check) || isHidden(check) || !check.status
                                ? ""
                                : cell(checkMessage(check, submittedFile(result)));
  return fmt::format("| {} | {} | {}/{} | {} |\n", statusText(check), name, check.points, check.maxPoints,
                     found);
}

std::string table(const grading::GradeResult& result) {
  std::string text = "\n| Result | Check | Points | What was found |\n| --- | --- | ---: | --- |\n";
  int hidden = 0;
  for (const grading::CheckResult& check : result.checks) text += row(check, result, hidden);
  return text;
}

// Whose result it is, what people changed, what lateness costs, and what remains.
std::string judgementText(const Judgement* judgement) {
  if (judgement == nullptr) return "";
  std::string text = fmt::format("\n{}\n\n", cell(judgement->student));
  for (const std::string& sentence : judgementSentences(*judgement))
    text += fmt::format("- {}\n", cell(sentence));
  return text;
}

}  // namespace

std::string markdownReport(const grading::GradeResult& result, const Judgement* judgement) {
  const std::string exercise = cell(result.exerciseId);
  if (result.outcome == grading::Outcome::kGraderError)
    return fmt::format("## {}: not graded\n\n{}\n", exercise, kGraderFailed);
  std::string text = fmt::format("## {}: {}\n", exercise, pointsText(result)) + judgementText(judgement);
  if (result.outcome == grading::Outcome::kCompileError) {
    text += block("Cannot be graded:", compileText(result));
  } else {
    text += table(result);
    if (const std::string parts = pointsByPart(result); !parts.empty())
      text += fmt::format("\n{}\n", cell(parts));
    if (!result.compile.diagnostics.empty()) text += block("The compiler warns:", compileText(result));
  }
  const std::string printed = printedText(result);
  if (!printed.empty()) text += block("The program printed:", printed);
  return text + fmt::format("\nSeed {}, exercise {}, rex {}, sandbox level {}.\n", cell(result.seedId),
                            cell(result.exerciseVersion), cell(result.toolVersion), result.sandboxLevel);
}

}  // namespace rex::reports
