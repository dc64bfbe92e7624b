// Clones of students' repositories, which git reads without obeying anything in them.
#include <algorithm>
#include <cstdlib>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/process.h"
#include "base/text_file.h"
#include "classroom/importing.h"
#include "classroom/repository.h"
#include "support/expect_error.h"
#include "support/file_text.h"
#include "support/rounds.h"
#include "support/synthetic_class.h"
#include "support/temporary_folder.h"

namespace rex::classroom::git_clones_test {

namespace fs = std::filesystem;
using ::testing::Contains;
using ::testing::Each;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

constexpr const char* kExercise = "01-kinematics";
constexpr std::int64_t kNoon = 1'795'176'000;

class GitClonesTest : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!runProcess({"git", "--version"}).ok()) GTEST_SKIP() << "git is not installed";
    exercises_.resize(2);
    exercises_[0].name = kExercise;
    exercises_[1].name = "02-control";
  }
  fs::path source() const { return folder_.path() / "clones"; }
  fs::path handedIn() const { return folder_.path() / "handed-in"; }
  fs::path write(const std::string& name, const std::string& text) const {
    writeTextFile(folder_.path() / name, text);
    return folder_.path() / name;
  }
  std::string git(const std::string& clone, std::vector<std::string> arguments,
                  std::int64_t time = kNoon) const {
    arguments.insert(arguments.begin(), {"git", "-c", "user.name=x", "-c", "user.email=x@x", "-c",
                                         "init.defaultBranch=main", "-c", "commit.gpgsign=false"});
    const ProcessResult run = runProcess(
        arguments,
        {.directory = source() / clone, .environment = {fmt::format("GIT_COMMITTER_DATE={} +0000", time)}});
    EXPECT_TRUE(run.ok()) << run.error;
    return run.output.substr(0, run.output.find('\n'));
  }
  // Adds a commit and returns its id.
  std::string commit(const std::string& clone, const std::string& text, std::int64_t time,
                     const std::string& file = "exercises/01-kinematics/main.cpp") const {
    writeTextFile(source() / clone / file, text);
    if (!fs::exists(source() / clone / ".git")) git(clone, {"init", "-q"});
    git(clone, {"add", "-A"});
    git(clone, {"commit", "-q", "-m", "work"}, time);
    return git(clone, {"rev-parse", "HEAD"});
  }
  DownloadedSubmissions read(const CloneOptions& options = {}) const {
    return readClones(source(), options, exercises_);
  }
  ImportReport import(const DownloadedSubmissions& submissions) const {
    return importSubmissions(submissions, {.exercises = exercises_, .handedOut = {{"02-control", "starter"}}},
                             handedIn());
  }
  static const DownloadedSubmission& of(const DownloadedSubmissions& submissions, const std::string& place) {
    return *std::find_if(submissions.all.begin(), submissions.all.end(),
                         [&](const DownloadedSubmission& one) { return one.place == place; });
  }

  TemporaryFolder folder_;
  std::vector<submission::ExerciseInfo> exercises_;
};

TEST_F(GitClonesTest, TakesAClassWithItsRosterAndRecord) {
  const auto all = syntheticClass(rounds(12, 200), {"int honest;\n", "int wrong;\n", "int {\n"});
  std::vector<std::string> commits;
  for (const SyntheticStudent& student : all) {
    const SyntheticStudent& owner =
        student.isSecond ? all[static_cast<std::size_t>(student.partner)] : student;
    const std::string clone = "kinematics-" + owner.user;
    const bool hasOwn = !student.isSecond && student.work != SyntheticWork::kMissing;
    if (hasOwn) commit(clone, "starter", kNoon, "exercises/02-control/main.cpp");
    const std::string id = hasOwn ? commit(clone, student.text, student.time) : "";
    commits.push_back(student.isSecond ? commits.back() : id);
    // Dated back by the student, long after the deadline.
    if (hasOwn) commit(clone, "too late", student.time - 100);
  }
  const ImportReport report = import(read({.roster = write("roster.csv", rosterOfClones(all)),
                                           .record = write("grades.csv", recordOfClones(all, commits))}));
  EXPECT_THAT(report.complaints, IsEmpty());
  EXPECT_EQ(report.timesOfPlatform, report.handedIn);
  const ImportTable table = readImportTable(handedIn() / kImportTable);
  EXPECT_EQ(table.students.size(), all.size());
  for (std::size_t k = 0; k < all.size(); ++k) {
    const ImportedExercise* told = table.find(all[k].email, kExercise);
    ASSERT_NE(told, nullptr) << k;
    EXPECT_EQ(table.find(all[k].email, "02-control"), nullptr) << "as it was handed out";
    if (all[k].work == SyntheticWork::kMissing) {
      EXPECT_EQ(told->status, SubmissionStatus::kNothing);
      continue;
    }
    EXPECT_EQ(fileText(handedIn() / told->handedInBy / kExercise / "main.cpp"), all[k].text);
    EXPECT_EQ(told->identifier, all[k].user);
    EXPECT_EQ(told->submitted, all[k].time);
    EXPECT_EQ(told->commit, commits[k]);
  }
}

TEST_F(GitClonesTest, CountsTheCommitsThatChangedAFile) {
  commit("hw-adam", "// 1", kNoon), commit("hw-adam", "// other", kNoon, "exercises/02-control/main.cpp");
  commit("hw-adam", "// 2", kNoon + 60), commit("hw-adam", "// 3", kNoon + 7200);
  commit("hw-anna", "// a", kNoon);
  import(read({.deadline = kNoon + 3600}));
  const ImportTable table = readImportTable(handedIn() / kImportTable);
  EXPECT_EQ(table.find("adam", kExercise)->attempts, 2) << "until the deadline";
  EXPECT_EQ(table.find("adam", kExercise)->attemptsFrom, "git");
  EXPECT_EQ(table.find("adam", "02-control")->attempts, 1);
}

TEST_F(GitClonesTest, SaysThatDatesOfCommitsAreTheStudents) {
  commit("hw-adam", "// early", kNoon), commit("hw-adam", "// late", kNoon + 7200),
      commit("hw-anna", "// a", kNoon);
  const DownloadedSubmissions newest = read();
  EXPECT_EQ(of(newest, "hw-adam").files.front().text, "// late");
  EXPECT_EQ(of(newest, "hw-adam").people.front().githubUsername, "adam");
  EXPECT_EQ(of(newest, "hw-adam").timeFrom, "git");
  EXPECT_THAT(newest.notes,
              Contains(HasSubstr("2 clones: which commit counts, and when it was made, is known from "
                                 "dates in the clone alone, which students can set")));
  const DownloadedSubmissions until = read({.deadline = kNoon + 3600});
  EXPECT_EQ(of(until, "hw-adam").files.front().text, "// early");
  EXPECT_EQ(of(until, "hw-adam").submitted, kNoon);
  EXPECT_THAT(until.notes, Contains("hw-adam: 1 newer commit left out"));
  const DownloadedSubmissions none = read({.deadline = kNoon - 1});
  EXPECT_EQ(of(none, "hw-adam").whyNone, "no commit until 2026-11-20T11:59:59Z");
  EXPECT_THAT(import(none).complaints, Contains("hw-adam: not taken: no commit until 2026-11-20T11:59:59Z"));
}

TEST_F(GitClonesTest, TakesTheLastCommitUntilTheTimeOfTheRecord) {
  commit("hw-adam", "// early", kNoon), commit("hw-adam", "// late", kNoon + 7200),
      commit("hw-anna", "// a", kNoon);
  const fs::path record =
      write("record.csv",
            "repository,username,submitted,commit\n"
            "hw-adam,adam,2026-11-20 13:00:00 UTC,\nhw-gone,bob,2026-11-20 13:00:00 UTC,\n");
  const DownloadedSubmissions found = read({.record = record});
  EXPECT_EQ(of(found, "hw-adam").files.front().text, "// early");
  EXPECT_EQ(of(found, "hw-adam").submitted, kNoon + 3600);
  EXPECT_EQ(of(found, "hw-adam").timeFrom, "platform");
  EXPECT_THAT(found.notes, Contains(HasSubstr("1 clone: the record has a time but no commit")));
  EXPECT_THAT(found.doubts, Contains("hw-anna: not in the record of the platform"));
  EXPECT_EQ(of(found, "hw-gone").whyNone, "no clone of it");
  // A record of pushes names no people, and its times may be local.
  write("record.csv",
        "repository,submitted,commit\nhw-adam,2026-11-20 14:00:00,\nhw-gone,2026-11-20 14:00:00,\n");
  const DownloadedSubmissions pushes = read({.record = record, .timeZone = "Europe/Berlin"});
  EXPECT_EQ(of(pushes, "hw-adam").people.front().githubUsername, "adam");
  EXPECT_EQ(of(pushes, "hw-adam").submitted, kNoon + 3600);
  EXPECT_EQ(of(pushes, "hw-gone").people.front().githubUsername, "gone");
  EXPECT_REX_ERROR(read({.record = record}), "--time-zone ZONE");
  write("record.csv", "repository,username,submitted,commit\nhw-adam,adam,,1234567890\n");
  EXPECT_EQ(of(read({.record = record}), "hw-adam").whyNone,
            "the clone lacks the commit 1234567890 of the record");
  write("record.csv", "repository,username,submitted,commit\nhw-adam,adam,,--all\n");
  EXPECT_EQ(of(read({.record = record}), "hw-adam").whyNone,
            "the clone lacks the commit --all of the record");
  write("record.csv", "a,b\n");
  EXPECT_REX_ERROR(read({.record = record}),
                   "not a record of the platform: found the columns a, b, wanted a column");
  EXPECT_REX_ERROR(read({.roster = record}),
                   "not a roster: found the columns a, b, wanted a column 'identifier'");
}

TEST_F(GitClonesTest, TakesTheCommitOfTheLastTagOfClassroom50) {
  const std::string early = commit("hw-adam", "// early", kNoon);
  git("hw-adam", {"tag", "submit/2026-11-20T12-00-10Z-" + early.substr(0, 7)});
  const std::string late = commit("hw-adam", "// late", kNoon + 7200);
  git("hw-adam", {"tag", "-m", "note", "submit/2026-11-20T14-00-10Z-" + late.substr(0, 7)});
  git("hw-adam", {"tag", "submit/of-my-own"});
  commit("hw-adam", "// not handed in", kNoon - 60), commit("hw-anna", "// a", kNoon);
  for (const bool isPacked : {false, true}) {
    if (isPacked) git("hw-adam", {"pack-refs", "--all"});
    const DownloadedSubmissions newest = read();
    EXPECT_EQ(of(newest, "hw-adam").files.front().text, "// late");
    EXPECT_EQ(of(newest, "hw-adam").submitted, kNoon + 7210);
    EXPECT_EQ(of(newest, "hw-adam").commit, late);
    EXPECT_EQ(of(newest, "hw-adam").timeFrom, "git");
    EXPECT_EQ(of(newest, "hw-anna").files.front().text, "// a") << "without tags";
    EXPECT_THAT(newest.notes, Contains(HasSubstr("1 clone: taken is the commit of the last tag submit/...")));
    const DownloadedSubmissions until = read({.deadline = kNoon + 3600});
    EXPECT_EQ(of(until, "hw-adam").files.front().text, "// early");
    EXPECT_EQ(of(until, "hw-adam").submitted, kNoon + 10);
    EXPECT_EQ(of(read({.deadline = kNoon}), "hw-adam").whyNone,
              "no tag submit/TIME-COMMIT until 2026-11-20T12:00:00Z");
  }
}

TEST_F(GitClonesTest, FindsTheStudentInTheNameOfTheClone) {
  commit("week-1-anna-lena", "a", kNoon), commit("week-1-andrea", "b", kNoon);
  commit("group/project", "c", kNoon);
  fs::create_directories(source() / "empty");
  write("clones/notes.txt", "");
  const DownloadedSubmissions found = read({.assignment = "week-1"});
  EXPECT_EQ(of(found, "week-1-anna-lena").people.front().githubUsername, "anna-lena");
  EXPECT_EQ(of(found, "group").people.front().githubUsername, "group") << "as in GitLab";
  EXPECT_THAT(found.complaints, Contains("empty: no clone: found none, wanted a folder .git"));
  EXPECT_THAT(found.notes, Contains("notes.txt: ignored"));
  const fs::path roster =
      write("roster.csv", "identifier,github_username,github_id,name\n7,Anna-Lena,,Anna\n");
  const DownloadedSubmissions listed = read({.roster = roster});
  EXPECT_EQ(of(listed, "week-1-anna-lena").people.front().name, "Anna");
  EXPECT_THAT(listed.notes, Contains(HasSubstr("week-1-andrea: '")));
}

TEST_F(GitClonesTest, ObeysNothingInAClone) {
  const std::string first = commit("hw-eve", "// eve", kNoon);
  const fs::path mark = folder_.path() / "mark", clone = source() / "hw-eve";
  const std::string touch = "touch " + mark.string();
  writeTextFile(clone / ".gitattributes", "*.cpp filter=evil diff=evil\n");
  commit("hw-eve", "// eve 2", kNoon);
  writeTextFile(clone / ".git/config",
                "[core]\n\tfsmonitor = " + touch + "\n\thooksPath = hooks\n\tpager = " + touch +
                    "\n\tsshCommand = " + touch + "\n[filter \"evil\"]\n\tsmudge = " + touch +
                    "\n\tclean = " + touch + "\n[diff \"evil\"]\n\ttextconv = " + touch +
                    "\n[alias]\n\trev-list = !" + touch + "\n[include]\n\tpath = /dev/zero\n");
  for (const char* hook : {"post-checkout", "reference-transaction", "fsmonitor-watchman"}) {
    writeTextFile(clone / ".git/hooks" / hook, "#!/bin/sh\n" + touch + "\n");
    fs::permissions(clone / ".git/hooks" / hook, fs::perms::all);
  }
  EXPECT_EQ(of(read(), "hw-eve").files.front().text, "// eve 2");
  // What git would show in place of the newest commit.
  const std::string second = Repository(OpenedFolder(clone)).history().front().id;
  writeTextFile(clone / ".git/refs/replace" / second, first + "\n");
  EXPECT_EQ(of(read(), "hw-eve").files.front().text, "// eve 2");
  EXPECT_FALSE(fs::exists(mark));
}

TEST_F(GitClonesTest, RefusesClonesThatLeadElsewhere) {
  commit("hw-adam", "// adam", kNoon);
  const auto expectRefusal = [&](const std::string& clone, const std::string& why) {
    const DownloadedSubmissions found = read();
    EXPECT_THAT(of(found, clone).whyNone, HasSubstr("cannot read this repository: found " + why)) << clone;
    EXPECT_EQ(of(found, "hw-adam").files.size(), 1u) << "the others are read all the same";
  };
  writeTextFile(source() / "hw-file/.git", "gitdir: ../hw-adam/.git\n");
  expectRefusal("hw-file", "no folder .git");
  fs::create_directories(source() / "hw-link/.git");
  fs::create_directory_symlink(source() / "hw-adam/.git/objects", source() / "hw-link/.git/objects");
  expectRefusal("hw-link", "no folder .git/objects");
  commit("hw-borrows", "// b", kNoon);
  writeTextFile(source() / "hw-borrows/.git/objects/info/alternates",
                (source() / "hw-adam/.git/objects").string());
  expectRefusal("hw-borrows", "objects that lie in another repository");
  commit("hw-pack", "// p", kNoon);
  fs::remove_all(source() / "hw-pack/.git/objects/pack");
  fs::create_directory_symlink(source() / "hw-adam/.git/objects/pack",
                               source() / "hw-pack/.git/objects/pack");
  expectRefusal("hw-pack", "a .git/objects/pack that is neither file nor folder");
  commit("hw-object", "// o", kNoon);
  const fs::path object = source() / "hw-object/.git/objects" /
                          git("hw-object", {"rev-parse", "HEAD"}).insert(2, "/"),
                 another = source() / "hw-adam/object";
  fs::rename(object, another);
  fs::create_symlink(another, object);
  expectRefusal("hw-object", "a .git/objects/" +
                                 object.lexically_relative(object.parent_path().parent_path()).string() +
                                 " that is neither file nor folder");
  commit("hw-head", "// h", kNoon);
  writeTextFile(source() / "hw-head/.git/HEAD", "--output=/tmp/x\n");
  expectRefusal("hw-head", "'--output=/tmp/x' as its newest commit");
  writeTextFile(source() / "hw-head/.git/HEAD", std::string(40, 'a') + "\n");
  expectRefusal("hw-head", "git says: ");
  writeTextFile(source() / "hw-head/.git/HEAD", "ref: refs/../../../hw-adam/.git/refs/heads/main\n");
  EXPECT_EQ(of(read(), "hw-head").whyNone, "no commit");
}

// A commit of some gigabytes, which packs into a few megabytes, fills no machine.
TEST_F(GitClonesTest, GivesGitLittleMemory) {
  commit("hw-adam", "// adam", kNoon);
  const fs::path limit = write("limit", "");
  writeTextFile(folder_.path() / "bin/git", "#!/bin/sh\nulimit -v > '" + limit.string() + "'\nexit 1\n");
  fs::permissions(folder_.path() / "bin/git", fs::perms::owner_all);
  const std::string path = ::getenv("PATH");
  ::setenv("PATH", ((folder_.path() / "bin").string() + ":" + path).c_str(), 1);
  EXPECT_THAT(of(read(), "hw-adam").whyNone, HasSubstr("git says: "));
  ::setenv("PATH", path.c_str(), 1);
  EXPECT_EQ(fileText(limit), "1048576\n");
}

TEST_F(GitClonesTest, TakesNoLinksAndReadsPackedBranches) {
  const fs::path clone = source() / "hw-adam/exercises/02-control";
  commit("hw-adam", "// adam", kNoon);
  fs::create_directories(clone);
  fs::create_symlink("/etc/passwd", clone / "main.cpp");
  commit("hw-adam", std::string((2u << 20) + 1, ' '), kNoon + 1, "03/main.cpp");
  git("hw-adam", {"pack-refs", "--all"});
  git("hw-adam", {"gc", "-q"});
  const DownloadedSubmissions found = read();
  std::vector<std::string> whyNot;
  for (const DownloadedFile& file : of(found, "hw-adam").files) whyNot.push_back(file.whyNot);
  EXPECT_THAT(whyNot, ::testing::UnorderedElementsAre("", "a symbolic link", "more than 2 MiB"));
  EXPECT_THAT(
      import(found).complaints,
      Contains("hw-adam/exercises/02-control/main.cpp: not accepted: found a symbolic link, wanted a C++ "
               "source file or an archive"));
  commit("hw-bob", "// no exercise", kNoon, "notes.txt");
  EXPECT_THAT(of(read(), "hw-bob").whyNone, HasSubstr("no main.cpp in its commit "));
}

TEST_F(GitClonesTest, ReadsShallowClones) {
  commit("hw-adam", "// old", kNoon), commit("hw-adam", "// new", kNoon + 1);
  const fs::path shallow = source() / "hw-bob";
  fs::create_directories(shallow.parent_path());
  git("hw-adam",
      {"clone", "-q", "--depth", "1", "file://" + (source() / "hw-adam").string(), shallow.string()});
  EXPECT_EQ(of(read(), "hw-bob").files.front().text, "// new");
}

}  // namespace rex::classroom::git_clones_test
