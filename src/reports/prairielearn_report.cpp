#include <algorithm>

#include <nlohmann/json.hpp>

#include "reports/report.h"
#include "reports/report_text_internal.h"

namespace rex::grading {
namespace {

using Json = nlohmann::ordered_json;
using namespace internal;

// A hidden check shows only its name and points.
Json prairieLearnTest(const CheckResult& check, const std::string& file) {
  const bool isSilent = isPassed(check) || isHidden(check);
  return {{"name", shownText(check.title)},
          {"description", shownText(check.part)},
          {"points", check.points},
          {"max_points", check.maxPoints},
          {"message", isSilent ? "" : messageOf(check, file)}};
}

// Attempts that cannot be graded do not count, be it for a typing mistake or for a fault of ours.
std::string formatErrorOf(const GradeResult& result) {
  if (result.outcome == Outcome::kGraderError) return kGraderFailed;
  return result.outcome == Outcome::kCompileError ? compileText(result) : "";
}

}  // namespace

std::string prairielearnReport(const GradeResult& result, const Judgement* judgement) {
  const std::string formatError = formatErrorOf(result);
  Json json = {{"gradable", formatError.empty()}};
  if (!formatError.empty()) {
    json["format_errors"] = {judgedText(judgement, formatError)};
    return json.dump(2) + "\n";
  }
  json["score"] = result.maxScore > 0 ? static_cast<double>(result.score) / result.maxScore : 0.0;
  if (judgement != nullptr && judgement->possible > 0)
    json["score"] = std::clamp(
        static_cast<double>(judgement->final) / static_cast<double>(judgement->possible), 0.0, 1.0);
  json["message"] = judgedText(judgement, pointsOf(result));
  json["output"] = printedText(result);
  json["tests"] = Json::array();
  for (const CheckResult& check : result.checks)
    json["tests"].push_back(prairieLearnTest(check, fileOf(result)));
  return json.dump(2) + "\n";
}

}  // namespace rex::grading
