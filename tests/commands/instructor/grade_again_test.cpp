// What `rex grade` keeps and what it does again: results, compiled programs, reports.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "commands/instructor/graded_class.h"
#include "grading/results.h"
#include "support/file_openings.h"
#include "support/rounds.h"

namespace rex::cli::grade_again_test {

using ::testing::HasSubstr;
using ::testing::Not;
using Json = nlohmann::json;

using GradeAgainTest = GradedClass;

TEST_F(GradeAgainTest, GradesAgainOnlyWhatHasChanged) {
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
  EXPECT_THAT(flat(grade({"--seed", "5", "--regrade"}).error), kept("3 graded, 0 kept"));
  EXPECT_EQ(result("adam").at("seed_id"), "public:5");
  write(root() / "secret", "the secret of the course\n");
  const std::string secret = (root() / "secret").string();
  EXPECT_THAT(flat(grade({"--secret-file", secret, "--regrade"}).error), kept("3 graded, 0 kept"));
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

// Whatever is made of a result, so that no table contradicts a report.
TEST_F(GradeAgainTest, OpensEachKeptResultOnce) {
  write(root() / "secret", "the secret of the course\n");
  const std::string secret = (root() / "secret").string();
  handIn("adam", kBroken), handIn("bob", kBroken);
  EXPECT_EQ(grade({"--secret-file", secret, "--report=markdown,junit"}).code, 0);
  FileOpenings adam(results() / "adam/98-template"), bob(results() / "bob/98-template");
  EXPECT_THAT(flat(grade({"--secret-file", secret, "--report=markdown,junit", "--json"}).error),
              HasSubstr("0 graded, 2 kept"));
  EXPECT_EQ(adam.of("results.json"), 1);
  EXPECT_EQ(bob.of("results.json"), 1);
  handIn("bob", "int main() {\n");
  EXPECT_THAT(flat(grade({"--secret-file", secret}).error), HasSubstr("1 graded, 1 kept"));
  EXPECT_EQ(adam.of("results.json"), 2);
  EXPECT_EQ(bob.of("results.json"), 3) << "once before it is graded again, once after";
  grade({"--manifest", (root() / "tasks.tsv").string(), "--secret-file", secret});
  EXPECT_THAT(rex({"grade", "--manifest", (root() / "tasks.tsv").string(), "--task", "1", "-o",
                   results().string(), "--secret-file", secret})
                  .output,
              HasSubstr("adam 98-template: kept"));
  EXPECT_EQ(adam.of("results.json"), 4);
}

// Programs are kept by what they were made of: another seed takes the same one, other files never do.
TEST_F(GradeAgainTest, KeepsCompiledProgramsForOtherSeeds) {
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
TEST_F(GradeAgainTest, CompilesAnewWhereAKeptProgramIsDamaged) {
  handIn("good", kGood);
  const fs::path workers = root() / "workers";
  int seed = 10;
  const auto gradedAgain = [&] {
    EXPECT_EQ(gradeAnew({"--workers", workers.string(), "--seed", std::to_string(++seed), "--regrade"}).code,
              0);
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

TEST_F(GradeAgainTest, CompilesAnewWhenAskedToRegrade) {
  handIn("good", kGood);
  const std::string workers = (root() / "workers").string();
  EXPECT_EQ(gradeAnew({"--workers", workers}).code, 0);
  const fs::path kept = fs::directory_iterator(workers)->path();
  const auto before = fs::last_write_time(kept / "worker");
  EXPECT_EQ(gradeAnew({"--workers", workers, "--seed", "5", "--regrade"}).code, 0);
  EXPECT_EQ(fs::last_write_time(kept / "worker"), before) << "only the questions are others";
  EXPECT_EQ(gradeAnew({"--workers", workers, "--seed", "5", "--regrade"}).code, 0);
  EXPECT_NE(fs::last_write_time(kept / "worker"), before);
}

TEST_F(GradeAgainTest, SaysWhereProgramsCannotBeKept) {
  handIn("good", kGood);
  write(root() / "workers", "no folder");
  const Ended ended = gradeAnew({"--workers", (root() / "workers").string()});
  EXPECT_EQ(ended.code, 3);
  EXPECT_THAT(flat(ended.error), HasSubstr("cannot keep programs in"));
}

TEST_F(GradeAgainTest, RepeatsWhatTheGraderFailedAt) {
  handIn("adam", kGood);
  EXPECT_EQ(grade().code, 0);
  Json json = result("adam");
  json["outcome"] = "grader_error";
  write(results() / "adam/98-template/results.json", json.dump());
  const Ended collected = rex({"grade", "--collect", "-o", results().string()});
  EXPECT_EQ(collected.code, 3);
  EXPECT_THAT(flat(collected.error), HasSubstr("the grader failed: tasks 1 adam 98-template To repeat: 1"));
  EXPECT_EQ(row("adam"), "adam,98-template,,,grader_error,,,") << "never a zero";
  EXPECT_THAT(flat(grade().error), HasSubstr("1 graded, 0 kept"));
  EXPECT_THAT(row("adam"), HasSubstr(",pass,"));
}

TEST_F(GradeAgainTest, WritesReportsBesideResultsWithoutGradingAgain) {
  handIn("adam", kGood), handIn("bob", kBroken);
  const fs::path summary = results() / "adam/98-template/summary.md",
                 junit = results() / "bob/98-template/junit.xml";
  EXPECT_EQ(grade().code, 0);
  EXPECT_FALSE(fs::exists(summary));
  const Ended first = grade({"--report=markdown,junit"});
  EXPECT_EQ(first.code, 0) << first.error;
  EXPECT_THAT(flat(first.error),
              HasSubstr("Reports: 4 written, 0 kept 2 submissions at sandbox level 0: 0 graded"));
  const std::string expected = fileText(summary);
  EXPECT_THAT(expected, HasSubstr(" points\n\nadam\n\n- Final grade: "));
  EXPECT_THAT(fileText(junit), HasSubstr("<testsuite"));
  fs::remove(summary);
  write(junit, "half a rep");
  EXPECT_THAT(flat(grade({"--report=markdown,junit"}).error),
              HasSubstr("Reports: 2 written, 2 kept 2 submissions at sandbox level 0: 0 graded, 2 kept"));
  EXPECT_EQ(fileText(summary), expected);
  handIn("adam", kWrong);
  EXPECT_THAT(flat(grade({"--report"}).error), HasSubstr("Reports: 2 written, 2 kept"))
      << "alone: markdown; those of an earlier format are renewed, too";
  EXPECT_NE(fileText(summary), expected);
  // What was made of a result goes with it.
  fs::remove(results() / "bob/98-template/results.json");
  EXPECT_EQ(rex({"grade", "--collect", "-o", results().string(), "--report=junit"}).code, 3);
  EXPECT_FALSE(fs::exists(junit));
  const Ended unknown = grade({"--report=markdwn"});
  EXPECT_EQ(unknown.code, 64);
  EXPECT_THAT(flat(unknown.error), HasSubstr("--report: found markdwn, wanted one of github"));
  EXPECT_THAT(flat(unknown.error), HasSubstr("did you mean 'markdown'?"));
}

TEST_F(GradeAgainTest, SaysWhatACallWouldChangeBeforeItGrades) {
  handIn("adam", kWrong), handIn("bob", kGood);
  write(root() / "secret", "the secret of the course\n");
  const fs::path course = root() / "course.toml", checks = results() / "adam/98-template/checks";
  write(course, "secret_file = \"secret\"\nseed = 7\nlevel = 0\nevidence = true\nreports = [\"markdown\"]\n");
  EXPECT_EQ(grade({"--course", course.string()}).code, 0);
  EXPECT_THAT(std::string(result("adam").at("seed_id")), HasSubstr("public:7 hidden:"));
  EXPECT_TRUE(fs::exists(results() / "bob/98-template/summary.md"));
  ASSERT_EQ(result("adam").at("volatile").at("evidence"), true);
  const std::string whole = fileText(results() / "adam/98-template/results.json");
  const Ended forgotten = grade();
  EXPECT_EQ(forgotten.code, 64);
  EXPECT_THAT(flat(forgotten.error),
              HasSubstr("2 results were made with other settings: found secret none instead of"));
  EXPECT_THAT(flat(forgotten.error), HasSubstr("seed none instead of 7"));
  EXPECT_THAT(flat(forgotten.error), HasSubstr("the course file, or --regrade"));
  EXPECT_EQ(fileText(results() / "adam/98-template/results.json"), whole);
  EXPECT_THAT(flat(grade({"--course", course.string()}).error), HasSubstr("0 graded, 2 kept"));
  EXPECT_THAT(flat(grade({"--regrade"}).error), HasSubstr("2 graded, 0 kept"));
  EXPECT_EQ(result("adam").at("volatile").at("evidence"), true) << "pictures are made again, not lost";
  EXPECT_TRUE(fs::exists(results() / "bob/98-template/summary.md"));
}

TEST_F(GradeAgainTest, GradesOneStudentWithAnotherSeed) {
  handIn("adam", kWrong), handIn("bob", kGood);
  EXPECT_EQ(grade({"--seed", "7"}).code, 0);
  EXPECT_THAT(flat(grade({"--student", "adam", "--seed", "8"}).error), HasSubstr("1 graded, 1 kept"));
  EXPECT_EQ(result("adam").at("seed_id"), "public:8");
  EXPECT_THAT(row("bob"), HasSubstr(",pass,")) << "in the table as before";
  EXPECT_THAT(flat(grade({"--seed", "7"}).error), HasSubstr("0 graded, 2 kept"));
  handIn("adam", kGood);
  EXPECT_THAT(flat(grade({"--seed", "7"}).error), HasSubstr("1 graded, 1 kept"));
  EXPECT_EQ(result("adam").at("seed_id"), "public:8") << "until the class is regraded";
  EXPECT_THAT(flat(grade({"--seed", "7"}).error), HasSubstr("0 graded, 2 kept"));
  EXPECT_THAT(flat(grade({"--seed", "7", "--regrade"}).error), HasSubstr("2 graded, 0 kept"));
  EXPECT_EQ(result("adam").at("seed_id"), "public:7");
  const Ended nobody = grade({"--seed", "7", "--student", "adan"});
  EXPECT_EQ(nobody.code, 64);
  EXPECT_THAT(flat(nobody.error), HasSubstr("did you mean 'adam'?"));
}

TEST_F(GradeAgainTest, GradesWhatAPersonHandedInByAnyKey) {
  handIn("adam", kWrong), handIn("bob", kGood);
  write(root() / "course.toml",
        "[[student]]\nid = \"adam\"\ngroup = \"pair\"\nnumber = \"4711\"\n"
        "[[student]]\nid = \"yan\"\nname = \"Yan Y.\"\ngroup = \"pair\"\n[[student]]\nid = \"carl\"\n");
  const auto one = [&](const std::string& key, const std::string& seed) {
    return grade({"--student", key, "--seed", seed, "--course", (root() / "course.toml").string()});
  };
  EXPECT_EQ(grade({"--seed", "7"}).code, 0);
  int seed = 10;
  for (const char* key : {"adam", "4711", "yan", "yan y."}) {
    EXPECT_THAT(flat(one(key, std::to_string(++seed)).error), HasSubstr("1 graded, 1 kept")) << key;
    EXPECT_EQ(result("adam").at("seed_id"), "public:" + std::to_string(seed)) << key;
  }
  EXPECT_THAT(flat(one("bob", "9").error), HasSubstr("1 graded, 1 kept"))
      << "a folder of nobody on the roster";
  EXPECT_THAT(flat(one("carl", "9").error), HasSubstr("--student: 'carl' handed in nothing"));
}

// A fault of one row is told with its line, and what that student handed in is in the table of strangers.
TEST_F(GradeAgainTest, GradesTheClassInSpiteOfAFaultyRow) {
  handIn("adam", kGood), handIn("bob", kGood);
  write(root() / "students.csv", "id,name\nadam,Adam\nbob,B\u202Eob\n");
  write(root() / "course.toml", "students = \"students.csv\"\n");
  const Ended ended = grade({"--course", (root() / "course.toml").string(), "--json"});
  EXPECT_EQ(ended.code, 2);
  const std::string fault = "students.csv:3: a student: 'name': found a line break or an invisible character";
  EXPECT_THAT(flat(ended.error), HasSubstr(fault));
  EXPECT_THAT(nlohmann::json::parse(ended.output).at("not_taken").at(0).get<std::string>(), HasSubstr(fault));
  EXPECT_THAT(table(), HasSubstr("\nadam,Adam,,,98-template,graded,"));
  EXPECT_THAT(fileText(results() / "not_on_roster.csv"), HasSubstr("bob,,,,98-template,graded,"));
  EXPECT_THAT(fileText(results() / "not_on_roster.csv"), HasSubstr(fault));
}

TEST_F(GradeAgainTest, ReadsTheAdjustmentsBeforeTheFirstGrading) {
  handIn("adam", kGood);
  write(root() / "course.toml", "adjustments = \"none.toml\"\n");
  const Ended ended = grade({"--course", (root() / "course.toml").string()});
  EXPECT_EQ(ended.code, 3);
  EXPECT_THAT(flat(ended.error), HasSubstr("none.toml"));
  EXPECT_FALSE(fs::exists(results() / "adam/98-template/results.json"));
}

// A report of an earlier result would carry a wrong grade.
TEST_F(GradeAgainTest, KeepsNoReportLongerThanItsResult) {
  handIn("adam", kGood), handIn("bob", kGood);
  const fs::path adam = results() / "adam/98-template", bob = results() / "bob/98-template";
  EXPECT_EQ(grade({"--report=markdown,gradescope"}).code, 0);
  const std::string summary = fileText(bob / "summary.md");
  handIn("adam", kWrong);
  EXPECT_EQ(grade().code, 0);
  EXPECT_THAT(fileText(adam / "summary.md"), Not(HasSubstr(" 8 of 8 points"))) << "renewed";
  EXPECT_TRUE(fs::exists(adam / "gradescope.json"));
  EXPECT_EQ(fileText(bob / "summary.md"), summary) << "its result is the same";
  write(bob / "summary.md", "8 of 8");
  EXPECT_THAT(flat(rex({"grade", "--collect", "-o", results().string()}).error),
              HasSubstr("Reports: 1 written, 0 kept"));
  EXPECT_EQ(fileText(bob / "summary.md"), summary) << "outdated, and renewed though nobody asked";
  fs::remove(bob / "results.json");
  EXPECT_EQ(rex({"grade", "--collect", "-o", results().string()}).code, 3);
  EXPECT_FALSE(fs::exists(bob / "summary.md"));
  EXPECT_FALSE(fs::exists(bob / "gradescope.json"));
}

TEST_F(GradeAgainTest, BelievesNoResultThatWasEdited) {
  handIn("adam", kWrong);
  EXPECT_EQ(grade({"--report"}).code, 0);
  const fs::path file = results() / "adam/98-template/results.json";
  const std::string whole = fileText(file), before = row("adam");
  Json json = result("adam");
  const int possible = json.at("max_score");
  json["score"] = possible;
  write(file, json.dump());
  const Ended collected = rex({"grade", "--collect", "-o", results().string()});
  EXPECT_EQ(collected.code, 3);
  EXPECT_THAT(flat(collected.error),
              HasSubstr("a result that was changed after the grading: tasks 1 adam 98-template"));
  EXPECT_THAT(flat(collected.error), HasSubstr("results.json: a result that does not add up: score: found " +
                                               std::to_string(possible) + ", wanted "));
  EXPECT_EQ(row("adam"), "adam,98-template,,,refused,,,") << "never a grade";
  EXPECT_FALSE(fs::exists(file.parent_path() / "summary.md"));
  // It adds up, but is not what the grader wrote.
  json = Json::parse(whole);
  json["message"] = "well done";
  write(file, json.dump());
  EXPECT_EQ(rex({"grade", "--collect", "-o", results().string()}).code, 3);
  json = Json::parse(whole);
  json["exercise"]["id"] = "97-other";
  json["inputs"]["result_sha256"] = grading::computeSeal(json.dump(), "");
  write(file, json.dump());
  EXPECT_THAT(flat(rex({"grade", "--collect", "-o", results().string()}).error),
              HasSubstr("a result of another exercise: found '97-other', wanted '98-template'"));
  const Ended again = grade();
  EXPECT_EQ(again.code, 0);
  EXPECT_THAT(flat(again.error), HasSubstr("wanted '98-template'; it is graded again"));
  EXPECT_THAT(flat(again.error), HasSubstr("1 graded, 0 kept"));
  EXPECT_EQ(row("adam"), before);
}

TEST_F(GradeAgainTest, GradesAgainForEvidenceThatIsMissing) {
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

// As killed processes leave it: one of two is graded again, and files are half written.
TEST_F(GradeAgainTest, GoesOnAfterAnInterruptedRegrading) {
  handIn("adam", kGood), handIn("bob", kGood);
  grade();
  grade({"--seed", "5", "--regrade"});
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
                        "interrupted `rex grade`; without this file, it starts again"));
}

}  // namespace rex::cli::grade_again_test
