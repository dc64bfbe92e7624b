#include <map>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "reports/report.h"
#include "reports/report_text_internal.h"

namespace rex::reports {
namespace {

using Json = nlohmann::ordered_json;
using namespace internal;

// A hidden check's message is left out: it may quote text that a program chose while it knew the input.
std::string outputOf(const grading::CheckResult& check, const std::string& file) {
  if (isPassed(check)) return "";
  if (!isHidden(check)) return checkMessage(check, file);
  const std::string cases =
      check.cases > 0 ? fmt::format(", {} of {} cases hold", check.casesHeld, check.cases) : "";
  const std::string property = check.property.empty() ? "" : ": " + shownText(check.property);
  return statusText(check) + cases + property;
}

Json gradescopeTest(const grading::CheckResult& check, const std::string& number, const std::string& file) {
  return {{"number", number},
          {"name", shownText(check.title)},
          {"score", check.points},
          {"max_score", check.maxPoints},
          {"status", isPassed(check) ? "passed" : "failed"},
          {"output", outputOf(check, file)},
          {"tags", {shownText(check.part)}},
          {"visibility", isHidden(check) ? "after_published" : "visible"},
          {"extra_data", {{"id", shownText(check.id)}, {"status", statusText(check)}}}};
}

// Numbered by part and check: 1.1, 1.2, 2.1.
Json testsOf(const grading::GradeResult& result) {
  std::map<std::string, std::pair<std::size_t, int>> parts;  // number of the part, its checks so far
  Json tests = Json::array();
  for (const grading::CheckResult& check : result.checks) {
    auto& [part, count] = parts.try_emplace(check.part, parts.size() + 1, 0).first->second;
    tests.push_back(gradescopeTest(check, fmt::format("{}.{}", part, ++count), submittedFile(result)));
  }
  return tests;
}

std::string outputOf(const grading::GradeResult& result) {
  if (result.outcome == grading::Outcome::kGraderError) return kGraderFailed;
  if (result.outcome == grading::Outcome::kCompileError) return "Cannot be graded:\n" + compileText(result);
  const std::string printed = printedText(result);
  return pointsText(result) + (printed.empty() ? "" : "\n\nThe program printed:\n" + printed);
}

// A line for each sentence of the judgement, before `text`; only the text without one.
std::string judgedText(const Judgement* judgement, const std::string& text) {
  if (judgement == nullptr) return text;
  std::string judged = shownText(judgement->student) + "\n";
  for (const std::string& sentence : judgementSentences(*judgement)) judged += shownText(sentence) + "\n";
  return judged + "\n" + text;
}

}  // namespace

std::string gradescopeReport(const grading::GradeResult& result, const Judgement* judgement) {
  Json json;
  if (result.outcome != grading::Outcome::kGraderError) {
    json["score"] = result.score;
    if (judgement != nullptr) json["score"] = static_cast<double>(judgement->final) / 100;
  }
  json["execution_time"] = visibleSeconds(result);
  json["output"] = judgedText(judgement, outputOf(result));
  for (const char* format : {"output_format", "test_output_format", "test_name_format"})
    json[format] = "text";
  json["stdout_visibility"] = "hidden";
  json["extra_data"] = {{"exercise", shownText(result.exerciseId)},
                        {"exercise_version", shownText(result.exerciseVersion)},
                        {"outcome", toString(result.outcome)},
                        {"seed_id", shownText(result.seedId)},
                        {"snapshot_sha256", shownText(result.snapshotSha256)},
                        {"tool_version", shownText(result.toolVersion)},
                        {"sandbox_level", result.sandboxLevel}};
  if (result.outcome != grading::Outcome::kGraderError) json["tests"] = testsOf(result);
  return json.dump(2) + "\n";
}

}  // namespace rex::reports
