#include <algorithm>
#include <string>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "reports/report.h"
#include "reports/report_text_internal.h"

namespace rex::grading {
namespace {

using Json = nlohmann::ordered_json;
using namespace internal;

const char* statusFor(Outcome outcome) {
  if (outcome == Outcome::kPass) return "pass";
  return outcome == Outcome::kFail ? "fail" : "error";
}

// A check that was not run counts as failed.
Json exercismTest(const CheckResult& check, const std::string& file) {
  const Json message = isPassed(check) ? Json() : Json(messageOf(check, file));
  return {{"name", shownText(check.title)},
          {"status", statusFor(check.status.value_or(Outcome::kFail))},
          {"message", message}};
}

// Hidden checks are not reported one by one, but a solution that fails them is not a pass.
Json testOfHidden(const GradeResult& result) {
  const auto hidden = std::count_if(result.checks.begin(), result.checks.end(), isHidden);
  const auto passed = std::count_if(result.checks.begin(), result.checks.end(), [](const CheckResult& check) {
    return isHidden(check) && isPassed(check);
  });
  return {{"name", "Hidden checks"},
          {"status", passed == hidden ? "pass" : "fail"},
          {"message", passed == hidden ? Json() : Json(fmt::format("{} of {} pass", passed, hidden))}};
}

Json errorOf(const std::string& message) {
  return {{"version", 3}, {"status", "error"}, {"message", message}, {"tests", Json::array()}};
}

}  // namespace

std::string exercismReport(const GradeResult& result, const Judgement* judgement) {
  if (result.outcome == Outcome::kGraderError) return errorOf(kGraderFailed).dump(2) + "\n";
  if (result.outcome == Outcome::kCompileError)
    return errorOf(judgedText(judgement, compileText(result))).dump(2) + "\n";
  Json tests = Json::array();
  for (const CheckResult& check : result.checks)
    if (!isHidden(check)) tests.push_back(exercismTest(check, fileOf(result)));
  if (std::any_of(result.checks.begin(), result.checks.end(), isHidden))
    tests.push_back(testOfHidden(result));
  if (judgement != nullptr)
    tests.push_back({{"name", judgedText(judgement, "")}, {"status", "pass"}, {"message", Json()}});
  const Json json = {{"version", 3},
                     {"status", result.outcome == Outcome::kPass ? "pass" : "fail"},
                     {"message", Json()},
                     {"tests", tests}};
  return json.dump(2) + "\n";
}

}  // namespace rex::grading
