#include "classroom/student_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/archive_samples.h"

namespace rex::classroom::student_files_test {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr const char* kText = "int main() {}\n";

class StudentFilesTest : public ::testing::Test {
 protected:
  StudentFilesTest() {
    exercises_.resize(2);
    exercises_[0].name = "01-kinematics";
    exercises_[1].name = "02-control";
  }
  PickedFiles pick(std::vector<DownloadedFile> files, const std::string& exercise = {}) const {
    for (DownloadedFile& file : files) file.place = "zoe/" + file.name;
    return pickFiles(files, {.exercises = exercises_, .exercise = exercise, .handedOut = handedOut_});
  }
  // "01-kinematics from zoe/01/main.cpp".
  std::vector<std::string> sources(const PickedFiles& picked) const {
    std::vector<std::string> texts;
    for (const PickedFile& file : picked.files) texts.push_back(file.exercise + " from " + file.source);
    return texts;
  }
  void expectComplaint(const PickedFiles& picked, const std::string& text) const {
    EXPECT_THAT(picked.complaints, ElementsAre(HasSubstr(text)));
    EXPECT_THAT(picked.files, IsEmpty());
  }
  std::vector<submission::ExerciseInfo> exercises_;
  std::map<std::string, std::string> handedOut_{};
};

TEST_F(StudentFilesTest, FindsExercisesByTheFolderAroundTheirFile) {
  const PickedFiles picked = pick({{.name = "course/exercises/01-kinematics/main.cpp", .text = kText},
                                   {.name = "control/main.cpp", .text = kText},
                                   {.name = "notes.txt"},
                                   {.name = "receipt.json"},
                                   {.name = "__MACOSX/main.cpp", .text = kText}});
  EXPECT_THAT(sources(picked), ElementsAre("01-kinematics from zoe/course/exercises/01-kinematics/main.cpp",
                                           "02-control from zoe/control/main.cpp"));
  EXPECT_THAT(picked.complaints, IsEmpty());
  EXPECT_THAT(picked.notes, ElementsAre("zoe/notes.txt: ignored"));
}

TEST_F(StudentFilesTest, TakesTimesOfWorkFromAReceipt) {
  exercises_[0].parts.emplace_back().id = "step";
  const auto pickedWith = [&](const std::string& receipt) {
    return pick({{.name = "01/main.cpp", .text = kText}, {.name = "receipt.json", .text = receipt}});
  };
  const PickedFiles picked = pickedWith(
      R"({"files": [{"name": "01-kinematics/main.cpp", "work": {"seconds": 60, "parts": {"step": 30}}}]})");
  EXPECT_EQ(picked.files.at(0).work.value().seconds, 60);
  EXPECT_EQ(picked.files.at(0).work->parts.at("step"), 30);
  EXPECT_THAT(picked.notes, IsEmpty());
  for (const char* plain :
       {"", "7", "{}", R"({"files": 7})", R"({"files": [7, {"name": "01-kinematics/main.cpp"}]})"}) {
    EXPECT_FALSE(pickedWith(plain).files.at(0).work) << plain;
    EXPECT_THAT(pickedWith(plain).notes, IsEmpty()) << plain;
  }
  for (const char* odd :
       {R"({"files": [{"name": "01-kinematics/main.cpp", "work": {"seconds": -60, "parts": {}}}]})",
        R"({"files": [{"name": "01-kinematics/main.cpp", "work": {"seconds": 9, "parts": {"x": 3}}}]})",
        R"({"files": [{"name": "09/main.cpp", "work": {"seconds": 9, "parts": {}}}]})",
        R"({"files": [{"work": {"seconds": 9, "parts": {}}}]})"}) {
    EXPECT_FALSE(pickedWith(odd).files.at(0).work) << odd;
    EXPECT_THAT(pickedWith(odd).notes,
                ElementsAre("zoe/receipt.json: left out, as rex did not write it: how long "
                            "somebody worked"))
        << odd;
  }
}

TEST_F(StudentFilesTest, TakesAFileAnywhereIfTheExerciseIsKnown) {
  EXPECT_THAT(sources(pick({{.name = "main.cpp", .text = kText}}, "02-control")),
              ElementsAre("02-control from zoe/main.cpp"));
  const PickedFiles renamed =
      pick({{.name = "main (1).cpp", .text = kText}, {.name = "01/main.cpp", .text = kText}}, "02-control");
  EXPECT_THAT(sources(renamed), ElementsAre("02-control from zoe/main (1).cpp"));
  EXPECT_THAT(renamed.notes,
              ElementsAre("zoe/01/main.cpp: not of 02-control", "zoe/main (1).cpp: taken as main.cpp"));
  expectComplaint(
      pick({{.name = "main.cpp", .text = kText}}),
      "zoe/main.cpp: no exercise folder around it: found a file, wanted 01-kinematics/main.cpp, or "
      "--exercise EXERCISE");
  expectComplaint(pick({{.name = "a.cpp", .text = kText}, {.name = "b.cpp", .text = kText}}, "02-control"),
                  "zoe/a.cpp: more than one source file: found also 'zoe/b.cpp', wanted one, or main.cpp");
}

TEST_F(StudentFilesTest, LooksIntoAFewArchivesOnly) {
  const std::string zip = zipOf({{.name = "01/main.cpp", .text = kText}});
  std::vector<DownloadedFile> files(20, {.name = "a.zip", .text = zip});
  EXPECT_EQ(pick(files).files.size(), 1u);
  EXPECT_THAT(pick(files).complaints, IsEmpty());
  files.resize(30, files.front());
  EXPECT_THAT(pick(files).complaints,
              ElementsAre("zoe/a.zip: not accepted: found more than 20 archives of one student, wanted one"));
}

TEST_F(StudentFilesTest, LooksIntoArchives) {
  const std::string zip = zipOf({{.name = "01/main.cpp", .text = kText}, {.name = "receipt.json"}});
  EXPECT_THAT(sources(pick({{.name = "a.zip", .text = zip}})),
              ElementsAre("01-kinematics from zoe/a.zip/01/main.cpp"));
  EXPECT_THAT(sources(pick({{.name = "control.zip", .text = zipOf({{.name = "main.cpp", .text = kText}})}})),
              ElementsAre("02-control from zoe/control.zip/main.cpp"));
  expectComplaint(pick({{.name = "a.zip", .text = zipOf({{.name = "b.zip", .text = zip}})}}),
                  "zoe/a.zip/b.zip: nothing to grade: found an archive in an archive, wanted "
                  "01-kinematics/main.cpp");
  const PickedFiles beside =
      pick({{.name = "a.zip", .text = zipOf({{.name = "01/main.cpp", .text = kText}, {.name = "b.zip"}})}});
  EXPECT_EQ(beside.files.size(), 1u);
  EXPECT_THAT(beside.complaints, IsEmpty());
  EXPECT_THAT(beside.notes, ElementsAre("zoe/a.zip/b.zip: ignored: an archive in an archive"));
}

TEST_F(StudentFilesTest, RefusesHostileArchivesAndSaysWhy) {
  expectComplaint(
      pick({{.name = "a.zip", .text = zipOf({{.name = "../main.cpp", .text = kText}})}}, "02-control"),
      "zoe/a.zip: this archive is not accepted: member '../main.cpp': found a path out of its folder");
  expectComplaint(
      pick({{.name = "a.zip", .text = zipOf({{.name = "main.cpp", .text = "/x", .mode = 0120777}})}},
           "02-control"),
      "zoe/a.zip/main.cpp: not accepted: found a symbolic link, wanted a C++ source file or an archive");
  expectComplaint(pick({{.name = "a.zip", .text = "no zip"}}, "02-control"),
                  "zoe/a.zip: this archive is not accepted");
}

TEST_F(StudentFilesTest, TakesNeitherOfTwoFilesUnlessTheyAreTheSame) {
  const std::string zip = zipOf({{.name = "01/main.cpp", .text = kText}});
  EXPECT_EQ(pick({{.name = "a.zip", .text = zip}, {.name = "01/main.cpp", .text = kText}}).files.size(), 1u);
  expectComplaint(
      pick({{.name = "a.zip", .text = zip}, {.name = "01/main.cpp", .text = "other"}}),
      "zoe/a.zip/01/main.cpp: two files for 01-kinematics: found another text in 'zoe/01/main.cpp', "
      "wanted one of them");
}

TEST_F(StudentFilesTest, TakesNoFileThatIsAsItWasHandedOut) {
  handedOut_["01-kinematics"] = kText;
  const PickedFiles picked =
      pick({{.name = "01/main.cpp", .text = kText}, {.name = "02/main.cpp", .text = kText}});
  EXPECT_THAT(sources(picked), ElementsAre("02-control from zoe/02/main.cpp"));
  EXPECT_THAT(picked.notes, ElementsAre("zoe/01/main.cpp: as it was handed out, not taken"));
  EXPECT_THAT(picked.complaints, IsEmpty());
}

TEST_F(StudentFilesTest, RefusesWhatGradingWouldRefuse) {
  expectComplaint(pick({{.name = "01/main.cpp", .text = std::string("a\0b", 3)}}),
                  "zoe/01/main.cpp: cannot be graded: found NUL bytes");
  expectComplaint(pick({{.name = "01/main.cpp", .text = std::string((1u << 20) + 1, ' ')}}),
                  "cannot be graded: found more than 1 MiB");
  expectComplaint(pick({{.name = "01/main.cpp", .whyNot = "a symbolic link"}}),
                  "zoe/01/main.cpp: not accepted: found a symbolic link");
  expectComplaint(pick({{.name = "a.pdf"}, {.name = "b.pdf"}}),
                  "zoe/a.pdf: nothing to grade: found this and 1 more");
}

}  // namespace rex::classroom::student_files_test
