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
                            .attemptsFrom = "imports",
                            .work = submission::WorkTime{.seconds = 90, .parts = {{"step", 60}}}}},
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
  EXPECT_REX_ERROR(
      read(R"({"schema": "rex-import/1", "students": [{"student": "zoe", "exercises": {"01-kinematics": )"
           R"({"status": "handed_in", "work": {"seconds": "7"}}}}]})"),
      R"(students[0].exercises.01-kinematics.work: found {"seconds":"7"}, wanted seconds and parts)");
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

const std::vector<std::string> kExercises = {"01-kinematics"};

/// Gives names to people in the order of their submissions.
class ImportNamesTest : public ::testing::Test {
 protected:
  std::vector<std::string> namesOf(const std::vector<Person>& people, Platform platform = Platform::kMoodle) {
    DownloadedSubmissions submissions{.platform = platform};
    for (const Person& person : people) submissions.all.push_back({.people = {person}});
    ImportNames names(table_, submissions);
    std::vector<std::string> folders;
    for (const Person& person : people) folders.push_back(names.personFolder(person, kExercises));
    byNameAlone_ = names.knownByNameAlone();
    return folders;
  }
  using Names = std::vector<std::string>;
  ImportTable table_{};
  int byNameAlone_ = 0;
};

TEST_F(ImportNamesTest, AreTheFirstThatIsKnownAndCanBeAFolder) {
  EXPECT_EQ(namesOf({{.id = "31", .name = "Zoe", .email = "z@x"}}), Names{"31"});
  EXPECT_EQ(namesOf({{.name = "Yan", .email = "Y@X"}}), Names{"y@x"});
  EXPECT_EQ(namesOf({{.name = "Xi", .githubUsername = "Octo"}}), Names{"octo"});
  EXPECT_EQ(namesOf({{.id = "../etc", .name = "Wu"}}), Names{"Wu"});
  EXPECT_EQ(namesOf({{.name = "a/b", .number = "7"}}), Names{"participant-7"});
  EXPECT_EQ(namesOf({{}}), Names{"student-1"});
}

TEST_F(ImportNamesTest, TellPeopleOfOneNameApart) {
  EXPECT_EQ(namesOf({{.name = "Bo", .number = "4"}, {.name = "bO", .number = "5"}}), (Names{"Bo-4", "bO-5"}));
  EXPECT_EQ(byNameAlone_, 2);
  EXPECT_EQ(namesOf({{.name = "Zoe", .email = "a@x"}, {.name = "Zoe", .email = "b@x"}}),
            (Names{"a@x", "b@x"}));
  EXPECT_EQ(byNameAlone_, 0);
}

TEST_F(ImportNamesTest, StayOnceTheyAreGiven) {
  EXPECT_EQ(namesOf({{.name = "J\u00FCrgen Gro\u00DF"}}), Names{"J\u00FCrgen Gro\u00DF"});
  EXPECT_EQ(namesOf({{.name = "Ju\u0308rgen GROSS", .email = "j@x"}}), Names{"J\u00FCrgen Gro\u00DF"})
      << "the only one of that name, however it is written";
  EXPECT_EQ(namesOf({{.id = "31", .name = "J. G.", .email = "J@x"}}), Names{"J\u00FCrgen Gro\u00DF"});
  ASSERT_EQ(table_.students.size(), 1u);
  EXPECT_EQ(table_.students[0].id, "31");
  EXPECT_EQ(table_.students[0].email, "J@x");
  EXPECT_EQ(table_.students[0].name, "J. G.");
  EXPECT_EQ(namesOf({{.name = "J. G.", .email = "other@x"}}), Names{"other@x"})
      << "of that name, but another";
}

TEST_F(ImportNamesTest, BelieveTheIdentifierOfThePlatformForItsOwnExercise) {
  table_.students = {{.student = "zoe", .name = "Zoe"}};
  table_.students[0].exercises[kExercises[0]] = {.platform = "moodle", .identifier = "Participant 501"};
  EXPECT_EQ(namesOf({{.name = "Z. Miller", .identifier = "Participant 501"}}), Names{"zoe"});
  EXPECT_EQ(namesOf({{.name = "Yan", .identifier = "Participant 501"}}, Platform::kGradescope), Names{"Yan"});
}

}  // namespace rex::classroom::import_table_test
