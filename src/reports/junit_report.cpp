#include <string>
#include <string_view>

#include <fmt/format.h>

#include "base/escape.h"
#include "reports/report.h"
#include "reports/report_text_internal.h"

namespace rex::reports {
namespace {

using namespace internal;

std::string attribute(const char* name, std::string_view value) {
  return fmt::format(" {}=\"{}\"", name, xmlText(value));
}

struct TestCase {
  std::string name;
  std::string body{};  // empty: passed
  std::string place{};
  double seconds = 0;
};

struct Counts {
  int tests = 0, failures = 0, errors = 0, skipped = 0;
};

std::string shortfall(const char* element, std::string_view type, const std::string& message) {
  const std::string firstLine = message.substr(0, message.find('\n'));
  return fmt::format("      <{}{}{}>{}</{}>\n", element, attribute("message", firstLine),
                     attribute("type", type), xmlText(message), element);
}

std::string skipped(const char* why) {
  return fmt::format("      <skipped{}/>\n", attribute("message", why));
}

// Students read what CI shows, so a hidden check reveals only that it exists and how it ended.
TestCase junitTest(const grading::CheckResult& check, const grading::GradeResult& result, int hiddenNumber,
                   Counts& counts) {
  TestCase test{.name = hiddenNumber > 0
                            ? fmt::format("Hidden check {}", hiddenNumber)
                            : fmt::format("{} [{}]", shownText(check.title), shownText(check.id)),
                .seconds = isHidden(check) ? 0 : check.wallSeconds};
  ++counts.tests;
  if (isPassed(check)) return test;
  if (!check.status) {
    ++counts.skipped;
    test.body = skipped("not run");
    return test;
  }
  const std::string message =
      fmt::format("{} of {} points: {}", check.points, check.maxPoints,
                  isHidden(check) ? statusText(check) : checkMessage(check, submittedFile(result)));
  const bool isFailure = check.status == grading::Outcome::kFail;
  ++(isFailure ? counts.failures : counts.errors);
  test.body = shortfall(isFailure ? "failure" : "error", toString(*check.status), message);
  if (!isHidden(check) && check.line > 0)
    test.place = attribute("file", submittedPath(result)) + fmt::format(" line=\"{}\"", check.line);
  return test;
}

std::string textOf(const TestCase& test, const grading::GradeResult& result) {
  const std::string start =
      fmt::format("    <testcase{}{} time=\"{:.3f}\"{}", attribute("name", test.name),
                  attribute("classname", shownText(result.exerciseId)), test.seconds, test.place);
  return test.body.empty() ? start + "/>\n" : fmt::format("{}>\n{}    </testcase>\n", start, test.body);
}

std::string propertiesOf(const grading::GradeResult& result, const Judgement* judgement) {
  std::string text = "    <properties>\n";
  const auto add = [&](const char* name, const std::string& value) {
    text += fmt::format("      <property{}{}/>\n", attribute("name", name), attribute("value", value));
  };
  add("score", fmt::format("{}", result.score));
  add("max_score", fmt::format("{}", result.maxScore));
  add("outcome", std::string(toString(result.outcome)));
  add("seed_id", shownText(result.seedId));
  add("exercise_version", shownText(result.exerciseVersion));
  add("snapshot_sha256", shownText(result.snapshotSha256));
  add("tool_version", shownText(result.toolVersion));
  add("compiler", shownText(result.compiler));
  add("sandbox_level", fmt::format("{}", result.sandboxLevel));
  if (judgement != nullptr) {
    add("student", shownText(judgement->student));
    add("final", hundredthsText(judgement->final));
    for (const std::string& sentence : judgementSentences(*judgement)) add("judgement", shownText(sentence));
  }
  return text + "    </properties>\n";
}

// Whatever concerns all checks is a separate test case before them.
std::string wholeOf(const grading::GradeResult& result, Counts& counts) {
  if (result.outcome != grading::Outcome::kCompileError && result.outcome != grading::Outcome::kGraderError)
    return "";
  ++counts.tests, ++counts.errors;
  const bool isFault = result.outcome == grading::Outcome::kGraderError;
  return textOf(
      {.name = isFault ? "grader" : "compile",
       .body = shortfall("error", toString(result.outcome), isFault ? kGraderFailed : compileText(result))},
      result);
}

}  // namespace

std::string junitReport(const grading::GradeResult& result, const Judgement* judgement) {
  Counts counts;
  std::string cases = wholeOf(result, counts);
  int hidden = 0;
  for (const grading::CheckResult& check : result.checks)
    cases += textOf(junitTest(check, result, isHidden(check) ? ++hidden : 0, counts), result);
  const std::string totals =
      fmt::format("{} tests=\"{}\" failures=\"{}\" errors=\"{}\" skipped=\"{}\" time=\"{:.3f}\"",
                  attribute("name", shownText(result.exerciseId)), counts.tests, counts.failures,
                  counts.errors, counts.skipped, visibleSeconds(result));
  const auto stream = [](const char* name, const grading::KeptOutput& kept) {
    return fmt::format("    <{}>{}</{}>\n", name, xmlText(shownText(kept.text, kLongestText)), name);
  };
  return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites" + totals + ">\n  <testsuite" + totals +
         ">\n" + propertiesOf(result, judgement) + cases + stream("system-out", result.output) +
         stream("system-err", result.error) + "  </testsuite>\n</testsuites>\n";
}

}  // namespace rex::reports
