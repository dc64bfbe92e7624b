#include <string>
#include <string_view>

#include <fmt/format.h>

#include "reports/report.h"
#include "reports/report_text_internal.h"

namespace rex::grading {
namespace {

using namespace internal;

constexpr std::size_t kLongestCell = 600, kMostPrinted = 16'000;

// A character written by its number never is markup, so no text can end a cell or begin anything. Line breaks
// become blanks.
std::string plain(std::string_view text) {
  constexpr std::string_view kMarkup = "&<>|\\`*_~[]()#$@!{}^=";
  std::string safe;
  for (std::size_t k = 0; k < text.size(); ++k) {
    const char c = text[k];
    // Addresses become links by themselves.
    const bool isAddress =
        (c == ':' && text.substr(k + 1, 1) == "/") || (c == '.' && k > 0 && text[k - 1] == 'w');
    if (c == '\n' || c == '\t')
      safe += ' ';
    else if (isAddress || kMarkup.find(c) != std::string_view::npos)
      safe += fmt::format("&#{};", static_cast<int>(c));
    else
      safe += c;
  }
  return safe;
}

std::string cell(const std::string& text) { return plain(shownText(text, kLongestCell)); }

// Text as it is, in an HTML block that goes on until its end tag, whatever is in it. Also where somebody
// prints the summary into a log, no line of it is a command to the program that keeps the log.
std::string block(const char* title, const std::string& text) {
  const std::string shown = shownText(text.substr(0, text.find_last_not_of('\n') + 1), kMostPrinted);
  std::string safe;
  for (std::size_t k = 0; k < shown.size(); ++k) {
    const bool isCommand = shown.compare(k, 2, "::") == 0 || shown.compare(k, 3, "##[") == 0;
    if (isCommand || shown[k] == '&' || shown[k] == '<' || shown[k] == '>')
      safe += fmt::format("&#{};", static_cast<int>(shown[k]));
    else
      safe += shown[k];
  }
  return fmt::format("\n{}\n\n<pre>\n{}\n</pre>\n", title, safe);
}

std::string row(const CheckResult& check, const GradeResult& result, int& hidden) {
  const std::string name = isHidden(check)
                               ? fmt::format("Hidden check {}", ++hidden)
                               : fmt::format("{} &#91;{}&#93;", cell(check.title), cell(check.id));
  const std::string found =
      isPassed(check) || isHidden(check) || !check.status ? "" : cell(messageOf(check, fileOf(result)));
  return fmt::format("| {} | {} | {}/{} | {} |\n", statusOf(check), name, check.points, check.maxPoints,
                     found);
}

std::string table(const GradeResult& result) {
  std::string text = "\n| Result | Check | Points | What was found |\n| --- | --- | ---: | --- |\n";
  int hidden = 0;
  for (const CheckResult& check : result.checks) text += row(check, result, hidden);
  return text;
}

}  // namespace

std::string markdownReport(const GradeResult& result) {
  const std::string exercise = cell(result.exerciseId);
  if (result.outcome == Outcome::graderError)
    return fmt::format("## {}: not graded\n\n{}\n", exercise, kGraderFailed);
  std::string text = fmt::format("## {}: {}\n", exercise, pointsOf(result));
  if (result.outcome == Outcome::compileError) {
    text += block("Cannot be graded:", compileText(result));
  } else {
    text += table(result);
    if (!result.compile.diagnostics.empty()) text += block("The compiler warns:", compileText(result));
  }
  const std::string printed = printedText(result);
  if (!printed.empty()) text += block("The program printed:", printed);
  return text + fmt::format("\nSeed {}, exercise {}, rex {}, sandbox level {}.\n", cell(result.seedId),
                            cell(result.exerciseVersion), cell(result.toolVersion), result.sandboxLevel);
}

}  // namespace rex::grading
