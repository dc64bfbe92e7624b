// `rex import`, and what `rex grade` makes of it.
#include <sstream>

#include <nlohmann/json.hpp>

#include "base/process.h"
#include "base/text_file.h"
#include "commands/built_project.h"
#include "support/rounds.h"
#include "support/synthetic_class.h"

namespace rex::cli::import_test {

using ::testing::HasSubstr;
using ::testing::Not;
using Json = nlohmann::json;

constexpr const char* kExercise = "98-template";
constexpr const char* kWrong =
    "#include \"exercise.h\"\nEigen::Vector2d rotated(const Eigen::Vector2d& p, double) { return p; }\n"
    "int main() {}\n";

class ImportTest : public BuiltProject {
 protected:
  std::string in(const std::string& name) const { return (root() / name).string(); }
  Ended import(const std::string& platform, std::vector<std::string> more) const {
    more.insert(more.begin(), {"import", platform});
    more.insert(more.end(), {"-o", in("handed-in")});
    return rex(more);
  }
  Ended grade(std::vector<std::string> more = {}) const {
    more.insert(more.begin(),
                {"grade", in("handed-in"), "--out", in("results"), "--level", "0", "--i-accept-level", "0"});
    return rex(more);
  }
  std::string row(const std::string& student) const {
    std::istringstream lines(fileText(root() / "results/grades.csv"));
    for (std::string line; std::getline(lines, line);)
      if (line.starts_with(student + ",")) return line;
    return "";
  }
};

TEST_F(ImportTest, TakesAClassFromMoodleThatIsGradedByThePlatformsTimes) {
  const int count = rounds(12, 200);
  const auto all = syntheticClass(count, {kGood, kWrong, "int main() { return }\n"});
  writeTextFile(in("all.zip"), zipOf(moodleMembers(all, kExercise)));
  writeTextFile(in("sheet.csv"), moodleWorksheet(all));
  const Ended ended = import("moodle", {in("all.zip"), "--exercise", "98", "--worksheet", in("sheet.csv"),
                                        "--time-zone", "Europe/Berlin"});
  EXPECT_EQ(ended.code, 2) << "there are attacks";
  EXPECT_THAT(flat(ended.error),
              HasSubstr("José Peña_503_assignsubmission_file_/work.zip: this archive is not"));
  EXPECT_THAT(flat(ended.output),
              HasSubstr(count == 12 ? "10 handed in, 1 nothing, 1 not taken. Files: 9 new, 0 changed, "
                                      "0 as before. Times of submission: 10 from the platform."
                                    : "167 handed in, 16 nothing, 17 not taken."));
  writeTextFile(in("deadlines.toml"), "[all]\ndeadline = 2026-11-20T23:59:00+01:00\npoints_per_day = 1\n");
  // Three of them except in long runs: they take longest.
  if (!isLongRun())
    for (int k : {1, 4, 6, 7, 9, 10})
      fs::remove_all(root() / "handed-in" / all[static_cast<std::size_t>(k)].email);
  const Ended graded = grade({"--deadlines", in("deadlines.toml")});
  EXPECT_EQ(graded.code, 2);
  EXPECT_THAT(flat(graded.error), HasSubstr("student3@uni.example 98-template: not taken by the import: "));
  EXPECT_THAT(flat(graded.error), HasSubstr("from the platform, 0 from modification times of files"));
  EXPECT_THAT(row("student0@uni.example"), HasSubstr(",pass,0,0,"));
  EXPECT_THAT(row("student0@uni.example"), HasSubstr("," + syntheticInstant(all[0].time) + ",platform"));
  EXPECT_THAT(row("student2@uni.example"), HasSubstr(",compile_error,0,0,0,"));
  EXPECT_THAT(row("student5@uni.example"), HasSubstr(",pass,1,1,"));
  for (const SyntheticStudent& student : all) {
    if (!isLongRun() || row(student.email).empty()) continue;
    const bool isHonest = student.work == SyntheticWork::kHonest,
               isWrong = student.work == SyntheticWork::kWrong;
    EXPECT_THAT(row(student.email), HasSubstr(isHonest ? ",pass," : isWrong ? ",fail," : ",compile_error,"));
  }
  // A table of the lecturer's takes precedence.
  writeTextFile(in("times.csv"), "student,submitted\nstudent5@uni.example,2026-11-20T12:00:00Z\n");
  grade({"--deadlines", in("deadlines.toml"), "--submitted", in("times.csv")});
  EXPECT_THAT(row("student5@uni.example"), HasSubstr(",pass,0,0,"));
  EXPECT_THAT(row("student5@uni.example"), HasSubstr(",2026-11-20T12:00:00Z,table"));
}

TEST_F(ImportTest, TellsWhatHasChangedAndWhereTimesComeFrom) {
  writeTextFile(in("mails/zoe.cpp"), kGood);
  writeTextFile(in("mails/adam.cpp"), kGood);
  EXPECT_EQ(import("folders", {in("mails"), "--exercise", "template"}).code, 0);
  writeTextFile(in("mails/zoe.cpp"), kWrong);
  const Ended again = import("folders", {in("mails"), "--exercise", "template"});
  EXPECT_EQ(again.code, 0);
  EXPECT_THAT(flat(again.error),
              HasSubstr("Changed since an earlier import (1): zoe 98-template: handed in "));
  EXPECT_THAT(flat(again.output),
              HasSubstr("Files: 0 new, 1 changed, 1 as before. Times of submission: 2 from files, "
                        "which is when they were packed or copied."));
  EXPECT_THAT(again.output, HasSubstr("handed-in/import.json"));
}

TEST_F(ImportTest, TellsApartWhatWasNotTakenAndWhatIsToBeLookedAt) {
  writeTextFile(in("all.zip"), zipOf({{.name = "Zoe_1_assignsubmission_file_/main.cpp", .text = kGood},
                                      {.name = "Xi_3_assignsubmission_file_/main.cpp", .text = kWrong}}));
  writeTextFile(in("sheet.csv"), "Identifier,Full name\nParticipant 1,Zo\u200Be\n");
  const Ended ended = import("moodle", {in("all.zip"), "--exercise", "98", "--worksheet", in("sheet.csv")});
  EXPECT_EQ(ended.code, 0) << "all was taken";
  EXPECT_THAT(flat(ended.error),
              HasSubstr("Taken, but to be looked at (1): Xi_3_assignsubmission_file_: participant 3 is not"));
  EXPECT_THAT(flat(ended.error), HasSubstr("left out of the name 'Zoe', where nobody sees it: U+200B"));
  EXPECT_THAT(ended.error, Not(HasSubstr("Not taken")));
}

TEST_F(ImportTest, LeavesOutWhatIsAsItWasHandedOut) {
  if (!runProcess({"git", "--version"}).ok()) GTEST_SKIP() << "git is not installed";
  const fs::path clone = root() / "clones/hw-zoe";
  writeTextFile(clone / kExercise / "main.cpp", fileText(exercise() / "main.cpp"));
  for (const std::vector<std::string>& step :
       {std::vector<std::string>{"init", "-q"}, {"add", "-A"}, {"commit", "-qm", "work"}}) {
    std::vector<std::string> command = {
        "git", "-c", "user.name=x", "-c", "user.email=x@x", "-c", "commit.gpgsign=false"};
    command.insert(command.end(), step.begin(), step.end());
    ASSERT_TRUE(runProcess(command, {.directory = clone}).ok());
  }
  const Ended ended = import("git", {in("clones"), "--assignment", "hw", "--exercise", "98"});
  EXPECT_EQ(ended.code, 0) << ended.error;
  EXPECT_THAT(flat(ended.error), HasSubstr("hw-zoe/98-template/main.cpp: as it was handed out, not taken"));
  EXPECT_THAT(flat(ended.output), HasSubstr("0 handed in, 1 nothing, 0 not taken."));
  const Ended wrong = import("git", {in("clones"), "--deadline", "tomorrow"});
  EXPECT_EQ(wrong.code, 64);
  EXPECT_THAT(flat(wrong.error), HasSubstr("--deadline: found tomorrow, wanted a time with its zone"));
}

TEST_F(ImportTest, RefusesWhatItDoesNotKnow) {
  writeTextFile(in("other/a/b.txt"), "");
  const Ended other = import("moodle", {in("other")});
  EXPECT_EQ(other.code, 64);
  EXPECT_THAT(flat(other.error),
              HasSubstr("nothing that `rex import moodle` knows: found 1 file such as 'a/b.txt'"));
  EXPECT_FALSE(fs::exists(root() / "handed-in"));
  EXPECT_EQ(import("moodle", {in("none")}).code, 64);
  EXPECT_EQ(import("folders", {in("other"), "--exercise", "97"}).code, 64);
  const Ended inside = rex({"import", "folders", in("other"), "-o", in("other/handed-in")});
  EXPECT_EQ(inside.code, 64);
  EXPECT_THAT(flat(inside.error),
              HasSubstr("--out: found " + in("other/handed-in") + ", wanted a folder apart from"));
  writeTextFile(in("other/zoe.cpp"), kGood);
  writeTextFile(in("handed-in/import.json"), "{");
  EXPECT_EQ(import("folders", {in("other"), "--exercise", "98"}).code, 3);
}

TEST_F(ImportTest, IsAdvisedByGradeForDownloads) {
  writeTextFile(in("handed-in/Zoe_1_assignsubmission_file_/main.cpp"), kGood);
  const Ended ended = grade({"--manifest", in("tasks.tsv")});
  EXPECT_EQ(ended.code, 2);
  EXPECT_THAT(flat(ended.error),
              HasSubstr("`rex import moodle " + in("handed-in") + " -o HANDED_IN` makes a folder of"));
}

TEST_F(ImportTest, HasHelpForEachPlatform) {
  for (const char* platform : {"moodle", "git", "gradescope", "folders"}) {
    const Ended help = rex({"import", platform, "--help"});
    EXPECT_EQ(help.code, 0);
    EXPECT_THAT(help.output, HasSubstr(std::string("scripts/rex import ") + platform));
    EXPECT_THAT(help.output, HasSubstr("Exit codes: 0 all taken; 2 something was not"));
    EXPECT_THAT(rex({"import"}).output, HasSubstr(platform));
  }
}

}  // namespace rex::cli::import_test
