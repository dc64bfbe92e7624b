#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cli/rex_command.h"
#include "support/file_text.h"
#include "support/paths.h"

namespace rex::cli::report_test {

using ::testing::HasSubstr;

class ReportCommand : public RexCommand {
 protected:
  static std::string golden(const std::string& name) { return sourcePath("tests/golden/reports/" + name); }
};

TEST_F(ReportCommand, PrintsOrWritesAFile) {
  const std::string wanted = fileText(golden("graded.junit"));
  const ProcessResult printed = rex({"report", golden("graded.results"), "--format", "junit"});
  EXPECT_EQ(printed.exitCode, 0);
  EXPECT_EQ(printed.output, wanted);
  const ProcessResult written = rex({"report", golden("graded.results"), "--format", "junit", "-o", "r.xml"});
  EXPECT_EQ(written.exitCode, 0);
  EXPECT_EQ(written.output, "");
  EXPECT_EQ(fileText(in("r.xml")), wanted);
}

TEST_F(ReportCommand, EndsByThreeWhereTheGraderFailedAndWritesAllTheSame) {
  const ProcessResult run = rex({"report", golden("fault.results"), "--format", "gradescope"});
  EXPECT_EQ(run.exitCode, 3);
  EXPECT_EQ(run.output, fileText(golden("fault.gradescope")));
  EXPECT_EQ(rex({"report", golden("not_compiled.results"), "--format", "gradescope"}).exitCode, 0);
}

TEST_F(ReportCommand, TellsWhatIsWrong) {
  const ProcessResult unknown = rex({"report", golden("graded.results"), "--format", "junt"});
  EXPECT_EQ(unknown.exitCode, 64);
  EXPECT_THAT(unknown.error, HasSubstr("--format: found junt, wanted one of github, gradescope,"));
  EXPECT_THAT(unknown.error, HasSubstr("junit"));
  const ProcessResult missing = rex({"report", "none.json", "--format", "junit"});
  EXPECT_EQ(missing.exitCode, 3);
  EXPECT_THAT(missing.error, HasSubstr("none.json: cannot read this file"));
  const ProcessResult other = rex({"report", golden("graded.junit"), "--format", "junit"});
  EXPECT_EQ(other.exitCode, 3);
  EXPECT_THAT(flat(other.error), HasSubstr("result file: not JSON"));
  const ProcessResult nowhere =
      rex({"report", golden("graded.results"), "--format", "junit", "-o", "no/r.xml"});
  EXPECT_EQ(nowhere.exitCode, 3);
  EXPECT_THAT(flat(nowhere.error), HasSubstr("cannot write the report"));
}

}  // namespace rex::cli::report_test
