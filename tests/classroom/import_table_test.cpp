#include "classroom/import_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/text_file.h"
#include "support/expect_error.h"
#include "support/paths.h"
#include "support/report_checker.h"
#include "support/temporary_folder.h"

namespace rex::classroom::import_table_test {

ImportTable sample() {
  return {{{.student = "zoe@uni.example",
            .id = "31",
            .name = "Zoë Müller",
            .email = "zoe@uni.example",
            .githubUsername = "zoem",
            .exercises = {{"01-kinematics",
                           {.platform = "moodle",
                            .identifier = "Participant 501",
                            .maximumGrade = "100.00",
                            .status = SubmissionStatus::kHandedIn,
                            .handedInBy = "zoe@uni.example",
                            .group = "Pair 1",
                            .submitted = 1'795'215'540,
                            .timeFrom = "platform",
                            .commit = "3f2a",
                            .source = "a/main.cpp",
                            .sha256 = "ab",
                            .attempts = 3,
                            .attemptsFrom = "imports"}},
                          {"02-control",
                           {.platform = "moodle", .status = SubmissionStatus::kRejected, .why = "a zip"}}}},
           {.student = "zz", .exercises = {{"01-kinematics", {.platform = "moodle"}}}}}};
}

class ImportTableTest : public ::testing::Test {
 protected:
  std::filesystem::path file() const { return folder_.path() / kImportTable; }
  ImportTable read(const std::string& text) const {
    writeTextFile(file(), text);
    return readImportTable(file());
  }
  TemporaryFolder folder_;
};

TEST_F(ImportTableTest, ComesBackAsItWasWritten) {
  EXPECT_TRUE(importTableIn(folder_.path()).students.empty());
  const ImportTable back = read(importTableText(sample()));
  EXPECT_EQ(back.students, sample().students);
  EXPECT_EQ(importTableText(back), importTableText(sample()));
  EXPECT_EQ(importTableIn(folder_.path()).students, sample().students);
  ASSERT_NE(back.find("zz"), nullptr);
  EXPECT_EQ(back.find("yy"), nullptr);
  EXPECT_EQ(back.find("zoe@uni.example", "02-control")->why, "a zip");
  EXPECT_EQ(back.find("zz", "02-control"), nullptr);
  EXPECT_EQ(back.find("yy", "02-control"), nullptr);
}

TEST_F(ImportTableTest, ConformsToItsSchema) {
  const ProcessResult found = runProcess({kPython, "-c", "import jsonschema"});
  if (!found.ok()) GTEST_SKIP() << "python3-jsonschema is not installed";
  const std::string check =
      "import json, jsonschema, sys\n"
      "jsonschema.validate(json.load(open(sys.argv[2])), json.load(open(sys.argv[1])))\n";
  const std::string schema = sourcePath("share/grading/import.schema.json");
  writeTextFile(file(), importTableText(sample()));
  EXPECT_TRUE(runProcess({kPython, "-c", check, schema, file().string()}).ok());
  std::string wrong = importTableText(sample());
  wrong.replace(wrong.find("not_taken"), 9, "lost");
  writeTextFile(file(), wrong);
  EXPECT_FALSE(runProcess({kPython, "-c", check, schema, file().string()}).ok());
}

TEST_F(ImportTableTest, AsksToGoOnAfterAnInterruption) {
  writeTextFile(folder_.path() / kBegunTable, importTableText(sample()));
  EXPECT_REX_ERROR(
      importTableIn(folder_.path()),
      ": an import into this folder was interrupted: wanted the same `rex import` again, which goes on");
}

TEST_F(ImportTableTest, SaysWhereItIsWrong) {
  EXPECT_REX_ERROR(
      read(R"({"schema": "rex-import/1", "students": [{"student": "zoe", "exercises": {"01-kinematics": )"
           R"({"status": "handed_in", "attempts": 0}}}]})"),
      "students[0].exercises.01-kinematics.attempts: found 0, wanted a number from 1 on");
  const std::string start = R"({"schema": "rex-import/1", "students": )";
  EXPECT_REX_ERROR(read("{"), "import.json: not a table of imports: found text that is not JSON");
  EXPECT_REX_ERROR(read("[]"), "not a table of imports: found no table");
  EXPECT_REX_ERROR(read("{}"), "not a table of imports: schema: found '', wanted rex-import/1");
  EXPECT_REX_ERROR(read(start + "3}"), "students: found no list, wanted a table that `rex import` wrote");
  EXPECT_REX_ERROR(read(start + R"([{"student": 3}]})"), "students[0].student: found 3, wanted a text");
  EXPECT_REX_ERROR(read(start + R"([{"student": "../x"}]})"),
                   "students[0].student: found an empty name, or one that");
  EXPECT_REX_ERROR(read(start + R"([{"student": "a"}, {"student": "a"}]})"), "found 'a' twice, wanted once");
  EXPECT_REX_ERROR(read(start + R"([{"student": "a", "exercises": 3}]})"),
                   "students[0].exercises: found no table");
  EXPECT_REX_ERROR(read(start + R"([{"student": "a", "exercises": {"x": {"status": "?"}}}]})"),
                   "students[0].exercises.x.status: found '?', wanted handed_in, nothing, not_taken");
  EXPECT_REX_ERROR(
      read(start + R"([{"student": "a", "exercises": {"x": {"status": "nothing", "submitted": "now"}}}]})"),
      "students[0].exercises.x.submitted: found 'now', wanted a time such as");
}

}  // namespace rex::classroom::import_table_test
