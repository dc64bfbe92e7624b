#include "classroom/submission_folder.h"

#include <atomic>
#include <cstdio>
#include <fstream>
#include <regex>
#include <set>
#include <thread>

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include "base/text_file.h"
#include "support/archive_samples.h"
#include "support/expect_error.h"
#include "support/paths.h"
#include "support/temporary_folder.h"

namespace rex::classroom::submission_folder_test {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class HandInTest : public ::testing::Test {
 protected:
  HandInTest() {
    exercises_.resize(2);
    exercises_[0].name = "01-kinematics";
    exercises_[1].name = "02-control";
    fs::create_directories(folder());
  }
  fs::path folder() const { return temporary_.path() / "in"; }
  void write(const std::string& name, const std::string& text = "int main() {}\n") const {
    writeTextFile(folder() / name, text);
  }
  SubmittedFiles read(const std::string& only = {}) const {
    return readSubmittedFiles(folder(), exercises_, only);
  }
  static std::vector<std::string> namesOf(const SubmittedFiles& found) {
    std::vector<std::string> names;
    for (const SubmittedFile& file : found.files) names.push_back(file.student + " " + file.exercise);
    return names;
  }
  // What is refused besides `good`, whose file must be taken all the same.
  void expectComplaint(const std::string& text) const {
    write("good/01-kinematics/main.cpp");
    const SubmittedFiles found = read();
    EXPECT_THAT(found.complaints, ElementsAre(HasSubstr(text)));
    EXPECT_THAT(namesOf(found), ::testing::Contains("good 01-kinematics"));
  }

  TemporaryFolder temporary_;
  std::vector<submission::ExerciseInfo> exercises_;
};

TEST_F(HandInTest, TakesEachFileOfEachStudentInOrder) {
  write("zoe/02-control/main.cpp");
  write("zoe/kinematics/main.cpp", "// zoe");
  write("adam/02/main.cpp");
  write("Müller, Änne/01-kinematics/main.cpp");
  const SubmittedFiles found = read();
  EXPECT_THAT(namesOf(found), ElementsAre("Müller, Änne 01-kinematics", "adam 02-control",
                                          "zoe 01-kinematics", "zoe 02-control"));
  EXPECT_THAT(found.complaints, IsEmpty());
  EXPECT_EQ(found.files[2].text, "// zoe");
  EXPECT_THAT(namesOf(read("02")), ElementsAre("adam 02-control", "zoe 02-control"));
  EXPECT_REX_ERROR(read("03"), "no exercise is called '03'");
}

TEST_F(HandInTest, TellsWhenAFileWasModified) {
  write("zoe/01/main.cpp");
  const timespec times[2] = {{1, 0}, {1'700'000'000, 0}};
  ASSERT_EQ(::utimensat(AT_FDCWD, (folder() / "zoe/01/main.cpp").c_str(), times, 0), 0);
  EXPECT_EQ(read().files.at(0).submitted, 1'700'000'000);
}

TEST_F(HandInTest, NotesWhatIsNotGraded) {
  write("zoe/01/main.cpp"), write("zoe/01/notes.txt"), write("zoe/receipt.json"), write(".DS_Store");
  const SubmittedFiles found = read();
  EXPECT_THAT(found.complaints, IsEmpty());
  EXPECT_THAT(found.notes, ElementsAre(HasSubstr(".DS_Store: ignored"), HasSubstr("notes.txt: ignored")));
}

TEST_F(HandInTest, ComplainsOfAnUnknownExercise) {
  write("zoe/01-kinematic/main.cpp");
  const SubmittedFiles found = read();
  EXPECT_THAT(found.complaints,
              ElementsAre(AllOf(HasSubstr("in/zoe/01-kinematic: no exercise is called '01-kinematic'"),
                                HasSubstr("did you mean '01-kinematics'")),
                          HasSubstr("in/zoe: nothing to grade: found no exercise folder, wanted "
                                    "01-kinematics/main.cpp")));
}

TEST_F(HandInTest, ComplainsOfStudentsWithoutAnExerciseEvenIfOnlyOneIsWanted) {
  write("zoe/main.cpp"), write("adam/01/main.cpp");
  const SubmittedFiles found = read("02");
  EXPECT_THAT(found.complaints,
              ElementsAre(HasSubstr("in/zoe: nothing to grade: found no exercise folder, wanted "
                                    "02-control/main.cpp")));
  EXPECT_THAT(found.files, IsEmpty());
}

TEST_F(HandInTest, ComplainsOfAMissingFileAndLetsGradingSaySo) {
  fs::create_directories(folder() / "zoe" / "01");
  expectComplaint("in/zoe/01/main.cpp: cannot be graded: found no file, wanted a C++ source file");
  EXPECT_FALSE(read().files.back().text);
}

TEST_F(HandInTest, FollowsNoLinks) {
  writeTextFile(temporary_.path() / "secret" / "01" / "main.cpp", "secret");
  fs::create_directory_symlink(temporary_.path() / "secret", folder() / "zoe");
  expectComplaint(
      "in/zoe: not accepted: found a symbolic link, wanted a folder, .zip, .tar or .tar.gz file for each "
      "student");
  fs::remove(folder() / "zoe");
  fs::create_directories(folder() / "yan" / "02");
  write("yan/02/main.cpp");
  fs::create_directory_symlink(temporary_.path() / "secret" / "01", folder() / "yan" / "01");
  expectComplaint("in/yan/01: not accepted: found a symbolic link, wanted a folder for each exercise");
  fs::remove(folder() / "yan" / "01"), fs::remove(folder() / "yan" / "02" / "main.cpp");
  fs::create_symlink(temporary_.path() / "secret" / "01" / "main.cpp", folder() / "yan" / "02" / "main.cpp");
  expectComplaint("in/yan/02/main.cpp: cannot be graded: found a symbolic link");
}

TEST_F(HandInTest, ComplainsOfLargeFilesPipesAndStrayFiles) {
  write("zoe/01/main.cpp", std::string((1u << 20) + 1, ' '));
  expectComplaint("in/zoe/01/main.cpp: cannot be graded: found more than 1 MiB");
  fs::remove_all(folder() / "zoe");
  fs::create_directories(folder() / "zoe/01");
  ASSERT_EQ(::mkfifo((folder() / "zoe/01/main.cpp").c_str(), 0600), 0);
  expectComplaint("in/zoe/01/main.cpp: cannot be graded: found a pipe or device");
  fs::remove_all(folder() / "zoe");
  write("main.cpp");
  expectComplaint(
      "in/main.cpp: not accepted: found a file, wanted a folder, .zip, .tar or .tar.gz file for each "
      "student");
}

TEST_F(HandInTest, TakesArchivesAsFolders) {
  const auto pack = [&](const std::string& name, const std::vector<SampleMember>& members) {
    write(name, name.ends_with(".zip") ? zipOf(members) : tarOf(members));
  };
  pack("zoe.zip",
       {{.name = "01/main.cpp", .text = "// zoe"}, {.name = "receipt.json"}, {.name = "notes.txt"}});
  pack("adam.tar", {{.name = "./02-control/main.cpp", .text = "// adam"}});
  const timespec times[2] = {{1, 0}, {1'700'000'000, 0}};
  ASSERT_EQ(::utimensat(AT_FDCWD, (folder() / "zoe.zip").c_str(), times, 0), 0);
  SubmittedFiles found = read();
  EXPECT_THAT(namesOf(found), ElementsAre("adam 02-control", "zoe 01-kinematics"));
  EXPECT_THAT(found.complaints, IsEmpty());
  EXPECT_THAT(found.notes, ElementsAre(HasSubstr("in/zoe.zip/notes.txt: ignored")));
  EXPECT_EQ(found.files[0].text, "// adam");
  EXPECT_EQ(found.files[1].submitted, 1'700'000'000);
  EXPECT_THAT(namesOf(read("02")), ElementsAre("adam 02-control"));
  pack("zoe.zip", {{.name = "01/main.cpp"}, {.name = "kinematics/main.cpp"}});
  fs::remove(folder() / "adam.tar");
  expectComplaint("in/zoe.zip: the same name of an exercise, spelt differently: found '01' and 'kinematics'");
  pack("zoe.zip", {{.name = "main.cpp"}});
  expectComplaint("in/zoe.zip: nothing to grade: found no exercise folder, wanted 01-kinematics/main.cpp");
  pack("zoe.zip", {{.name = "../01/main.cpp"}});
  expectComplaint("in/zoe.zip: this archive is not accepted: member '../01/main.cpp': found a path out");
  pack("zoe.zip", {{.name = "01/main.cpp"}});
  write("zoe/01/main.cpp");
  expectComplaint("in: the same name of a student, spelt differently: found 'zoe' and 'zoe.zip', wanted one");
}

TEST_F(HandInTest, TakesArchivesWithOneFolderAroundAll) {
  write("zoe.zip", zipOf({{.name = "Zoe's work/01/main.cpp", .text = "// zoe"},
                          {.name = "Zoe's work/01/build/main.cpp"},
                          {.name = "__MACOSX/Zoe's work/01/._main.cpp"},
                          {.name = "Zoe's work/receipt.json"}}));
  const SubmittedFiles found = read();
  EXPECT_THAT(namesOf(found), ElementsAre("zoe 01-kinematics"));
  EXPECT_THAT(found.complaints, IsEmpty());
  EXPECT_EQ(found.files[0].text, "// zoe");
  EXPECT_EQ(found.files[0].from, folder() / "zoe.zip/Zoe's work/01/main.cpp");
  EXPECT_THAT(found.notes, ElementsAre(HasSubstr("in/zoe.zip: taken from its folder 'Zoe's work'"),
                                       HasSubstr("Zoe's work/01/build/main.cpp: ignored"),
                                       HasSubstr("._main.cpp: ignored")));
  // A folder that is not an exercise decides nothing.
  write("zoe.zip", zipOf({{.name = "01/main.cpp", .text = "// zoe"}, {.name = "01/build/main.cpp"}}));
  EXPECT_THAT(read().complaints, IsEmpty());
  EXPECT_EQ(read().files[0].text, "// zoe");
  write("zoe.zip", zipOf({{.name = "work/01-kinematcs/main.cpp"}}));
  EXPECT_THAT(read().complaints,
              ElementsAre(HasSubstr("in/zoe.zip/work/01-kinematcs: no exercise is called '01-kinematcs'"),
                          HasSubstr("in/zoe.zip: nothing to grade")));
}

TEST_F(HandInTest, RefusesArchivesWithTwoRoots) {
  const auto expectRefusal = [&](const std::string& other, const std::string& found) {
    write("zoe.zip", zipOf({{.name = "work/01/main.cpp"}, {.name = other}}));
    expectComplaint("in/zoe.zip: exercises in more than one folder: found " + found + ", wanted one of them");
    EXPECT_THAT(namesOf(read()), ElementsAre("good 01-kinematics"));
  };
  expectRefusal("old/01/main.cpp", "'old' and 'work'");
  expectRefusal("old/02/main.cpp", "'old' and 'work'");
  expectRefusal("01/main.cpp", "its top and 'work'");
}

TEST_F(HandInTest, TakesNeitherOfTwoSpellings) {
  write("zoe/01/main.cpp"), write("zoe/kinematics/main.cpp");
  expectComplaint(
      "in/zoe: the same name of an exercise, spelt differently: found '01' and 'kinematics', "
      "wanted one of them");
  EXPECT_THAT(namesOf(read()), ElementsAre("good 01-kinematics"));
  fs::remove_all(folder() / "zoe");
  write("Zoe/01/main.cpp"), write("zoe/02/main.cpp");
  expectComplaint("in: the same name of a student, spelt differently: found 'Zoe' and 'zoe', wanted one");
  EXPECT_THAT(namesOf(read()), ElementsAre("good 01-kinematics"));
}

TEST_F(HandInTest, RefusesNamesThatCannotBeFolders) {
  const std::vector<std::pair<std::string, std::string>> names = {
      {".hidden", "begins with a dot"},
      {"a\nb", "a control character"},
      {"\xff\xfe", "bytes that are not UTF-8"},
      {"a\\b", "a slash"},
      {std::string(101, 'a'), "101 bytes"},
      {" a", "a leading or trailing blank"},
      {"a ", "a leading or trailing blank"},
      {"Grades.CSV", "the name of a results file"},
      {"tasks.tsv", "the name of a results file"},
      {"Jobs.tsv", "the name of a results file"},
      {"slurm-7-1.log", "the name of a results file"},
      {"grades.csv.4711.new", "the name of a results file"},
      {"a\u202Eb", "an invisible one"},
      {"a\u200Bb", "an invisible one"},
      {"a\u2028b", "an invisible one"},
      {"\u00A0zoe", "a leading or trailing blank"}};
  for (const auto& [name, why] : names) {
    write(name + "/01/main.cpp");
    expectComplaint(why);
    fs::remove_all(folder() / name);
  }
  for (const char* name : {"..", ".", "", "../x", "a/b"}) EXPECT_NE(whyNoStudentName(name), "") << name;
  for (const char* name : {"o'hara \"x\"", "$(touch x)", "-o", "=1", "a..b", "Müller"})
    EXPECT_EQ(whyNoStudentName(name), "") << name;
}

// Whatever rex or a script of share/ci writes beside the folders of students.
TEST_F(HandInTest, ReservesTheNameOfEveryFileBesideTheStudents) {
  const fs::path root = homeFolder();
  std::set<std::string> names;
  const auto collect = [&](const fs::path& file, const std::regex& pattern) {
    const std::string text = readTextFile(file);
    for (std::sregex_iterator match(text.begin(), text.end(), pattern), end; match != end; ++match)
      names.insert((*match)[1].str());
  };
  for (const auto& entry : fs::directory_iterator(root / "share/ci"))
    if (entry.is_regular_file()) collect(entry.path(), std::regex("\\$results/([^\" ]+)"));
  for (const auto& entry : fs::directory_iterator(root / "src/cli/instructor"))
    if (entry.path().extension() == ".cpp") collect(entry.path(), std::regex("options\\.out / \"([^\"]+)\""));
  EXPECT_THAT(names, ::testing::IsSupersetOf({"tasks.tsv", "jobs.tsv", "grades.csv"}));
  for (const std::string& name : names) EXPECT_NE(whyNoStudentName(name), "") << name;
}

TEST_F(HandInTest, WritesNoListUnderTheNameOfAStudent) {
  EXPECT_REX_ERROR(requireNameOfResults(folder() / "zoe", folder()), "wanted a name that ends in .tsv");
  requireNameOfResults(folder() / "list.tsv", folder());
  requireNameOfResults(temporary_.path() / "list", folder());
}

TEST_F(HandInTest, FailsWithoutAFolder) {
  EXPECT_REX_ERROR(readSubmittedFiles(folder() / "none", exercises_), "in/none: cannot read this folder");
}

TEST_F(HandInTest, KeepsACopyOfWhatCanBeRead) {
  const fs::path out = temporary_.path() / "out";
  SubmittedFile file{.student = "zoe", .exercise = "01-kinematics", .from = "x/main.cpp", .text = "int a;"};
  EXPECT_EQ(writeSnapshot(file, out), fs::path("zoe/01-kinematics/main.cpp"));
  EXPECT_EQ(readTextFile(out / "zoe/01-kinematics/main.cpp"), "int a;");
  file.text = "int b;";
  static_cast<void>(writeSnapshot(file, out));
  EXPECT_EQ(readTextFile(out / "zoe/01-kinematics/main.cpp"), "int b;");
  file.text.reset();
  file.whyNot = "a symbolic link";
  EXPECT_EQ(writeSnapshot(file, out), fs::path("zoe/01-kinematics/main.cpp"));
  EXPECT_THAT(readTextFile(out / "zoe/01-kinematics/main.cpp"),
              HasSubstr("#error cannot be graded: found a symbolic link, wanted a C++ source file\n"));
}

// Their owner swaps the file, the folder around it and the student's folder for links to another's while they
// are read: a hand-in is the owner's own file, or is not taken.
TEST_F(HandInTest, ReadsNoOtherFileWhateverIsSwapped) {
  writeTextFile(temporary_.path() / "victim/01/main.cpp", "// victim");
  const fs::path victim = temporary_.path() / "victim";
  for (const auto& [own, other] :
       {std::pair(fs::path("zoe/01/main.cpp"), victim / "01/main.cpp"),
        std::pair(fs::path("zoe/01"), victim / "01"), std::pair(fs::path("zoe"), victim)}) {
    SCOPED_TRACE(own);
    fs::remove_all(folder());
    write("zoe/01/main.cpp", "// own");
    const fs::path link = temporary_.path() / "link";
    fs::create_symlink(other, link);
    std::atomic<bool> isOver = false;
    std::thread swapping([&] {
      while (!isOver)
        ::renameat2(AT_FDCWD, link.c_str(), AT_FDCWD, (folder() / own).c_str(), RENAME_EXCHANGE);
    });
    int taken = 0;
    // A busy machine may always let the other thread run between the same two calls.
    for (int k = 0; k < 300 || (taken == 0 && k < 100'000); ++k)
      for (const SubmittedFile& file : read().files) {
        taken += file.text ? 1 : 0;
        EXPECT_NE(file.text, "// victim");
      }
    isOver = true;
    swapping.join();
    EXPECT_GT(taken, 0);
    fs::remove_all(link);
  }
}

TEST_F(HandInTest, TakesArchivesOfHonestPeople) {
  write("zoe.zip", zipOf({{.name = "01/", .mode = 040755},
                          {.name = "01/main.cpp", .text = "// zoe"},
                          {.name = "01/notes 10:30.txt"},
                          {.name = "01/\x81"
                                   "bung.txt"},
                          {.name = "01/latest", .text = "main.cpp", .mode = 0120777},
                          {.name = "01/.DS_Store"},
                          {.name = "__MACOSX/01/main.cpp"},
                          {.name = "__MACOSX/01/._main.cpp"}}));
  const SubmittedFiles found = read();
  EXPECT_THAT(found.complaints, IsEmpty());
  ASSERT_EQ(found.files.size(), 1u);
  EXPECT_EQ(found.files[0].text, "// zoe");
  EXPECT_THAT(found.notes,
              ::testing::UnorderedElementsAre(
                  HasSubstr("01/notes 10:30.txt: ignored"), HasSubstr("01/\u00FCbung.txt: ignored"),
                  HasSubstr("01/latest: ignored: a symbolic link"), HasSubstr("01/.DS_Store: ignored"),
                  HasSubstr("__MACOSX/01/main.cpp: ignored"), HasSubstr("__MACOSX/01/._main.cpp: ignored")));
}

TEST_F(HandInTest, ComplainsOfALinkInTheFilesPlace) {
  write("zoe.zip", zipOf({{.name = "01/main.cpp", .text = "/etc/passwd", .mode = 0120777},
                          {.name = "02/main.cpp", .text = "// zoe"}}));
  expectComplaint("in/zoe.zip/01/main.cpp: not accepted: found a symbolic link, wanted a C++ source file");
  EXPECT_THAT(namesOf(read()), ElementsAre("good 01-kinematics", "zoe 02-control"));
}

}  // namespace rex::classroom::submission_folder_test
