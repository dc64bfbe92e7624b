// `rex grade`, task by task and with `--collect`, on small classes of students.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/text_file.h"
#include "cli/command_schema.h"
#include "commands/instructor/graded_class.h"
#include "support/paths.h"

namespace rex::cli::grade_many_test {

using ::testing::HasSubstr;
using ::testing::Not;
using Json = nlohmann::json;

using GradeManyTest = GradedClass;

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

// At level 0, a program can see in which pass it runs. Those of the second note whether everybody's first is
// over.
TEST_F(GradeManyTest, RunsHiddenChecksWhenAllVisibleOnesAreOver) {
  const auto place = [&](const std::string& student) {
    return (results() / student / "98-template").string();
  };
  const fs::path log = root() / "log";
  const auto notes = [&](const std::string& student, const std::string& other) {
    return fmt::format(
        "#include \"exercise.h\"\n#include <filesystem>\n#include <fstream>\n#include <unistd.h>\n"
        "bool has(const std::string& file) {{ return std::filesystem::exists(file); }}\n"
        "Eigen::Vector2d rotated(const Eigen::Vector2d& p, double) {{\n"
        "  if (!has(\"{0}/visible\")) usleep(100'000);\n"
        "  else std::ofstream(\"{2}\", std::ios::app) << has(\"{1}/visible\") + has(\"{1}/results.json\");\n"
        "  return p;\n}}\nint main() {{}}\n",
        place(student), place(other), log.string());
  };
  handIn("quick", notes("quick", "slow"));
  handIn("slow", notes("slow", "quick"));
  EXPECT_EQ(gradeAnew({"-j2"}).code, 0);
  EXPECT_THAT(fileText(log), ::testing::MatchesRegex("[12]+"));
  for (const char* student : {"quick", "slow"}) {
    EXPECT_EQ(result(student)["checks"][2]["status"], "pass") << "it adds up";
    EXPECT_FALSE(fs::exists(place(student) + "/visible"));
  }
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
  const Ended nothing = rex({"grade", "--collect", "-o", out, "--manifest", manifest});
  EXPECT_EQ(nothing.code, 3);
  EXPECT_THAT(flat(nothing.error), HasSubstr("no result: tasks 1-3"));
  const auto one = [&](const std::string& task) {
    return rex({"grade", "--manifest", manifest, "--task", task, "--out", out});
  };
  for (const char* task : {"3", "1"}) EXPECT_EQ(one(task).code, 0);
  EXPECT_THAT(flat(rex({"grade", "--collect", "-o", out, "--manifest", manifest}).error),
              HasSubstr("To repeat: 2"));
  EXPECT_THAT(one("2").output, HasSubstr("bob 98-template: compile_error, 0 of "));
  EXPECT_EQ(one("2").output, "bob 98-template: kept\n");
  const Ended all = rex({"grade", "--collect", "-o", out, "--manifest", manifest, "--csv"});
  EXPECT_EQ(all.code, 0) << all.error;
  EXPECT_EQ(all.output, table("whole"));
  EXPECT_EQ(table(), table("whole"));
}

TEST_F(GradeManyTest, GradesTasksInTwoPasses) {
  handIn("adam", kGood), handIn("bob", kBroken), handIn("carl", kWrong);
  EXPECT_EQ(grade({}, "whole").code, 0);
  const std::string manifest = (root() / "tasks.tsv").string(), out = results().string();
  EXPECT_EQ(grade({"--manifest", manifest}).code, 0);
  const auto all = [&](std::vector<std::string> more) {
    more.insert(more.begin(), {"grade", "--manifest", manifest, "--task", "1", "--chunk", "3", "--out", out});
    return rex(more);
  };
  const Ended first = all({"--visible"});
  EXPECT_EQ(first.code, 0) << first.error;
  EXPECT_THAT(first.output,
              AllOf(HasSubstr("adam 98-template: visible checks graded\nbob 98-template: compile_error"),
                    HasSubstr("carl 98-template: visible checks graded")));
  EXPECT_THAT(flat(rex({"grade", "--collect", "-o", out, "--manifest", manifest}).error),
              HasSubstr("no result: tasks 1,3"));
  const Ended second = all({});
  EXPECT_EQ(second.code, 0) << second.error;
  EXPECT_THAT(second.output, HasSubstr("bob 98-template: kept"));
  EXPECT_EQ(rex({"grade", "--collect", "-o", out, "--manifest", manifest}).code, 0);
  EXPECT_EQ(table(), table("whole"));
  EXPECT_FALSE(fs::exists(results() / "adam/98-template/visible"));
  EXPECT_THAT(grade({"--visible"}).error, HasSubstr("--visible requires --task"));
}

TEST_F(GradeManyTest, GradesTasksInChunks) {
  handIn("adam", kGood), handIn("bob", kBroken), handIn("carl", kWrong);
  const std::string manifest = (root() / "tasks.tsv").string(), out = results().string();
  EXPECT_EQ(grade({"--manifest", manifest}).code, 0);
  const auto chunk = [&](const std::string& task) {
    return rex({"grade", "--manifest", manifest, "--task", task, "--chunk", "2", "--out", out});
  };
  EXPECT_EQ(chunk("3").code, 64);
  EXPECT_THAT(chunk("3").error, HasSubstr("--task: found 3, wanted 1 to 2, in chunks of 2"));
  write(results() / "adam/98-template/main.cpp", kWrong);
  const Ended first = chunk("1");
  EXPECT_EQ(first.code, 3);
  EXPECT_THAT(flat(first.error), HasSubstr("adam 98-template: "));
  EXPECT_THAT(first.output, HasSubstr("bob 98-template: compile_error")) << "whatever became of the other";
  write(results() / "adam/98-template/main.cpp", kGood);
  const Ended again = chunk("1");
  EXPECT_EQ(again.code, 0) << again.error;
  EXPECT_THAT(again.output, HasSubstr("bob 98-template: kept"));
  EXPECT_EQ(chunk("2").code, 0) << "the last one has one task";
  EXPECT_EQ(rex({"grade", "--collect", "-o", out, "--manifest", manifest}).code, 0);
}

TEST_F(GradeManyTest, GradesNothingThatTheListOfTasksDoesNotMean) {
  handIn("adam", kGood);
  const std::string manifest = (root() / "tasks.tsv").string();
  EXPECT_EQ(grade({"--manifest", manifest}).code, 0);
  const auto one = [&](const std::string& task) {
    return rex({"grade", "--manifest", manifest, "--task", task, "--out", results().string()});
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
  const Ended listed = grade({"--manifest", manifest, "--secret-file", (root() / "secret").string()});
  EXPECT_EQ(listed.code, 0);
  EXPECT_THAT(flat(listed.error), HasSubstr("other users of this machine may read the secret of the course"));
  fs::permissions(root() / "secret", fs::perms::owner_read);
  EXPECT_THAT(flat(grade({"--manifest", manifest, "--secret-file", (root() / "secret").string()}).error),
              Not(HasSubstr("other users")));
  const Ended ended = rex({"grade", "--manifest", manifest, "--task", "1", "--out", results().string()});
  EXPECT_EQ(ended.code, 3);
  EXPECT_THAT(flat(ended.error), HasSubstr("the secret of the course: found none, wanted "));
}

TEST_F(GradeManyTest, TellsWithOnlyWhatItCouldNotTake) {
  fs::create_directories(in() / "adam_501_assignsubmission_file_");
  write(in() / "adam_501_assignsubmission_file_/main.cpp", kGood);
  handIn("bob", kGood);
  const Ended ended = grade({"98", "--manifest", (root() / "tasks.tsv").string()});
  EXPECT_EQ(ended.code, 2);
  EXPECT_THAT(flat(ended.error),
              HasSubstr("nothing to grade: found no exercise folder, wanted 98-template/main.cpp"));
}

TEST_F(GradeManyTest, TellsWithOnlyWhatItsTablesLeaveOut) {
  handIn("adam", kGood);
  EXPECT_THAT(grade().error, Not(HasSubstr("alone")));
  const fs::path list = results() / "tasks.tsv";
  write(list, readTextFile(list) + "2\tadam\t97-other\n");
  EXPECT_THAT(flat(grade({"98"}).error),
              HasSubstr("results/tasks.tsv and grades.csv now list 98-template alone; the results of 1 other "
                        "submission stay, and are listed again by rex grade without an exercise"));
  EXPECT_THAT(grade({"98"}).error, Not(HasSubstr("alone")));
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
  fs::copy(exercise(), root() / "exercises" / "97-other", fs::copy_options::recursive);
  fs::create_symlink(buildPath("rex-sandbox"), build() / "rex-sandbox");
  write(build() / "build.ninja",
        "rule compile\n  command = echo 'check.cpp:7:1: error: nonsense'; exit 1\n"
        "build 97-other_ready: compile\nbuild 98-template_ready: phony\n");
  handIn("anna", kGood), handIn("anna", kGood, "97-other"), handIn("ben", kGood, "97-other");
  const Ended ended = gradeAnew();
  EXPECT_EQ(ended.code, 3);
  EXPECT_THAT(ended.error, HasSubstr("check.cpp:7:1: error: nonsense"));
  EXPECT_THAT(ended.error, HasSubstr("97-other: 2 submissions not graded"));
  EXPECT_THAT(row("anna"), HasSubstr("anna,98-template,"));
  EXPECT_THAT(table(), Not(HasSubstr("97-other")));
}

TEST_F(GradeManyTest, ShowsSimilarSubmissionsApartFromTheResults) {
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
  EXPECT_THAT(fileText(root() / "similar" / "98-template.html"),
              HasSubstr("<h2 id=\"pair-1\">anna and bert</h2>"));
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

TEST_F(GradeManyTest, NamesNoMembersOfOneGroupAsSimilar) {
  handIn("anna", kGood), handIn("bert", kGood), handIn("carl", kWrong);
  const auto similar = [&](const std::string& groupOfBert) {
    std::string course;
    for (const auto& [id, group] :
         {std::pair("anna", "one"), {"bert", groupOfBert.c_str()}, {"carl", "three"}})
      course += std::string("[[student]]\nid = \"") + id + "\"\ngroup = \"" + group + "\"\n";
    write(root() / "course.toml", course);
    return flat(
        grade({"--similar", (root() / "similar").string(), "--course", (root() / "course.toml").string()})
            .output);
  };
  EXPECT_THAT(similar("one"), HasSubstr("98-template: no two of 3 submissions have 70 % in common"));
  EXPECT_THAT(similar("two"), HasSubstr("98-template: 1 group of similar submissions"));
}

}  // namespace rex::cli::grade_many_test
