// `rex grade`, `grade-one` and `collect` on small classes of students.
#include <algorithm>
#include <sstream>

#include <fcntl.h>
#include <nlohmann/json.hpp>
#include <sys/stat.h>

#include "base/text_file.h"
#include "cli/command_schema.h"
#include "cli/template_project.h"
#include "grading/result_file.h"
#include "support/rounds.h"

namespace rex::cli::grade_many_test {

using ::testing::HasSubstr;
using ::testing::Not;
using Json = nlohmann::json;

constexpr const char* kBroken = "int main() { return }\n";
constexpr const char* kWrong =
    "#include \"exercise.h\"\nEigen::Vector2d rotated(const Eigen::Vector2d& p, double) { return p; }\n"
    "int main() {}\n";

class GradeManyTest : public TemplateProject {
 protected:
  fs::path in() const { return root() / "in"; }
  fs::path results() const { return root() / "results"; }
  void handIn(const std::string& student, const std::string& text,
              const std::string& exercise = "98-template") const {
    fs::create_directories(in() / student / exercise);
    write(in() / student / exercise / "main.cpp", text);
    setTime(student, exercise);
  }
  // Of the table; tests tell the times of files.
  void setTime(const std::string& student, const std::string& exercise, long seconds = 1'700'000'000) const {
    const timespec times[2] = {{seconds, 0}, {seconds, 0}};
    ::utimensat(AT_FDCWD, (in() / student / exercise / "main.cpp").c_str(), times, 0);
  }
  Ended gradeAnew(std::vector<std::string> more = {}, const std::string& out = "results") const {
    std::vector<std::string> arguments = {
        "grade", in().string(), "--out", (root() / out).string(), "--level", "0", "--i-accept-level", "0"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return rex(arguments);
  }
  // With the programs that other tests have compiled, for most tests are not about compiling.
  Ended grade(std::vector<std::string> more = {}, const std::string& out = "results") const {
    more.insert(more.end(), {"--workers", REX_BINARY_DIR "/tests/template/workers"});
    return gradeAnew(std::move(more), out);
  }
  std::string table(const std::string& out = "results") const {
    return fileText(root() / out / "grades.csv");
  }
  Json result(const std::string& student, const std::string& out = "results") const {
    return Json::parse(fileText(root() / out / student / "98-template" / "results.json"));
  }
  // The row of a student without the time at its end.
  std::string row(const std::string& student) const {
    std::istringstream lines(table());
    for (std::string line; std::getline(lines, line);)
      if (line.starts_with(student + ",")) return line.substr(0, line.find(",2023-"));
    return "";
  }
};

TEST_F(GradeManyTest, GradesAClassAndTellsWhatItCouldNotTake) {
  handIn("good", kGood), handIn("wrong", kWrong, "98"), handIn("broken", kBroken);
  fs::create_directories(in() / "late" / "98-template");
  fs::create_directories(in() / "lost" / "98-tempalte");
  const Ended ended = grade({"-j2"});
  EXPECT_EQ(ended.code, 2) << ended.error;
  const int full = result("good").at("max_score");
  EXPECT_EQ(row("good"), "good,98-template," + std::to_string(full) + "," + std::to_string(full) +
                             ",pass,0,0," + std::to_string(full));
  EXPECT_THAT(row("wrong"), HasSubstr(",fail,0,0,"));
  EXPECT_THAT(row("broken"),
              HasSubstr("broken,98-template,0," + std::to_string(full) + ",compile_error,0,0,0"));
  EXPECT_THAT(table(), HasSubstr("late,98-template,0," + std::to_string(full) + ",compile_error,"));
  EXPECT_THAT(flat(ended.error),
              HasSubstr("late/98-template/main.cpp: cannot be graded: found no file, wanted a "
                        "C++ source file"));
  EXPECT_THAT(flat(ended.error), HasSubstr("no exercise is called '98-tempalte'"));
  EXPECT_THAT(flat(ended.error), HasSubstr("did you mean '98-template'?"));
  EXPECT_THAT(flat(ended.error),
              HasSubstr("4 submissions at sandbox level 0: 4 graded, 0 kept, 3 could not"));
  EXPECT_EQ(fileText(results() / "good" / "98-template" / "main.cpp"), kGood);
  EXPECT_THAT(fileText(results() / "broken" / "98-template" / "build.log"), HasSubstr("main.cpp"));
}

TEST_F(GradeManyTest, WritesTheSameBytesWhateverRunsAtOnce) {
  for (const char* student : {"zoe", "adam", "=1+2", "o'hara \"x\"", "Müller, Änne"})
    handIn(student, std::string(student) == "zoe" ? kGood : kBroken);
  EXPECT_EQ(gradeAnew({"-j1"}, "one").code, 0);
  EXPECT_EQ(gradeAnew({"-j4"}, "four").code, 0);
  EXPECT_EQ(table("one"), table("four"));
  EXPECT_THAT(table("one"), HasSubstr("\n'=1+2,98-template,"));
  EXPECT_EQ(fileText(root() / "one/tasks.tsv"), fileText(root() / "four/tasks.tsv"));
  for (const char* student : {"zoe", "adam", "o'hara \"x\""}) {
    Json one = result(student, "one"), four = result(student, "four");
    one.erase("volatile"), four.erase("volatile");
    EXPECT_EQ(one, four);
  }
  EXPECT_EQ(gradeAnew({"--csv"}, "one").output, table("four"));
}

TEST_F(GradeManyTest, TakesWhatSubmitWrites) {
  write(exercise() / "main.cpp", kBroken);
  fs::create_directories(in());
  EXPECT_EQ(rex({"submit", "98", "-o", (in() / "zoe.zip").string()}).code, 0);
  EXPECT_EQ(grade().code, 0);
  EXPECT_THAT(table(), HasSubstr("\nzoe,98-template,0,"));
  EXPECT_EQ(fileText(results() / "zoe" / "98-template" / "main.cpp"), kBroken);
}

TEST_F(GradeManyTest, RefusesWeakSandboxesUnlessTheyAreAccepted) {
  handIn("good", kGood);
  for (const std::vector<std::string>& level :
       {std::vector<std::string>{"--level", "0"}, {"--level", "0", "--i-accept-level", "1"}}) {
    std::vector<std::string> arguments = {"grade", in().string(), "--out", results().string()};
    arguments.insert(arguments.end(), level.begin(), level.end());
    const Ended ended = rex(arguments);
    EXPECT_EQ(ended.code, 4);
    EXPECT_THAT(flat(ended.error), HasSubstr("sandbox level 0 is not for work of strangers"));
    EXPECT_THAT(flat(ended.error), HasSubstr("--i-accept-level 0"));
  }
  EXPECT_FALSE(fs::exists(results()));
  EXPECT_EQ(grade().code, 0);
}

TEST_F(GradeManyTest, GradesAgainOnlyWhatHasChanged) {
  handIn("adam", kBroken), handIn("bob", kBroken), handIn("carl", kBroken);
  EXPECT_EQ(grade().code, 0);
  const std::string before = table();
  const auto kept = [](const std::string& text) { return HasSubstr(text); };
  EXPECT_THAT(flat(grade().error), kept("0 graded, 3 kept"));
  EXPECT_EQ(table(), before);
  setTime("bob", "98-template");  // a time is not a change
  EXPECT_THAT(flat(grade().error), kept("0 graded, 3 kept"));
  handIn("bob", "int main() {\n");
  EXPECT_THAT(flat(grade().error), kept("1 graded, 2 kept"));
  EXPECT_THAT(flat(grade({"--seed", "5"}).error), kept("3 graded, 0 kept"));
  EXPECT_EQ(result("adam").at("seed_id"), "public:5");
  write(root() / "secret", "the secret of the course\n");
  const std::string secret = (root() / "secret").string();
  EXPECT_THAT(flat(grade({"--secret-file", secret}).error), kept("3 graded, 0 kept"));
  EXPECT_THAT(std::string(result("adam").at("seed_id")), HasSubstr(" hidden:"));
  EXPECT_THAT(flat(grade({"--secret-file", secret}).error), kept("0 graded, 3 kept"));
  EXPECT_THAT(flat(grade({"--secret-file", secret, "--regrade"}).error), kept("3 graded, 0 kept"));
  // Another description of the exercise may grade otherwise.
  replace(exercise() / "exercise.toml", "title = \"", "title = \"New ");
  EXPECT_THAT(flat(grade({"--secret-file", secret}).error), kept("3 graded, 0 kept"));
  // What is no longer a result.
  write(results() / "carl/98-template/results.json", "{}");
  fs::remove(results() / "adam/98-template/results.json");
  EXPECT_THAT(flat(grade({"--secret-file", secret}).error), kept("2 graded, 1 kept"));
}

// Programs are kept by what they were made of: another seed takes the same one, other files never do.
TEST_F(GradeManyTest, KeepsCompiledProgramsForOtherSeeds) {
  handIn("good", kGood), handIn("wrong", kWrong), handIn("broken", kBroken);
  const std::vector<std::string> seven = {"--seed", "7"},
                                 kept = {"--seed", "7", "--workers", (root() / "workers").string()};
  EXPECT_EQ(gradeAnew(seven, "plain").code, 0);
  for (const char* out : {"first", "second"}) {
    EXPECT_EQ(gradeAnew(kept, out).code, 0);
    EXPECT_EQ(table(out), table("plain"));
    for (const char* student : {"good", "wrong", "broken"}) {
      Json with = result(student, out), without = result(student, "plain");
      with.erase("volatile"), without.erase("volatile");
      EXPECT_EQ(with, without) << student;
      const fs::path log = fs::path(student) / "98-template" / "build.log";
      EXPECT_EQ(fileText(root() / out / log), fileText(root() / "plain" / log));
    }
  }
  std::vector<fs::path> folders;
  for (const auto& entry : fs::directory_iterator(root() / "workers")) folders.push_back(entry.path());
  ASSERT_EQ(folders.size(), 2u) << "what does not compile is not kept, nothing else is left";
  EXPECT_EQ(fs::status(root() / "workers").permissions(), fs::perms::owner_all);
  // Proof that they are taken: exchanged, they give each other's grades.
  fs::rename(folders[0], root() / "exchanged");
  fs::rename(folders[1], folders[0]);
  fs::rename(root() / "exchanged", folders[1]);
  EXPECT_EQ(gradeAnew({"--seed", "8", "--workers", (root() / "workers").string()}, "third").code, 0);
  EXPECT_EQ(result("wrong", "third").at("score"), result("good", "plain").at("score"));
  EXPECT_EQ(result("good", "third").at("score"), result("wrong", "plain").at("score"));
  EXPECT_EQ(gradeAnew({"--seed", "8"}, "fourth").code, 0);
  EXPECT_EQ(result("good", "fourth").at("outcome"), "pass");
}

// As a power cut or a bad disk leaves them.
TEST_F(GradeManyTest, CompilesAnewWhereAKeptProgramIsDamaged) {
  handIn("good", kGood);
  const fs::path workers = root() / "workers";
  int seed = 10;
  const auto gradedAgain = [&] {
    EXPECT_EQ(gradeAnew({"--workers", workers.string(), "--seed", std::to_string(++seed)}).code, 0);
    return row("good");
  };
  const std::string whole = gradedAgain();
  EXPECT_THAT(whole, HasSubstr(",pass,"));
  const fs::path kept = fs::directory_iterator(workers)->path();
  const std::string worker = fileText(kept / "worker"), start = fileText(kept / "start.json");
  const auto expectRebuilt = [&](const char* name, const std::string& text) {
    write(kept / name, text);
    EXPECT_EQ(gradedAgain(), whole) << name << " of " << text.size() << " bytes";
    EXPECT_FALSE(fileText(kept / name) == text) << name << " of " << text.size() << " bytes";
  };
  std::string bent = worker;
  bent[bent.size() / 2] ^= 1;
  expectRebuilt("worker", bent);
  expectRebuilt("start.json", start.substr(0, start.size() / 2));
  expectRebuilt("main.cpp", kWrong);
  if (isLongRun()) {  // each of them compiles
    for (const std::string& text :
         {std::string(), worker.substr(0, worker.size() / 2), worker.substr(0, worker.size() - 4096)})
      expectRebuilt("worker", text);
    for (const char* text : {"", "{}"}) expectRebuilt("start.json", text);
    expectRebuilt("build.log", "another");
  }
  fs::remove(kept / "worker");
  EXPECT_EQ(gradedAgain(), whole);
#ifndef __SANITIZE_ADDRESS__  // the lines for their reports name the temporary folder
  EXPECT_TRUE(fileText(kept / "worker") == worker);
#endif
}

TEST_F(GradeManyTest, CompilesAnewWhenAskedToRegrade) {
  handIn("good", kGood);
  const std::string workers = (root() / "workers").string();
  EXPECT_EQ(gradeAnew({"--workers", workers}).code, 0);
  const fs::path kept = fs::directory_iterator(workers)->path();
  const auto before = fs::last_write_time(kept / "worker");
  EXPECT_EQ(gradeAnew({"--workers", workers, "--seed", "5"}).code, 0);
  EXPECT_EQ(fs::last_write_time(kept / "worker"), before);
  EXPECT_EQ(gradeAnew({"--workers", workers, "--regrade"}).code, 0);
  EXPECT_NE(fs::last_write_time(kept / "worker"), before);
}

TEST_F(GradeManyTest, SaysWhereProgramsCannotBeKept) {
  handIn("good", kGood);
  write(root() / "workers", "no folder");
  const Ended ended = gradeAnew({"--workers", (root() / "workers").string()});
  EXPECT_EQ(ended.code, 3);
  EXPECT_THAT(flat(ended.error), HasSubstr("cannot keep programs in"));
}

TEST_F(GradeManyTest, RepeatsWhatTheGraderFailedAt) {
  handIn("adam", kGood);
  EXPECT_EQ(grade().code, 0);
  Json json = result("adam");
  json["outcome"] = "grader_error";
  write(results() / "adam/98-template/results.json", json.dump());
  const Ended collected = rex({"collect", results().string()});
  EXPECT_EQ(collected.code, 3);
  EXPECT_THAT(flat(collected.error), HasSubstr("the grader failed: tasks 1 adam 98-template To repeat: 1"));
  EXPECT_EQ(row("adam"), "adam,98-template,,,grader_error,,,") << "never a zero";
  EXPECT_THAT(flat(grade().error), HasSubstr("1 graded, 0 kept"));
  EXPECT_THAT(row("adam"), HasSubstr(",pass,"));
}

TEST_F(GradeManyTest, CountsDaysAndSaysWhereTimesComeFrom) {
  handIn("adam", kGood), handIn("bob", kGood), handIn("carl", kGood);
  const int full = [&] {
    EXPECT_EQ(grade().code, 0);
    return result("adam").at("max_score").get<int>();
  }();
  // The files were modified on 2023-11-14 at 22:13:20.
  write(
      root() / "deadlines.toml",
      "[exercise.98-template]\ndeadline = 2023-11-13T22:13:00Z\npoints_per_day = 1\ncap_points = 2\n"
      "[exercise.98-template.extensions]\ncarl = 2023-11-14T23:13:20+01:00\ncarol = 2024-01-01T00:00:00Z\n");
  write(root() / "times.csv", "student,submitted\nbob,2023-11-13T12:00:00Z\n");
  const Ended ended = grade(
      {"--deadlines", (root() / "deadlines.toml").string(), "--submitted", (root() / "times.csv").string()});
  EXPECT_EQ(ended.code, 0);
  EXPECT_THAT(flat(ended.error), HasSubstr("0 graded, 3 kept")) << "a policy changes no result";
  EXPECT_THAT(flat(ended.error), HasSubstr("times.csv, 2 from modification times of files"));
  EXPECT_THAT(flat(ended.error), HasSubstr("'carol' has an extension for 98-template and handed in nothing"));
  EXPECT_THAT(table(), HasSubstr(",2,2," + std::to_string(full - 2) + ",2023-11-14T22:13:20Z,file\n"));
  EXPECT_THAT(table(), HasSubstr("\nbob,98-template," + std::to_string(full) + "," + std::to_string(full) +
                                 ",pass,0,0," + std::to_string(full) + ",2023-11-13T12:00:00Z,table\n"));
  EXPECT_THAT(row("carl"), HasSubstr(",pass,0,0,"));
  write(root() / "deadlines.toml", "[exercise.97-x]\n");
  EXPECT_EQ(grade({"--deadlines", (root() / "deadlines.toml").string()}).code, 3);
}

TEST_F(GradeManyTest, GradesTasksOneByOneToTheSameTable) {
  handIn("adam", kGood), handIn("bob", kBroken), handIn("carl", kWrong);
  EXPECT_EQ(grade({}, "whole").code, 0);
  const std::string manifest = (root() / "tasks.tsv").string(), out = results().string();
  EXPECT_EQ(grade({"--manifest", manifest}).code, 0);
  EXPECT_FALSE(fs::exists(results() / "grades.csv"));
  const Ended nothing = rex({"collect", out, "--manifest", manifest});
  EXPECT_EQ(nothing.code, 3);
  EXPECT_THAT(flat(nothing.error), HasSubstr("no result: tasks 1-3"));
  const auto one = [&](const std::string& task) {
    return rex({"grade-one", "--manifest", manifest, "--task", task, "--out", out});
  };
  for (const char* task : {"3", "1"}) EXPECT_EQ(one(task).code, 0);
  EXPECT_THAT(flat(rex({"collect", out, "--manifest", manifest}).error), HasSubstr("To repeat: 2"));
  EXPECT_THAT(one("2").output, HasSubstr("bob 98-template: compile_error, 0 of "));
  EXPECT_EQ(one("2").output, "bob 98-template: kept\n");
  const Ended all = rex({"collect", out, "--manifest", manifest, "--csv"});
  EXPECT_EQ(all.code, 0) << all.error;
  EXPECT_EQ(all.output, table("whole"));
  EXPECT_EQ(table(), table("whole"));
}

TEST_F(GradeManyTest, GradesNothingThatTheListOfTasksDoesNotMean) {
  handIn("adam", kGood);
  const std::string manifest = (root() / "tasks.tsv").string();
  EXPECT_EQ(grade({"--manifest", manifest}).code, 0);
  const auto one = [&](const std::string& task) {
    return rex({"grade-one", "--manifest", manifest, "--task", task, "--out", results().string()});
  };
  EXPECT_EQ(one("0").code, 64);
  EXPECT_THAT(one("2").error, HasSubstr("--task: found 2, wanted 1 to 1"));
  write(results() / "adam/98-template/main.cpp", kWrong);
  EXPECT_EQ(one("1").code, 3);
  EXPECT_THAT(flat(one("1").error), HasSubstr("is not the one that the list of tasks was written for"));
  write(results() / "adam/98-template/main.cpp", kGood);
  replace(exercise() / "exercise.toml", "title = \"", "title = \"New ");
  EXPECT_THAT(flat(one("1").error), HasSubstr("the grader of 98-template is not the one"));
  EXPECT_FALSE(fs::exists(results() / "adam/98-template/results.json"));
}

TEST_F(GradeManyTest, AsksForTheSecretOfTheList) {
  handIn("adam", kGood);
  write(root() / "secret", "the secret of the course\n");
  write(root() / "short", "secret\n");
  const std::string manifest = (root() / "tasks.tsv").string();
  EXPECT_THAT(grade({"--secret-file", (root() / "short").string()}).error, HasSubstr("is too short"));
  EXPECT_EQ(grade({"--manifest", manifest, "--secret-file", (root() / "secret").string()}).code, 0);
  const Ended ended = rex({"grade-one", "--manifest", manifest, "--task", "1", "--out", results().string()});
  EXPECT_EQ(ended.code, 3);
  EXPECT_THAT(flat(ended.error), HasSubstr("the secret of the course: found none, wanted "));
}

TEST_F(GradeManyTest, WritesReportsBesideResultsWithoutGradingAgain) {
  handIn("adam", kGood), handIn("bob", kBroken);
  const fs::path summary = results() / "adam/98-template/summary.md",
                 junit = results() / "bob/98-template/junit.xml";
  EXPECT_EQ(grade().code, 0);
  EXPECT_FALSE(fs::exists(summary));
  const Ended first = grade({"--reports=markdown,junit"});
  EXPECT_EQ(first.code, 0) << first.error;
  EXPECT_THAT(flat(first.error),
              HasSubstr("Reports: 4 written, 0 kept 2 submissions at sandbox level 0: 0 graded"));
  const std::string expected = fileText(summary);
  EXPECT_THAT(expected, HasSubstr(" points\n\nadam\n\n- Final grade: "));
  EXPECT_THAT(fileText(junit), HasSubstr("<testsuite"));
  fs::remove(summary);
  write(junit, "half a rep");
  EXPECT_THAT(flat(grade({"--reports=markdown,junit"}).error),
              HasSubstr("Reports: 2 written, 2 kept 2 submissions at sandbox level 0: 0 graded, 2 kept"));
  EXPECT_EQ(fileText(summary), expected);
  handIn("adam", kWrong);
  EXPECT_THAT(flat(grade({"--reports"}).error), HasSubstr("Reports: 1 written, 1 kept")) << "alone: markdown";
  EXPECT_NE(fileText(summary), expected);
  // What was made of a result goes with it.
  fs::remove(results() / "bob/98-template/results.json");
  EXPECT_EQ(rex({"collect", results().string(), "--reports=junit"}).code, 3);
  EXPECT_FALSE(fs::exists(junit));
  const Ended unknown = grade({"--reports=markdwn"});
  EXPECT_EQ(unknown.code, 64);
  EXPECT_THAT(flat(unknown.error), HasSubstr("--reports: found markdwn, wanted one of exercism, github"));
  EXPECT_THAT(flat(unknown.error), HasSubstr("did you mean 'markdown'?"));
}

// A report of an earlier result would carry a wrong grade.
TEST_F(GradeManyTest, KeepsNoReportLongerThanItsResult) {
  handIn("adam", kGood), handIn("bob", kGood);
  const fs::path adam = results() / "adam/98-template", bob = results() / "bob/98-template";
  EXPECT_EQ(grade({"--reports=markdown,gradescope"}).code, 0);
  const std::string summary = fileText(bob / "summary.md");
  handIn("adam", kWrong);
  EXPECT_EQ(grade().code, 0);
  EXPECT_FALSE(fs::exists(adam / "summary.md"));
  EXPECT_FALSE(fs::exists(adam / "gradescope.json"));
  EXPECT_EQ(fileText(bob / "summary.md"), summary) << "its result is the same";
  write(bob / "summary.md", "8 of 8");
  EXPECT_THAT(flat(rex({"collect", results().string()}).error), HasSubstr("Reports: 1 written, 0 kept"));
  EXPECT_EQ(fileText(bob / "summary.md"), summary) << "outdated, and renewed though nobody asked";
  fs::remove(bob / "results.json");
  EXPECT_EQ(rex({"collect", results().string()}).code, 3);
  EXPECT_FALSE(fs::exists(bob / "summary.md"));
  EXPECT_FALSE(fs::exists(bob / "gradescope.json"));
}

TEST_F(GradeManyTest, BelievesNoResultThatWasEdited) {
  handIn("adam", kWrong);
  EXPECT_EQ(grade({"--reports"}).code, 0);
  const fs::path file = results() / "adam/98-template/results.json";
  const std::string whole = fileText(file), before = row("adam");
  Json json = result("adam");
  const int possible = json.at("max_score");
  json["score"] = possible;
  write(file, json.dump());
  const Ended collected = rex({"collect", results().string()});
  EXPECT_EQ(collected.code, 3);
  EXPECT_THAT(flat(collected.error),
              HasSubstr("a result that was changed after the grading: tasks 1 adam 98-template"));
  EXPECT_THAT(flat(collected.error), HasSubstr("results.json: a result that does not add up: score: found " +
                                               std::to_string(possible) + ", wanted "));
  EXPECT_EQ(row("adam"), "adam,98-template,,,refused,,,") << "never a grade";
  EXPECT_FALSE(fs::exists(file.parent_path() / "summary.md"));
  EXPECT_EQ(rex({"report", file.string(), "--format", "markdown"}).code, 3);
  // It adds up, but is not what the grader wrote.
  json = Json::parse(whole);
  json["message"] = "well done";
  write(file, json.dump());
  EXPECT_EQ(rex({"collect", results().string()}).code, 3);
  const Ended report = rex({"report", file.string(), "--format", "markdown"});
  EXPECT_EQ(report.code, 3);
  EXPECT_THAT(flat(report.error), HasSubstr("results.json: a result that was changed after the grading"));
  json = Json::parse(whole);
  json["exercise"]["id"] = "97-other";
  json["inputs"]["result_sha256"] = grading::sealOf(json.dump(), "");
  write(file, json.dump());
  EXPECT_THAT(flat(rex({"collect", results().string()}).error),
              HasSubstr("a result of another exercise: found '97-other', wanted '98-template'"));
  const Ended again = grade();
  EXPECT_EQ(again.code, 0);
  EXPECT_THAT(flat(again.error), HasSubstr("wanted '98-template'; it is graded again"));
  EXPECT_THAT(flat(again.error), HasSubstr("1 graded, 0 kept"));
  EXPECT_EQ(row("adam"), before);
}

TEST_F(GradeManyTest, TellsWithOnlyWhatItCouldNotTake) {
  fs::create_directories(in() / "adam_501_assignsubmission_file_");
  write(in() / "adam_501_assignsubmission_file_/main.cpp", kGood);
  handIn("bob", kGood);
  const Ended ended = grade({"--only", "98", "--manifest", (root() / "tasks.tsv").string()});
  EXPECT_EQ(ended.code, 2);
  EXPECT_THAT(flat(ended.error),
              HasSubstr("nothing to grade: found no exercise folder, wanted 98-template/main.cpp"));
}

TEST_F(GradeManyTest, TellsWithOnlyWhatItsTablesLeaveOut) {
  handIn("adam", kGood);
  EXPECT_THAT(grade().error, Not(HasSubstr("alone")));
  const fs::path list = results() / "tasks.tsv";
  write(list, readTextFile(list) + "2\tadam\t97-other\n");
  EXPECT_THAT(flat(grade({"--only", "98"}).error),
              HasSubstr("results/tasks.tsv and grades.csv now list 98-template alone; the results of 1 other "
                        "submission stay, and are listed again by rex grade without --only"));
  EXPECT_THAT(grade({"--only", "98"}).error, Not(HasSubstr("alone")));
}

TEST_F(GradeManyTest, GradesAgainForEvidenceThatIsMissing) {
  handIn("adam", kWrong);
  EXPECT_EQ(grade().code, 0);
  EXPECT_EQ(result("adam").at("volatile").at("evidence"), false);
  EXPECT_THAT(flat(grade({"--evidence"}).error), HasSubstr("1 graded, 0 kept")) << "there is none yet";
  EXPECT_THAT(flat(grade({"--evidence"}).error), HasSubstr("0 graded, 1 kept"));
  EXPECT_THAT(flat(grade().error), HasSubstr("0 graded, 1 kept")) << "more than asked for";
  Json json = result("adam");
  json.at("volatile").at("checks").at(0)["picture"] = "checks/a.png";
  const fs::path folder = results() / "adam/98-template";
  write(folder / "results.json", json.dump());
  EXPECT_THAT(flat(grade().error), HasSubstr("0 graded, 1 kept")) << "nobody asked";
  fs::create_directories(folder / "checks");
  write(folder / "checks/a.png", "");
  EXPECT_THAT(flat(grade({"--evidence"}).error), HasSubstr("0 graded, 1 kept"));
  fs::remove(folder / "checks/a.png");
  EXPECT_THAT(flat(grade({"--evidence"}).error), HasSubstr("1 graded, 0 kept"));
  // Pictures of another text would mislead.
  write(folder / "checks/old.png", "");
  handIn("adam", kGood);
  EXPECT_THAT(flat(grade().error), HasSubstr("1 graded, 0 kept"));
  EXPECT_FALSE(fs::exists(folder / "checks"));
}

TEST_F(GradeManyTest, PrintsJsonForPrograms) {
  handIn("adam", kGood), handIn("bob", kBroken, "98-tempalte");
  const Ended list = grade({"--json", "--manifest", (root() / "tasks.tsv").string()});
  EXPECT_EQ(list.code, 2);
  EXPECT_EQ(schemaFaultsOf(list.output, "grade_manifest"), "");
  EXPECT_EQ(Json::parse(list.output).at("tasks"), 1);
  const Ended ended = grade({"--json"});
  EXPECT_EQ(ended.code, 2);
  EXPECT_EQ(schemaFaultsOf(ended.output, "grade"), "");
  const Json json = Json::parse(ended.output);
  EXPECT_EQ(json.at("graded"), 1);
  EXPECT_EQ(json.at("kept"), 0);
  EXPECT_EQ(json.at("level"), 0);
  EXPECT_TRUE(json.at("complete"));
  EXPECT_THAT(json.at("not_taken").at(0).get<std::string>(),
              HasSubstr("no exercise is called '98-tempalte'"));
  EXPECT_EQ(json.at("tasks").at(0).at("points"), result("adam").at("score"));
  EXPECT_EQ(Json::parse(grade({"--json"}).output).at("kept"), 1);
  EXPECT_EQ(grade({"--json", "--csv"}).code, 64);
  EXPECT_EQ(rex({"grade", "--out", results().string()}).code, 64) << "without DIR";
}

// As killed processes leave it: one of two is graded again, and files are half written.
TEST_F(GradeManyTest, GoesOnAfterAnInterruptedRegrading) {
  handIn("adam", kGood), handIn("bob", kGood);
  grade();
  grade({"--seed", "5"});
  const std::string whole = fileText(results() / "regraded.csv");
  EXPECT_THAT(whole, HasSubstr("adam,98-template,"));
  EXPECT_FALSE(fs::exists(results() / "regrading.tsv"));
  const std::string points = std::to_string(result("adam").at("score").get<int>());
  const std::string sha = result("adam").at("inputs").at("source_sha256");
  fs::remove(results() / "regraded.csv");
  write(results() / "regrading.tsv",
        "adam\t98-template\t" + sha + "\t" + points + "\nbob\t98-template\t" + sha + "\t" + points + "\n");
  write(results() / "grades.csv.999999999.new", "half");
  write(results() / "bob" / "98-template" / "results.json.999999999.new", "half");
  grade({"--seed", "5"});
  EXPECT_EQ(fileText(results() / "regraded.csv"), whole);
  EXPECT_FALSE(fs::exists(results() / "regrading.tsv"));
  EXPECT_FALSE(fs::exists(results() / "grades.csv.999999999.new"));
  EXPECT_FALSE(fs::exists(results() / "bob" / "98-template" / "results.json.999999999.new"));
  write(results() / "regrading.tsv", "adam\t98-template\tx\tmany\n");
  const Ended broken = grade({"--seed", "5"});
  EXPECT_EQ(broken.code, 3);
  EXPECT_THAT(flat(broken.error),
              HasSubstr("regrading.tsv:1: not the notes of a regrading: wanted those of an "
                        "interrupted `rex grade`; without this file, it begins anew"));
}

TEST_F(GradeManyTest, AsksForTheRestOfAnInterruptedImport) {
  handIn("adam", kGood);
  write(in() / "import.begun.json", "{}");
  const Ended ended = grade();
  EXPECT_EQ(ended.code, 3);
  EXPECT_THAT(flat(ended.error), HasSubstr("an import into this folder was interrupted: wanted the same"));
}

TEST_F(GradeManyTest, RefusesFoldersInsideEachOther) {
  handIn("adam", kGood);
  for (const fs::path& out : {in() / "results", in(), root()}) {
    const Ended ended = rex({"grade", in().string(), "--out", out.string()});
    EXPECT_EQ(ended.code, 64);
    EXPECT_THAT(flat(ended.error), HasSubstr("wanted a folder apart from"));
  }
  for (const fs::path& workers : {in() / "workers", results() / "workers", results()}) {
    const Ended ended = gradeAnew({"--workers", workers.string()});
    EXPECT_EQ(ended.code, 64);
    EXPECT_THAT(flat(ended.error),
                HasSubstr("--workers: found " + workers.string() + ", wanted a folder apart from"));
  }
  const Ended none = rex({"grade", (root() / "im").string(), "--out", results().string()});
  EXPECT_EQ(none.code, 64);
  EXPECT_THAT(flat(none.error),
              HasSubstr("im: no such folder: wanted a folder of submissions (did you mean 'in'?)"));
  const Ended denied = grade({}, "../../../../../../../proc/results");
  EXPECT_EQ(denied.code, 3);
  EXPECT_THAT(flat(denied.error), HasSubstr("cannot make the folder of results: found "));
}

TEST_F(GradeManyTest, LetsTheExerciseWaitWhoseGraderDoesNotBuild) {
  const fs::path build = root() / "build", other = root() / "exercises" / "97-other";
  fs::copy(exercise(), other, fs::copy_options::recursive);
  fs::create_directories(build / "exercises");
  fs::create_symlink(REX_BINARY_DIR "/tests/template/exercises/98-template", build / "exercises/98-template");
  fs::create_symlink(REX_BINARY_DIR "/rex-sandbox", build / "rex-sandbox");
  write(build / "build.ninja",
        "rule compile\n  command = echo 'check.cpp:7:1: error: nonsense'; exit 1\n"
        "build 97-other_ready: compile\nbuild 98-template_ready: phony\n");
  handIn("anna", kGood), handIn("anna", kGood, "97-other"), handIn("ben", kGood, "97-other");
  const Ended ended = rexIn(
      build, {"grade", in().string(), "--out", results().string(), "--level", "0", "--i-accept-level", "0"});
  EXPECT_EQ(ended.code, 3);
  EXPECT_THAT(ended.error, HasSubstr("check.cpp:7:1: error: nonsense"));
  EXPECT_THAT(ended.error, HasSubstr("97-other: 2 submissions not graded"));
  EXPECT_THAT(row("anna"), HasSubstr("anna,98-template,"));
  EXPECT_THAT(table(), Not(HasSubstr("97-other")));
}

TEST_F(GradeManyTest, ShowsSimilarSubmissionsApartFromTheResults) {
  if (!runProcess({"sim_c++", "-v"}).started) GTEST_SKIP() << "similarity-tester is not installed";
  std::string renamed = kGood;
  for (std::size_t at = 0; (at = renamed.find("std::", at)) != std::string::npos; at += 7)
    renamed.insert(at, "  ");
  handIn("anna", kGood), handIn("bert", renamed), handIn("carl", kWrong);
  const std::string pages = (root() / "similar").string();
  const Ended ended = grade({"--similar", pages});
  EXPECT_EQ(ended.code, 0) << ended.error;
  EXPECT_THAT(flat(ended.output),
              HasSubstr("98-template: 1 group of similar submissions, to be looked at: "));
  EXPECT_THAT(ended.output, HasSubstr("\n  anna, bert\n"));
  EXPECT_THAT(fileText(root() / "similar" / "98-template.html"), HasSubstr("<h2>anna and bert</h2>"));
  EXPECT_EQ(fileText(root() / "similar" / "98-template" / "submissions" / "carl" / "main.cpp"), kWrong);
  EXPECT_TRUE(fs::exists(root() / "similar" / "98-template" / "base" / "main.cpp"));
  write(root() / "similar" / "98-template" / "notes.txt", "mine");
  handIn("bert", kWrong), fs::remove_all(in() / "carl");
  EXPECT_THAT(flat(grade({"--similar", pages}).output),
              HasSubstr("98-template: no two of 2 submissions have 70 % in common"));
  EXPECT_FALSE(fs::exists(root() / "similar" / "98-template.html"));
  EXPECT_FALSE(fs::exists(root() / "similar" / "98-template" / "submissions" / "carl"));
  EXPECT_TRUE(fs::exists(root() / "similar" / "98-template" / "notes.txt"));
  EXPECT_EQ(grade({"--similar", results().string()}).code, 64);
  EXPECT_EQ(grade({"--similar-percent", "50"}).code, 64);
}

}  // namespace rex::cli::grade_many_test
