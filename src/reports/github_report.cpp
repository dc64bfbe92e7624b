#include <algorithm>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "base/escape.h"
#include "base/text.h"
#include "reports/report.h"
#include "reports/report_text_internal.h"

namespace rex::reports {
namespace {

using namespace internal;

constexpr std::size_t kLongestAnnotation = 1'000;
constexpr std::size_t kMostAnnotations = 10;  // GitHub shows no more of a step

struct Place {
  std::string file{};  // empty: none
  int line = 0, column = 0;
};

std::string command(const char* kind, const std::string& title, const Place& place,
                    const std::string& message) {
  std::string properties = "title=" + commandProperty(title);
  if (!place.file.empty()) properties += ",file=" + commandProperty(place.file);
  if (!place.file.empty() && place.line > 0) properties += fmt::format(",line={}", place.line);
  if (!place.file.empty() && place.line > 0 && place.column > 0)
    properties += fmt::format(",col={}", place.column);
  return fmt::format("::{} {}::{}\n", kind, properties,
                     commandMessage(shownText(message, kLongestAnnotation)));
}

// The student's file, or no file at all: a `#line` directive of the student may name any other.
Place placeOf(const grading::CompileDiagnostic& message, const grading::GradeResult& result) {
  const bool isTheirs =
      std::any_of(result.files.begin(), result.files.end(),
                  [&](const grading::SourceFile& file) { return file.name == message.file; });
  return isTheirs ? Place{submittedPath(result), message.line, message.column} : Place{};
}

void addDiagnostics(const grading::GradeResult& result, std::vector<std::string>& errors,
                    std::vector<std::string>& warnings) {
  const std::string title = shownText(result.exerciseId);
  for (const grading::CompileDiagnostic& d : result.compile.diagnostics) {
    const std::string rule = d.rule.empty() ? "" : " [" + d.rule + "]";
    const bool isError = d.severity == "error";
    (isError ? errors : warnings)
        .push_back(command(isError ? "error" : "warning", title, placeOf(d, result), d.message + rule));
  }
}

void addChecks(const grading::GradeResult& result, std::vector<std::string>& errors) {
  for (const grading::CheckResult& check : result.checks) {
    if (isHidden(check) || isPassed(check) || !check.status) continue;
    const std::string title =
        fmt::format("{} ({}/{})", shownText(check.title), check.points, check.maxPoints);
    errors.push_back(command("error", title, {submittedPath(result), check.line},
                             check.message.empty() ? statusText(check) : check.message));
  }
}

}  // namespace

std::string githubReport(const grading::GradeResult& result, const Judgement* judgement) {
  const std::string exercise = shownText(result.exerciseId);
  if (result.outcome == grading::Outcome::kGraderError) return command("error", exercise, {}, kGraderFailed);
  std::vector<std::string> errors, warnings;
  addDiagnostics(result, errors, warnings);
  addChecks(result, errors);
  if (result.outcome == grading::Outcome::kCompileError && errors.empty())
    errors.push_back(command("error", exercise, {submittedPath(result)}, compileText(result)));
  errors.insert(errors.end(), warnings.begin(), warnings.end());
  const std::size_t shown = std::min(errors.size(), kMostAnnotations - 1), more = errors.size() - shown;
  errors.resize(shown);
  std::string points = pointsText(result);
  if (judgement != nullptr) points += fmt::format("; {}", join(judgementSentences(*judgement), " "));
  errors.push_back(command("notice", exercise, {},
                           points + (more == 0 ? "" : fmt::format("; {} more in the summary", more))));
  return join(errors, "");
}

}  // namespace rex::reports
