// Every text of a result is hostile: none may reach a reader as anything but what it shows.
#include <filesystem>
#include <regex>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "grading/results.h"
#include "reports/report.h"
#include "support/file_text.h"
#include "support/paths.h"

namespace rex::reports::hostile_text_test {

using ::testing::HasSubstr;
using ::testing::Not;

const std::vector<std::string> kHostile = {"\u202E",  "\u2066", "\u2069", "\u200B", "\u200F",      "\u2028",
                                           "\u2029",  "\u0085", "\uFEFF", "\u00AD", "\U000E0041",  "\u061C",
                                           "\x1b[2J", "\r",     "\x07",   "\xff",   "\xed\xa0\x80"};

grading::GradeResult resultWith(const std::string& text, grading::Outcome outcome) {
  grading::GradeResult result;
  const std::string t = "a" + text + "b";
  result.submissionId = result.snapshotSha256 = result.exerciseId = result.exerciseVersion = t;
  result.seedId = result.toolVersion = result.compiler = result.message = t;
  result.files = {{t, t}};
  result.outcome = outcome;
  result.output.text = result.error.text = t;
  result.sandboxWarnings = {t};
  result.compile.diagnostics = {{t, 1, 1, "warning", t, t}, {t, 1, 1, "error", t, t}};
  for (const grading::Group group : {grading::Group::kVisible, grading::Group::kHidden}) {
    grading::CheckResult check{
        .id = t, .part = t, .title = t, .group = group, .status = grading::Outcome::kFail, .maxPoints = 2};
    check.message = check.property = check.expected = check.got = check.tolerance = check.input = t;
    check.function = check.worst.property = check.worst.value = check.worst.limit = t;
    check.picture = check.replay = t;
    check.line = 3;
    result.checks.push_back(check);
  }
  result.maxScore = 4;
  return result;
}

TEST(HostileText, IsShownInEveryFormat) {
  for (const std::string& text : kHostile)
    for (const grading::Outcome outcome :
         {grading::Outcome::kFail, grading::Outcome::kCompileError, grading::Outcome::kGraderError}) {
      const grading::GradeResult result = resultWith(text, outcome);
      EXPECT_THAT(grading::toJson(result), Not(HasSubstr(text)));
      for (const ReportFormat& format : reportFormats())
        EXPECT_THAT(format.write(result), Not(HasSubstr(text))) << format.name;
    }
}

// Also where it was written by number, as JSON may.
TEST(HostileText, IsShownInResultsThatAreReadAgain) {
  const std::string json = grading::toJson(resultWith("\u202E", grading::Outcome::kFail));
  EXPECT_THAT(json, Not(HasSubstr("\\u202e")));
  EXPECT_THAT(json, HasSubstr("a\uFFFDb"));
  EXPECT_EQ(grading::toJson(grading::gradeResultFromJson(json, "results.json")), json);
}

// Every test that tests/sandbox/README.md names for a promise is there.
TEST(Promises, NameTestsThatThereAre) {
  const std::filesystem::path root = homeFolder();
  const std::string page = fileText(root / "tests/sandbox/README.md");
  std::string tests;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(root / "tests"))
    if (entry.path().filename().string().ends_with("_test.cpp")) tests += fileText(entry.path());
  const std::regex name("`([A-Z]\\w+)\\.([A-Z]\\w+)`");
  int named = 0;
  for (std::sregex_iterator found(page.begin(), page.end(), name), end; found != end; ++found, ++named)
    EXPECT_THAT(tests, HasSubstr("(" + (*found)[1].str() + ", " + (*found)[2].str() + ")"));
  EXPECT_GE(named, 20);
}

}  // namespace rex::reports::hostile_text_test
