#include <algorithm>

#include <fmt/format.h>

#include "base/escape.h"
#include "grading/results.h"
#include "reports/report_text_internal.h"

namespace rex::grading::internal {

std::string shownText(std::string_view text, std::size_t limit) {
  constexpr std::string_view kCut = " ...";
  // Escaping a byte makes it longer, so the length of `text` does not say whether it was cut. It was not if a
  // higher limit yields no more.
  std::string shown = printable(text, limit);
  if (printable(text, limit + kCut.size()).size() == shown.size()) return shown;
  return printable(text, limit - kCut.size()).append(kCut);
}

bool isPassed(const CheckResult& check) { return check.status == Outcome::kPass; }

bool isHidden(const CheckResult& check) { return check.group == Group::kHidden; }

std::string statusOf(const CheckResult& check) {
  std::string name = check.status ? std::string(toString(*check.status)) : "not run";
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

std::string messageOf(const CheckResult& check, const std::string& file) {
  const std::string message = shownText(check.message.empty() ? statusOf(check) : check.message);
  return check.line > 0 ? fmt::format("{}\n{}:{}", message, file, check.line) : message;
}

std::string compileText(const GradeResult& result) {
  std::string text;
  for (const CompileDiagnostic& message : result.compile.diagnostics) text += toString(message) + "\n";
  if (text.empty()) text = result.message.empty() ? "does not compile" : result.message;
  return shownText(text, kLongestText);
}

std::string fileOf(const GradeResult& result) {
  return result.files.empty() ? "main.cpp" : shownText(result.files.front().name);
}

std::string pathOf(const GradeResult& result) {
  return fmt::format("exercises/{}/{}", shownText(result.exerciseId), fileOf(result));
}

std::string pointsOf(const GradeResult& result) {
  return fmt::format("{} of {} points", result.score, result.maxScore);
}

double visibleSeconds(const GradeResult& result) {
  double seconds = 0;
  for (const CheckResult& check : result.checks)
    if (!isHidden(check)) seconds += check.wallSeconds;
  return seconds;
}

std::string printedText(const GradeResult& result) {
  std::string text = result.output.text;
  if (!text.empty() && !result.error.text.empty() && text.back() != '\n') text += '\n';
  return shownText(text + result.error.text, kLongestText);
}

}  // namespace rex::grading::internal
