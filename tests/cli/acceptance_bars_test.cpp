// What the course asks of the student's loop, by number. Others of these bars are tested elsewhere: 2
// (pictures without a display) and 3 (floors, solutions, leaks) by the gates of the exercises and
// exercise/student-release, 4 (broken submissions) by cli/broken_submissions.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <stdlib.h>

#include "base/process.h"
#include "cli/template_project.h"
#include "grading/report.h"
#include "support/report_checker.h"

namespace rex::cli {
namespace {

using ::testing::HasSubstr;

class AcceptanceBars : public TemplateProject {
 protected:
  // A result file without what differs between two equal gradings.
  static nlohmann::json lasting(const fs::path& file) {
    auto json = nlohmann::json::parse(fileText(file));
    json.erase("volatile");
    return json;
  }
  nlohmann::json gradedInto(const std::string& folder, std::vector<std::string> more = {}) const {
    more.insert(more.begin(), {"test", "98", "-o", (root() / folder).string()});
    rex(more);
    return lasting(root() / folder / "results.json");
  }
  fs::path main() const { return exercise() / "main.cpp"; }
};

// A crash, a failure and a pass; from another folder, under another environment and in another tree.
TEST_F(AcceptanceBars, Bar05ResultsAreTheSameLocallyAndElsewhere) {
  write(main(), std::string(kGood).insert(std::string(kGood).find("  return"),
                                          "  if (a > 1.5) *(volatile int*)0 = 1;\n"));
  const auto here = gradedInto("here");
  ::setenv("CI", "true", 1);
  ::setenv("NO_COLOR", "1", 1);
  const auto elsewhere = gradedInto("a folder/elsewhere");
  ::unsetenv("CI");
  ::unsetenv("NO_COLOR");
  EXPECT_EQ(here, elsewhere);
  EXPECT_EQ(here.dump().find(root().string()), std::string::npos) << "paths of this machine";
  EXPECT_EQ(here.at("outcome"), "runtime_error");
}

// One check passes, two fail by random cases: other seeds give other numbers.
TEST_F(AcceptanceBars, Bar09TheSameSeedGivesTheSameBytes) {
  write(main(),
        std::string(kGood).replace(std::string(kGood).find("{std::cos(a)"), 12, "{1.01 * std::cos(a)"));
  const auto seven = gradedInto("one", {"--seed", "7"});
  EXPECT_EQ(seven.dump(), gradedInto("two", {"--seed", "7"}).dump());
  EXPECT_NE(seven.dump(), gradedInto("three", {"--seed", "8"}).dump());
}

// Of a full score, of less and of a file that does not compile. That replays are sound
// GLB files is tested by render/glb and, with another program, by scripts/check-replay.
TEST_F(AcceptanceBars, Bar10ReportsFitTheirSchemas) {
  REX_NEEDS_REPORT_CHECKER();
  const fs::path reports = root() / "reports";
  fs::create_directory(reports);
  const auto report = [&](const std::string& name, const std::string& source) {
    write(main(), source);
    rex({"test", "98", "-o", (root() / name).string()});
    fs::copy_file(root() / name / "results.json", reports / (name + ".results"));
    for (const grading::ReportFormat& format : grading::reportFormats())
      EXPECT_EQ(
          rex({"report", (root() / name / "results.json").string(), "--format", std::string(format.name),
               "-o", (reports / (name + "." + std::string(format.name))).string()})
              .code,
          0);
  };
  std::string half = kGood;
  report("full", half);
  report("below", half.replace(half.find("std::sin(a) * p.x()"), 19, "std::sin(a) * p.y()"));
  report("broken", "int main() { return \"|\" }");
  EXPECT_EQ(reportDifferences(reports), "");
}

TEST_F(AcceptanceBars, Bar11ExitCodesTellFullBelowNotGradableAndFault) {
  write(main(), kGood);
  EXPECT_EQ(rex({"test", "98"}).code, 0);
  replace(main(), "std::sin(a) * p.x()", "std::sin(a) * p.y()");
  EXPECT_EQ(rex({"test", "98"}).code, 1);
  write(main(), "int main() {");
  EXPECT_EQ(rex({"test", "98"}).code, 2);
  EXPECT_EQ(rexIn(root() / "no-build", {"test", "98"}).code, 3);
  EXPECT_EQ(rex({"test", "98", "--sed", "1"}).code, 64);
}

TEST_F(AcceptanceBars, Bar04ReadingStandardInputIsToldOfAndFindsItsEnd) {
  write(main(),
        "#include <iostream>\n#include \"exercise.h\"\n"
        "Eigen::Vector2d rotated(const Eigen::Vector2d& p, double) {\n  double x = 1;\n  std::cin >> x;\n"
        "  return x * p;\n}\nint main() { return rotated({1, 1}, 0).isOnes() && std::cin.eof() ? 0 : 7; }\n");
  const std::string warning = "main.cpp:5:8: warning: reads standard input, which is empty here";
  const Ended graded = rex({"test", "98"});
  EXPECT_EQ(graded.code, 1);
  EXPECT_THAT(flat(graded.output), HasSubstr(warning));
  const Ended run = rex({"run", "98"});
  EXPECT_EQ(run.code, 0) << "a read finds the end";
  EXPECT_THAT(flat(run.error), HasSubstr(warning));
}

}  // namespace
}  // namespace rex::cli
