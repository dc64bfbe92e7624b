// The commands of the student's loop besides run, test and watch, after gradings that are recorded here.
#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/process.h"
#include "base/sha256.h"
#include "cli/command_schema.h"
#include "cli/student/progress.h"
#include "cli/template_project.h"
#include "grading/results.h"
#include "support/tiny_disk.h"

namespace rex::cli::student_loop_test {

using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

class StudentLoop : public TemplateProject {
 protected:
  fs::path main() const { return exercise() / "main.cpp"; }
  // What `rex test 98` leaves of the file as it is, if it gets these points.
  void recordTest(int points) const {
    using grading::Outcome;
    const Outcome outcome = points == 3 ? Outcome::kPass : Outcome::kFail;
    ProgressFile(root()).change("98-template", [&](Progress& progress) {
      progress.tested = true;
      progress.points = points, progress.maxPoints = 3;
      progress.solved = progress.solved || points == 3;
      progress.fileSha256 = sha256(fileText(main()));
    });
    grading::GradeResult result{.exerciseId = "98-template", .outcome = outcome};
    result.score = points, result.maxScore = 3;
    result.checks = {{.id = "all",
                      .part = "rotate",
                      .title = "All",
                      .status = outcome,
                      .points = points,
                      .maxPoints = 3,
                      .function = points == 3 ? "" : "rotated"}};
    fs::create_directories(out());
    saveResult(result, out() / "results.json");
  }
  static std::string sha256Of(const fs::path& file) {
    return runProcess({"sha256sum", file.string()}).output.substr(0, 64);
  }
};

TEST_F(StudentLoop, ListsExercises) {
  const Ended ended = rex({"list"});
  EXPECT_EQ(ended.code, 0);
  EXPECT_THAT(ended.output, HasSubstr("Chapter 2\n98-template   3 points  Rotating points (template)\n"));
  EXPECT_THAT(ended.output, HasSubstr("script: 2.1; builds on 00; about 2 hours\n"));
  const std::string json = rex({"list", "--json"}).output;
  EXPECT_EQ(schemaFaultsOf(json, "list"), "");
  EXPECT_EQ(
      json,
      "{\"exercises\":[{\"name\":\"98-template\",\"title\":\"Rotating points (template)\",\"script\":\"2.1\","
      "\"chapter\":2,\"needs\":[\"00\"],\"hours\":2,\"folder\":\"" +
          shown(exercise()) +
          "\",\"points\":3,\"parts\":[{\"id\":\"rotate\","
          "\"title\":\"Rotation in the plane\",\"points\":3,\"core\":true}]}]}\n");
}

TEST_F(StudentLoop, ShowsPathsWithoutWaysBack) {
  EXPECT_EQ(shown(exercise() / ".." / "97-new"), (root() / "exercises" / "97-new").string());
}

TEST_F(StudentLoop, FindsExercisesByNumberTopicAndFolder) {
  for (const char* name : {"98", "template", "98-template", "TEMPL", "98-t", "exercises/98-template/",
                           "./exercises/98-template/main.cpp"})
    EXPECT_EQ(rex({"hint", name}).code, 0) << name;
  EXPECT_EQ(rex({"hint", "te"}).code, 64);
  fs::copy(exercise(), root() / "exercises" / "97-templates", fs::copy_options::recursive);
  EXPECT_EQ(rex({"hint", "templ"}).code, 64) << "a part of both";
}

TEST_F(StudentLoop, ShowsProgressAndTheNextStep) {
  const Ended start = rex({});
  EXPECT_EQ(start.code, 0);
  EXPECT_THAT(start.output, StartsWith("98-template  [....................]   - of  3\n"));
  EXPECT_THAT(start.output, HasSubstr("0 of 1 exercises solved, 0 of 3 points in the last tests"));
  EXPECT_THAT(start.output, HasSubstr("Next: 98-template, Rotating points (template)\n  read "));
  EXPECT_THAT(start.output, HasSubstr("scripts/rex run 98 "));

  recordTest(0);
  EXPECT_THAT(rex({}).output, StartsWith("98-template  [....................]   0 of  3\n"));
  EXPECT_THAT(rex({}).output, HasSubstr("scripts/rex hint 98 "));
  write(main(), std::string(kGood) + "// edited\n");
  EXPECT_THAT(rex({}).output, HasSubstr("  0 of  3   edited since this test\n"));

  recordTest(3);
  const Ended end = rex({});
  EXPECT_THAT(end.output, StartsWith("98-template  [####################]   3 of  3\n"));
  EXPECT_THAT(end.output, HasSubstr("All exercises are solved."));
}

TEST_F(StudentLoop, GivesHintsOneByOne) {
  const std::string title = "Rotation in the plane [rotate]\n";
  EXPECT_EQ(rex({"hint", "98", "--again"}).output,
            title + "  no hint was shown yet\n  2 more: scripts/rex hint 98-template rotate\n");
  EXPECT_EQ(rex({"hint", "98"}).output,
            title +
                "  1 of 2: Where does the point (1, 0) go when you turn it by a quarter?\n"
                "  1 more: scripts/rex hint 98-template rotate\n");
  EXPECT_THAT(flat(rex({"hint", "98", "rotate"}).output),
              HasSubstr("2 of 2: And (0, 1)? A rotation is linear: these two tell everything. That was"));
  const std::string all = rex({"hint", "98"}).output;
  EXPECT_THAT(all, HasSubstr("1 of 2: "));
  EXPECT_THAT(all, HasSubstr("2 of 2: "));
  const Ended unknown = rex({"hint", "98", "rotat"});
  EXPECT_EQ(unknown.code, 64);
  EXPECT_THAT(flat(unknown.error), HasSubstr("98-template has no part 'rotat': wanted one of rotate (did you "
                                             "mean 'rotate'?)"));
}

TEST_F(StudentLoop, SaysWhereTheOtherHintsAreIfItCannotCount) {
  write(root() / ".rex", "a file where a folder should be");
  for (int k = 0; k < 2; ++k) {
    const Ended ended = rex({"hint", "98"});
    EXPECT_THAT(ended.output, HasSubstr("1 of 2: "));
    EXPECT_THAT(ended.output,
                HasSubstr("  1 more in " + (exercise() / "exercise.toml").string() + " (progress"));
    EXPECT_THAT(ended.output, Not(HasSubstr("scripts/rex hint")));
  }
}

TEST_F(StudentLoop, HintsAtThePartThatLostPoints) {
  replace(exercise() / "exercise.toml", "[[part]]",
          "[[part]]\nid = \"other\"\ntitle = \"Another part\"\npoints = 1\nhints = [\"Other.\"]\n\n[[part]]");
  EXPECT_THAT(rex({"hint", "98"}).output, StartsWith("Another part [other]"));
  recordTest(0);
  EXPECT_THAT(rex({"hint", "98"}).output, StartsWith("Rotation in the plane [rotate]"));
  for (const char* name : {"all", "rotated"})  // a check and the function that failed in it
    EXPECT_THAT(rex({"hint", "98", name}).output, StartsWith("Rotation in the plane [rotate]")) << name;
  recordTest(3);
  EXPECT_THAT(rex({"hint", "98"}).output, StartsWith("Every part of 98-template got full points"));
  EXPECT_THAT(rex({"hint", "98", "rotate"}).output, StartsWith("Rotation in the plane [rotate]"));
}

TEST_F(StudentLoop, SaysWhereReplayAndPicturesAre) {
  const Ended nothing = rex({"show", "98"});
  EXPECT_EQ(nothing.code, 1);
  EXPECT_THAT(nothing.output, HasSubstr("scripts/rex run 98-template"));
  fs::create_directories(out() / "dance");
  for (const char* file : {"dance.html", "dance.mp4", "dance/0000.png", "end.png"}) write(out() / file, "x");
  const Ended shown = rex({"show", "98"});
  EXPECT_EQ(shown.code, 0);
  const std::string folder = out().string() + "/";
  EXPECT_EQ(shown.output, "replay   " + folder + "dance.html\n         file://" + folder +
                              "dance.html\nfilm     " + folder + "dance.mp4\npicture  " + folder +
                              "end.png\npicture  " + folder + "dance/0000.png\n");
}

TEST_F(StudentLoop, WritesAddressesThatBrowsersTake) {
  fs::create_directories(out());
  write(out() / "my 1st # \xc3\xa4.html", "x");
  EXPECT_THAT(rex({"show", "98"}).output,
              HasSubstr("file://" + out().string() + "/my%201st%20%23%20%C3%A4.html\n"));
}

TEST_F(StudentLoop, ResetsAndKeepsEveryBackup) {
  const std::string starter = fileText(main());
  EXPECT_THAT(rex({"reset", "98"}).output, HasSubstr("is as it was handed out."));
  for (int k = 1; k <= 2; ++k) {
    const std::string mine = "my work " + std::to_string(k);
    write(main(), mine);
    fs::remove(root() / "same");
    fs::create_hard_link(main(), root() / "same");
    const Ended ended = rex({"reset", "98"});
    EXPECT_EQ(ended.code, 0) << ended.error;
    const std::string backup = "main.backup-" + std::to_string(k) + ".cpp";
    EXPECT_THAT(ended.output, HasSubstr(backup));
    EXPECT_EQ(fileText(exercise() / backup), mine);
    EXPECT_TRUE(fs::equivalent(exercise() / backup, root() / "same")) << "nothing is copied";
    EXPECT_EQ(fileText(main()), starter);
  }
  fs::remove(main());
  EXPECT_EQ(rex({"reset", "98"}).code, 0);
  EXPECT_EQ(fileText(main()), starter);
}

TEST_F(StudentLoop, ResetsNothingOnAFullDisk) {
  const TinyDisk disk(64);
  REX_NEEDS_DISK(disk);
  const fs::path root = disk.path() / "project";
  fs::create_directories(root / "exercises/98-template");
  for (const char* file : {"exercise.toml", "exercise.h", "main.cpp", "solution.cpp"})
    fs::copy_file(exercise() / file, root / "exercises/98-template" / file);
  write(root / "exercises/98-template/main.cpp", kGood);
  for (const std::size_t size : {4096u, 1u})
    for (std::ofstream fill(root / "fill", std::ios::app); fill << std::string(size, 'x') << std::flush;) {
    }
  const Ended ended = rexWith({root, build()}, {"reset", "98"});
  EXPECT_EQ(ended.code, 3);
  EXPECT_EQ(ended.output, "");
  EXPECT_THAT(flat(ended.error),
              HasSubstr("main.cpp: cannot write the student's file: found No space left on device"));
  EXPECT_EQ(fileText(root / "exercises/98-template/main.cpp"), kGood);
  EXPECT_FALSE(fs::exists(root / "exercises/98-template/main.backup-1.cpp"));
}

TEST_F(StudentLoop, ResetsByTheCopyThatStudentsGet) {
  fs::remove(exercise() / "solution.cpp");
  write(main(), "mine");
  const Ended none = rex({"reset", "98"});
  EXPECT_EQ(none.code, 64);
  EXPECT_THAT(flat(none.error), HasSubstr("has no copy of main.cpp as it was handed out"));
  EXPECT_EQ(fileText(main()), "mine");
  write(exercise() / "starter.cpp", "as handed out");
  EXPECT_EQ(rex({"reset", "98"}).code, 0);
  EXPECT_EQ(fileText(main()), "as handed out");
}

TEST_F(StudentLoop, ShowsTheSolutionWhereTheCourseAllowsIt) {
  const Ended never = rex({"show", "98", "--solution"});
  EXPECT_EQ(never.code, 64);
  EXPECT_THAT(never.error, HasSubstr("the course does not show the solution of 98-template"));
  replace(exercise() / "exercise.toml", "[limits]", "solution = \"after-pass\"\n\n[limits]");
  const std::string solution = fileText(exercise() / "solution.cpp");
  const Ended early = rex({"show", "98", "--solution"});
  EXPECT_EQ(early.code, 1);
  EXPECT_EQ(early.output, "");
  EXPECT_THAT(flat(early.error),
              HasSubstr("is shown once `scripts/rex test 98-template` has given you the full"));
  recordTest(3);
  EXPECT_EQ(rex({"show", "98", "--solution"}).output, solution);
  // Once solved, solved.
  recordTest(0);
  EXPECT_EQ(rex({"show", "98", "--solution"}).output, solution);
  fs::remove(exercise() / "solution.cpp");
  EXPECT_THAT(flat(rex({"show", "98", "--solution"}).error), HasSubstr("98-template has no solution here"));
}

// The archive is read by a program of others.
TEST_F(StudentLoop, HandsInTheListedFileWithItsHash) {
  write(main(), kGood);
  write(exercise() / "notes.txt", "private");
  const fs::path zip = root() / "handin.zip";
  const Ended ended = rex({"submit", "98", "template", "-o", zip});
  ASSERT_EQ(ended.code, 0) << ended.error;
  const std::string hash = sha256Of(main());
  EXPECT_THAT(ended.output, StartsWith(hash + "  98-template/main.cpp\n"));
  EXPECT_THAT(flat(ended.error), HasSubstr("was not tested: scripts/rex test 98-template"));
  const ProcessResult listed = runProcess({"python3", "-m", "zipfile", "-l", zip.string()});
  ASSERT_TRUE(listed.ok()) << listed.error;
  EXPECT_THAT(listed.output, HasSubstr("98-template/main.cpp"));
  EXPECT_THAT(listed.output, HasSubstr("receipt.json"));
  EXPECT_EQ(std::count(listed.output.begin(), listed.output.end(), '\n'), 3) << listed.output;
  ASSERT_TRUE(runProcess({"python3", "-m", "zipfile", "-t", zip.string()}).ok());
  ASSERT_TRUE(
      runProcess({"python3", "-m", "zipfile", "-e", zip.string(), (root() / "unpacked").string()}).ok());
  EXPECT_EQ(fileText(root() / "unpacked/98-template/main.cpp"), kGood);
  EXPECT_THAT(fileText(root() / "unpacked/receipt.json"), HasSubstr("\"sha256\": \"" + hash + "\""));

  const std::string bytes = fileText(zip);
  recordTest(3);
  const Ended again = rex({"submit", "98", "-o", zip});
  EXPECT_EQ(again.error, "");
  EXPECT_THAT(again.output, StartsWith("98-template: 3 of 3 points in its last test\n" + hash));
  EXPECT_EQ(fileText(zip), bytes) << "the same files, the same bytes";
}

TEST_F(StudentLoop, HandsInProgressIfAsked) {
  write(main(), kGood);
  recordTest(3);
  const fs::path zip = root() / "handin.zip";
  const auto receipt = [&] {
    const std::vector<std::string> unzip = {"python3", "-m",         "zipfile",
                                            "-e",      zip.string(), (root() / "unpacked").string()};
    EXPECT_TRUE(runProcess(unzip).ok());
    return fileText(root() / "unpacked/receipt.json");
  };
  EXPECT_THAT(
      flat(rex({"submit", "98", "--progress", "-o", zip}).output),
      HasSubstr("98-template: the receipt says that you worked on it for 0 min, and when 0 of 1 parts "
                "passed"));
  EXPECT_THAT(receipt(), HasSubstr("\"seconds\": 0"));
  ProgressFile(root()).change("98-template", [&](Progress& progress) {
    progress.work = {
        .seconds = 5400, .lastSave = 1000, .fileSha256 = "ab", .parts = {{"rotate", {900, 3600}}}};
  });
  EXPECT_THAT(flat(rex({"submit", "98", "--progress", "-o", zip}).output),
              HasSubstr("worked on it for 90 min, and when 1 of 1 parts passed"));
  EXPECT_THAT(receipt(), HasSubstr("\"rotate\": 3600"));
  EXPECT_EQ(rex({"submit", "98", "-o", zip}).code, 0);
  EXPECT_THAT(receipt(), Not(HasSubstr("work"))) << "only on request";
}

TEST_F(StudentLoop, RefusesWhatCannotBeHandedIn) {
  const Ended name = rex({"submit", "98", "-o", "handin.tar"});
  EXPECT_EQ(name.code, 64);
  EXPECT_THAT(name.error, HasSubstr("-o: found handin.tar, wanted a name ending in .zip"));
  const Ended nowhere = rex({"submit", "98", "-o", root() / "no/folder.zip"});
  EXPECT_EQ(nowhere.code, 3);
  EXPECT_THAT(flat(nowhere.error), HasSubstr("no/folder.zip: cannot write the zip file: found No such file"));
  EXPECT_THAT(rex({"submit"}).error, HasSubstr("EXERCISE is required"));
  fs::remove(main());
  const Ended missing = rex({"submit", "98", "-o", root() / "handin.zip"});
  EXPECT_EQ(missing.code, 2);
  EXPECT_THAT(flat(missing.error), HasSubstr("main.cpp: cannot be graded: found no file"));
  EXPECT_FALSE(fs::exists(root() / "handin.zip"));
}

TEST_F(StudentLoop, AnswersTyposInAllCommands) {
  for (const char* command : {"test", "watch", "hint", "show", "reset", "submit"}) {
    const Ended typo = rex({command, "98-tempalte"});
    EXPECT_EQ(typo.code, 64) << command;
    EXPECT_THAT(flat(typo.error), HasSubstr("did you mean '98-template'")) << command;
    EXPECT_EQ(rex({command}).code, 64) << command;
  }
  EXPECT_THAT(rex({"wach", "98"}).error, HasSubstr("did you mean 'watch'?"));
}

}  // namespace rex::cli::student_loop_test
