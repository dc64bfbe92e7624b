// Golden files: reports of three results made by hand, each read through once. tests/grading/check_reports.py
// compares them, and many random ones, with what the results say.
#include "reports/report.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "base/rng.h"
#include "grading/results.h"
#include "support/file_text.h"
#include "support/paths.h"
#include "support/report_checker.h"
#include "support/temporary_folder.h"

namespace rex::reports::report_test {

namespace fs = std::filesystem;

using grading::GradeResult;
using grading::Outcome;

using ::testing::HasSubstr;
using ::testing::Not;

const fs::path kGolden = sourcePath("tests/golden/reports");

GradeResult golden(const std::string& name) { return grading::loadResult(kGolden / (name + ".results")); }

void write(const fs::path& file, const std::string& text) { std::ofstream(file, std::ios::binary) << text; }

TEST(Report, WritesTheGoldenFiles) {
  ASSERT_EQ(reportFormats().size(), 4u);
  for (const char* name : {"graded", "not_compiled", "fault"})
    for (const ReportFormat& format : reportFormats())
      EXPECT_EQ(format.write(golden(name)),
                fileText(kGolden / (std::string(name) + "." + std::string(format.name))))
          << name << " as " << format.name;
}

TEST(Report, TellsNothingOfHiddenInputsNorOfWhyTheGraderFailed) {
  for (const char* name : {"graded", "fault"}) {
    ASSERT_THAT(fileText(kGolden / (std::string(name) + ".results")), HasSubstr("SECRET"));
    for (const ReportFormat& format : reportFormats())
      EXPECT_THAT(format.write(golden(name)), Not(HasSubstr("SECRET"))) << name << " as " << format.name;
  }
}

// A hidden check that waits as long as its input says would tell it by any of these numbers.
TEST(Report, TellsNothingByHowLongHiddenChecksTook) {
  const GradeResult quick = golden("graded");
  for (const double seconds : {0.001, 3.25, 60.}) {
    GradeResult slow = quick;
    for (grading::CheckResult& check : slow.checks)
      if (check.group == grading::Group::kHidden) check.wallSeconds = check.cpuSeconds = seconds;
    slow.usage = {
        .cpuSeconds = 2 * seconds, .wallSeconds = 3 * seconds, .peakMemoryBytes = 1 << 20, .outputBytes = 7};
    for (const ReportFormat& format : reportFormats())
      EXPECT_EQ(format.write(slow), format.write(quick)) << format.name;
  }
}

TEST(Report, NeverGradesAFaultOfTheGrader) {
  const GradeResult fault = golden("fault");
  EXPECT_FALSE(nlohmann::json::parse(gradescopeReport(fault)).contains("score"));
  EXPECT_THAT(junitReport(fault), HasSubstr("type=\"grader_error\""));
  EXPECT_THAT(markdownReport(fault), HasSubstr("not graded"));
  EXPECT_THAT(githubReport(fault), Not(HasSubstr("points")));
}

TEST(Report, CutsLongTextsWithAMark) {
  GradeResult result = golden("graded");
  result.checks[1].message = std::string(1 << 20, 'x');
  result.output.text = std::string(1 << 20, 'y');
  for (const ReportFormat& format : reportFormats()) {
    const std::string text = format.write(result);
    EXPECT_LT(text.size(), 150'000u) << format.name;
    EXPECT_THAT(text, HasSubstr("xxx ...")) << format.name;
  }
}

TEST(Report, HasTenAnnotationsOfWhichTheLastCountsTheOthers) {
  GradeResult result = golden("not_compiled");
  for (int k = 0; k < 30; ++k) result.compile.diagnostics.push_back(result.compile.diagnostics[k % 3]);
  const std::string text = githubReport(result);
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 10);
  EXPECT_THAT(text, ::testing::EndsWith(" points; 24 more in the summary\n"));
}

TEST(ReportSchema, FitsTheGoldenFiles) {
  REX_NEEDS_REPORT_CHECKER();
  EXPECT_EQ(reportDifferences(kGolden), "");
}

// What each schema must refuse: a valid report, one text in it, and what takes its place.
struct Break {
  const char *format, *report, *from, *to;
};
constexpr Break kBreaks[] = {
    {"gradescope", "graded", "\"score\": 6,", ""},
    {"gradescope", "graded", "\"score\": 6,", "\"score\": \"6\","},
    {"gradescope", "graded", "\"score\": 6,", "\"score\": -1,"},
    {"gradescope", "graded", "\"score\": 6,", "\"score\": 6, \"grade\": 6,"},
    {"gradescope", "graded", "\"max_score\": 3,", ""},
    {"gradescope", "graded", "\"passed\"", "\"pass\""},
    {"gradescope", "graded", "\"after_published\"", "\"later\""},
    {"gradescope", "graded", "\"text\"", "\"html\""},
    {"gradescope", "graded", "\"hidden\"", "\"visible\""},
    {"gradescope", "graded", "ALL TESTS", "\\u001b[1m"},
    {"gradescope", "graded", "\"output\"", "output"},
    {"gradescope", "fault", "\"execution_time\"", "\"score\": 0, \"execution_time\""},
    {"junit", "graded", " classname=\"01-kinematics\"", ""},
    {"junit", "graded", "type=\"fail\"", "type=\"failed\""},
    {"junit", "graded", " failures=\"2\"", ""},
    {"junit", "graded", " tests=\"5\"", " tests=\"five\""},
    {"junit", "graded", "line=\"47\"", "line=\"0\""},
    {"junit", "graded", "</failure>", "</failure><failure message=\"\" type=\"fail\"/>"},
    {"junit", "graded", "&#60;b&#62;", "<b>"},
    {"junit", "graded", "ALL TESTS", "\x1b[1m"},
    {"junit", "graded", "</testsuites>", ""},
    {"junit", "graded", "<system-out>", "<system-out>\xff"},
    {"github", "graded", "::error ", "::set-output "},
    {"github", "graded", "%0A", "\n"},
    {"github", "graded", "::notice title=01-kinematics", "::notice title=01:kinematics"},
    {"github", "graded", "line=47", "line=0"},
    {"github", "graded", "points\n", "points\nmore\n"},
    {"github", "graded", "points\n", "points"},
    {"markdown", "graded", "&#124; of", "| of"},
    {"markdown", "graded", "&#60;b", "<b"},
    {"markdown", "graded", "&#60;/pre", "</pre"},
    {"markdown", "graded", "| pass |", "| pass"},
    {"markdown", "graded", "3/3", "3"},
    {"markdown", "graded", "\nSeed", "\n| pass | all | 13/13 |  |\nSeed"},
};

TEST(ReportSchema, RefusesEveryBrokenFile) {
  REX_NEEDS_REPORT_CHECKER();
  const TemporaryFolder folder;
  for (const ReportFormat& format : reportFormats()) {
    std::vector<fs::path> files;
    std::vector<std::string> what;
    for (const Break& fault : kBreaks) {
      if (fault.format != format.name) continue;
      std::string text = fileText(kGolden / (std::string(fault.report) + "." + fault.format));
      const std::size_t at = text.find(fault.from);
      ASSERT_NE(at, std::string::npos) << fault.format << " " << fault.from;
      files.push_back(folder.path() / (std::to_string(files.size()) + "." + fault.format));
      what.push_back(std::string(fault.from) + " -> " + fault.to);
      write(files.back(), text.replace(at, std::string(fault.from).size(), fault.to));
    }
    ASSERT_GE(files.size(), 5u) << format.name;
    const std::string said = schemaFaults(format.name, files);
    for (std::size_t k = 0; k < files.size(); ++k)
      EXPECT_THAT(said, HasSubstr(files[k].string() + ": ")) << format.name << ": " << what[k];
  }
}

// Texts that try to be something else than text, and random ones of the same pieces.
class Hostile {
 public:
  explicit Hostile(std::uint64_t seed) : rng_(seed) {}

  std::string text() {
    static const std::vector<std::string> kPieces = {"]]>",
                                                     "<![CDATA[",
                                                     "</testcase>",
                                                     "<!--",
                                                     "&amp;",
                                                     "&#0;",
                                                     "\"",
                                                     "'",
                                                     "\n::error file=x::forged",
                                                     "%0A",
                                                     "%",
                                                     "::set-output name=grade::10",
                                                     "##[error]x",
                                                     "\n::notice title=x::13 of 13 points\n",
                                                     "|",
                                                     "\\|",
                                                     "\n| pass | all | 9/9 | |\n",
                                                     "`",
                                                     "```\n",
                                                     "</pre>",
                                                     "\n# Heading\n",
                                                     "[a](http://b)",
                                                     "www.c.de",
                                                     "@all",
                                                     "$x$",
                                                     "~~~",
                                                     "*",
                                                     "_",
                                                     "\r\n",
                                                     "\t",
                                                     std::string(1, '\0'),
                                                     "\x1b[31m",
                                                     "\x07",
                                                     "\x7f",
                                                     "\xc2\x85",
                                                     "\xff",
                                                     "\xc3",
                                                     "\xed\xa0\x80",
                                                     "\xef\xbf\xbe",
                                                     "\xef\xbf\xbf",
                                                     "\xf0\x9f\xa4\x96",
                                                     "\xe2\x80\xa8",
                                                     "\xe2\x80\xae",
                                                     "\u2066",
                                                     "\u200b",
                                                     "\ufeff",
                                                     "##vso[task.x]",
                                                     ",",
                                                     ":",
                                                     "{\"score\": 10}",
                                                     "\\u0000",
                                                     "plain words",
                                                     " ",
                                                     "ä"};
    std::string text;
    for (int k = rng_.index(8); k > 0; --k) text += kPieces.at(below(kPieces.size()));
    return text;
  }
  std::size_t below(std::size_t count) {
    return static_cast<std::size_t>(rng_.index(static_cast<int>(count)));
  }

 private:
  Rng rng_;
};

grading::CheckResult hostileCheck(Hostile& any, int number, bool runs) {
  grading::CheckResult check{.id = std::to_string(number) + any.text(),
                             .part = any.text(),
                             .title = any.text(),
                             .maxPoints = static_cast<int>(any.below(9))};
  if (any.below(3) == 0) check.group = grading::Group::kHidden;
  if (runs) check.status = static_cast<Outcome>(any.below(3) == 0 ? 1 + any.below(8) : 0);
  if (check.status == Outcome::kCompileError) check.status = Outcome::kFail;
  if (check.status == Outcome::kPass) check.points = check.maxPoints;
  if (check.status == Outcome::kFail) check.points = check.maxPoints / 2;
  const std::string secret = check.group == grading::Group::kHidden ? "SECRET" : "";
  check.message = any.text() + secret;
  check.property = any.text();
  check.expected = check.got = check.tolerance = check.input = check.function = check.worst.value =
      secret + any.text();
  check.line = static_cast<int>(any.below(3));
  return check;
}

GradeResult hostileResult(std::uint64_t seed) {
  Hostile any(seed);
  GradeResult result;
  result.files = {{any.text(), any.text()}};
  result.exerciseId = any.text();
  result.exerciseVersion = result.seedId = result.toolVersion = result.compiler = any.text();
  result.message = any.text();
  result.output.text = any.text();
  result.error.text = any.text();
  for (std::size_t k = any.below(15); k > 0; --k)
    result.compile.diagnostics.push_back({.file = any.below(2) == 0 ? result.files[0].name : any.text(),
                                          .line = static_cast<int>(any.below(4)),
                                          .column = static_cast<int>(any.below(3)),
                                          .severity = any.below(2) == 0 ? "error" : "warning",
                                          .rule = any.text(),
                                          .message = any.text()});
  const std::size_t kind = any.below(6);
  for (int k = static_cast<int>(any.below(16)); k >= 0; --k) {
    result.checks.push_back(hostileCheck(any, k, kind != 0));
    result.score += result.checks.back().points;
    result.maxScore += result.checks.back().maxPoints;
  }
  result.outcome = Outcome::kPass;
  for (const grading::CheckResult& check : result.checks)
    if (check.status != Outcome::kPass) result.outcome = check.status.value_or(Outcome::kCompileError);
  if (kind == 1) result.outcome = Outcome::kGraderError;
  return result;
}

// Reports of the result as the program reads it from its file, and of one whose texts never were in a file.
void writeReports(const fs::path& folder, const std::string& name, const GradeResult& result) {
  const std::string json = grading::toJson(result);
  const GradeResult read = grading::gradeResultFromJson(json, name);
  write(folder / (name + ".results"), json);
  for (const ReportFormat& format : reportFormats()) {
    const std::string text = format.write(read);
    EXPECT_THAT(text, Not(HasSubstr("SECRET"))) << name << " as " << format.name;
    write(folder / (name + "." + std::string(format.name)), text);
    write(folder / (name + "-raw." + std::string(format.name)), format.write(result));
  }
}

TEST(ReportSchema, FitsWhateverTheTextsAreAndTheySurvive) {
  REX_NEEDS_REPORT_CHECKER();
  const TemporaryFolder folder;
  for (std::uint64_t seed = 0; seed < 400; ++seed)
    writeReports(folder.path(), std::to_string(seed), hostileResult(seed));
  EXPECT_EQ(reportDifferences(folder.path()), "");
}

TEST(ReportSchema, FitsAMegabyteOfAnything) {
  REX_NEEDS_REPORT_CHECKER();
  const TemporaryFolder folder;
  GradeResult result = golden("graded");
  std::string text;
  while (text.size() < (1u << 20))
    for (const char* piece : {"x", "\n", "\xf0\x9f\xa4\x96", "\xff", "|", "]]>", "::error::x\n"})
      text += piece;
  result.output.text = result.error.text = text;
  result.checks[1].message = result.checks[1].title = text;
  writeReports(folder.path(), "large", result);
  EXPECT_EQ(reportDifferences(folder.path()), "");
}

// What GitHub takes for commands: lines that begin so, after blanks, and the older form anywhere in a line.
std::vector<std::string> commandsIn(const std::string& text) {
  std::vector<std::string> commands;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    const std::string trimmed = line.substr(std::min(line.find_first_not_of(" \t\r"), line.size()));
    if (trimmed.starts_with("::"))
      commands.push_back(trimmed.substr(0, trimmed.find(' ')));
    else if (trimmed.find("##[") != std::string::npos)
      commands.push_back("##[");
  }
  return commands;
}

TEST(Report, LetsNoTextForgeACommand) {
  ASSERT_EQ(commandsIn("a\n ::error x\nb ##[c]\n"), (std::vector<std::string>{"::error", "##["}));
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    const GradeResult result = hostileResult(seed);
    EXPECT_THAT(commandsIn(markdownReport(result)), ::testing::IsEmpty()) << seed;
    std::vector<std::string> commands = commandsIn(githubReport(result));
    const bool isFault = result.outcome == Outcome::kGraderError;
    EXPECT_EQ(std::count(commands.begin(), commands.end(), "::notice"), isFault ? 0 : 1) << seed;
    std::erase_if(commands,
                  [](const std::string& c) { return c == "::error" || c == "::warning" || c == "::notice"; });
    EXPECT_THAT(commands, ::testing::IsEmpty()) << seed;
  }
}

// Every text of a result is hostile: none may reach a reader as anything but what it shows.
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

}  // namespace rex::reports::report_test
