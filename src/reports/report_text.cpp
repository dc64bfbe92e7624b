#include <algorithm>

#include <fmt/format.h>

#include "base/escape.h"
#include "grading/results.h"
#include "reports/report_text_internal.h"

namespace rex::reports::internal {

std::string shownText(std::string_view text, std::size_t limit) {
  constexpr std::string_view kCut = " ...";
  // Escaping a byte makes it longer, so the length of `text` does not say whether it was cut. It was not if a
  // higher limit yields no more.
  std::string shown = printable(text, limit);
  if (printable(text, limit + kCut.size()).size() == shown.size()) return shown;
  return printable(text, limit - kCut.size()).append(kCut);
}

bool isPassed(const grading::CheckResult& check) { return check.status == grading::Outcome::kPass; }

bool isHidden(const grading::CheckResult& check) { return check.group == grading::Group::kHidden; }

std::string statusText(const grading::CheckResult& check) {
  std::string name = check.status ? std::string(toString(*check.status)) : "not run";
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

std::string checkMessage(const grading::CheckResult& check, const std::string& file) {
  std::string message = shownText(check.message.empty() ? statusText(check) : check.message);
  if (check.line > 0) message += fmt::format("\n{}:{}", file, check.line);
  if (!check.input.empty()) message += "\ninput: " + shownText(check.input);
  return message;
}

std::string compileText(const grading::GradeResult& result) {
  std::string text;
  for (const grading::CompileDiagnostic& message : result.compile.diagnostics)
    text += toString(message) + "\n";
  if (text.empty()) text = result.message.empty() ? "does not compile" : result.message;
  return shownText(text, kLongestText);
}

std::string submittedFile(const grading::GradeResult& result) {
  return result.files.empty() ? "main.cpp" : shownText(result.files.front().name);
}

std::string submittedPath(const grading::GradeResult& result) {
  return fmt::format("exercises/{}/{}", shownText(result.exerciseId), submittedFile(result));
}

std::string pointsText(const grading::GradeResult& result) {
  return fmt::format("{} of {} points", result.score, result.maxScore);
}

std::int64_t pointsGiven(const grading::CheckResult& check, const Judgement* judgement) {
  if (judgement != nullptr)
    if (const auto given = judgement->checks.find(check.id); given != judgement->checks.end())
      return given->second;
  return std::int64_t{100} * check.points;
}

std::string pointsByPart(const grading::GradeResult& result, const Judgement* judgement) {
  struct Part {
    std::string id;
    std::int64_t points = 0;
    int maxPoints = 0;
  };
  std::vector<Part> parts;
  for (const grading::CheckResult& check : result.checks) {
    auto part =
        std::find_if(parts.begin(), parts.end(), [&](const Part& one) { return one.id == check.part; });
    if (part == parts.end()) part = parts.insert(part, {.id = check.part});
    part->points += pointsGiven(check, judgement), part->maxPoints += check.maxPoints;
  }
  if (parts.size() < 2) return "";
  std::string text = "By part: ";
  for (const Part& part : parts)
    text += fmt::format("{}{} {}/{}", &part == parts.data() ? "" : ", ", shownText(part.id),
                        hundredthsText(part.points), part.maxPoints);
  return text + ".";
}

double visibleSeconds(const grading::GradeResult& result) {
  double seconds = 0;
  for (const grading::CheckResult& check : result.checks)
    if (!isHidden(check)) seconds += check.wallSeconds;
  return seconds;
}

std::string printedText(const grading::GradeResult& result) {
  std::string text = result.output.text;
  if (!text.empty() && !result.error.text.empty() && text.back() != '\n') text += '\n';
  return shownText(text + result.error.text, kLongestText);
}

}  // namespace rex::reports::internal
