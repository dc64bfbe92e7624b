#include "submission/submission.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/text.h"
#include "base/text_file.h"
#include "grading/results.h"
#include "support/expect_error.h"
#include "support/paths.h"
#include "support/temporary_folder.h"

namespace rex::submission::submission_test {

using ::testing::HasSubstr;

// What no grader does wrong is tested with the whole program, in tests/commands; here the tools break.
class SubmissionTest : public ::testing::Test {
 protected:
  Submission submit(const Toolchain& toolchain, const std::string& main) const {
    return gradeSubmission(
        toolchain, ExerciseInfo{},
        {.main = main, .workFolder = temporary_.path() / "work", .job = {.results = results()}});
  }
  std::filesystem::path results() const { return temporary_.path() / "results.json"; }
  TemporaryFolder temporary_;
};

TEST_F(SubmissionTest, BlamesABrokenGraderNotTheStudent) {
  Toolchain toolchain;
  toolchain.grader = "/bin/sh";  // ends with an error for options that it does not know
  const Submission submission = submit(toolchain, "no/such/main.cpp");
  EXPECT_EQ(submission.result.outcome, grading::Outcome::kGraderError);
  EXPECT_THAT(submission.result.message, HasSubstr("the grader failed (exit code 2, signal 0): "));
  EXPECT_EQ(grading::loadResult(results()).outcome, grading::Outcome::kGraderError);
  toolchain.grader = "/no/such/grader";
  EXPECT_EQ(submit(toolchain, "no/such/main.cpp").result.outcome, grading::Outcome::kGraderError);
}

TEST_F(SubmissionTest, BlamesMissingTools) {
  Toolchain toolchain;
  toolchain.compiler = "no-such-compiler";
  toolchain.grader = "/bin/true";
  const Submission submission = submit(toolchain, sourcePath("share/template/solution.cpp"));
  EXPECT_EQ(submission.result.outcome, grading::Outcome::kGraderError);
  EXPECT_THAT(submission.result.message, HasSubstr("cannot run no-such-compiler"));
}

TEST_F(SubmissionTest, SaysWhenAGraderCannotList) {
  Toolchain toolchain;
  toolchain.grader = "/bin/false";
  EXPECT_REX_ERROR(listChecks(toolchain), "/bin/false: the grader cannot list its checks");
}

// A message of the file breaks its line where it wants.
TEST_F(SubmissionTest, LogsNoCommandToAServiceThatPrintsTheLog) {
  Toolchain toolchain;
  toolchain.compiler = "g++";
  toolchain.flags = {"-std=c++20"};
  toolchain.grader = "/bin/true";
  writeTextFile(temporary_.path() / "main.cpp",
                "static_assert(false, \"\\n::error::passed\\n \\t::notice::20 of 20 ##[error]###[x]\");\n");
  (void)submit(toolchain, (temporary_.path() / "main.cpp").string());
  const std::string log = readTextFile(temporary_.path() / "build.log");
  EXPECT_THAT(log, HasSubstr("\n| ::error::passed\n"));
  EXPECT_THAT(log, HasSubstr("::notice::20 of 20 # #[error]# # #[x]"));
  for (const std::string_view line : splitLines(log)) EXPECT_FALSE(trimmed(line).starts_with("::")) << line;
}

}  // namespace rex::submission::submission_test
