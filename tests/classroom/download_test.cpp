#include "classroom/download.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/text_file.h"
#include "support/archive_samples.h"
#include "support/expect_error.h"
#include "support/temporary_folder.h"

namespace rex::classroom::download_test {

using ::testing::HasSubstr;

std::vector<submission::ExerciseInfo> twoExercises() {
  std::vector<submission::ExerciseInfo> exercises(2);
  exercises[0].name = "01-kinematics";
  exercises[1].name = "02-control";
  return exercises;
}

Layout layout(const std::vector<std::string>& names) { return recognizeLayout(names, twoExercises()); }

TEST(DownloadLayout, IsKnownByTheNamesThatPlatformsGive) {
  const std::pair<const char*, Platform> samples[] = {
      {"Zoe Miller_501_assignsubmission_file_/main.cpp", Platform::kMoodle},
      {"Robotics-501/Zoe_501_assignsubmission_file_/course.zip", Platform::kMoodle},
      {"Zoe Miller_501_assignsubmission_file/main.cpp", Platform::kMoodle},
      {"Zoe_501_assignsubmission_file_main.cpp", Platform::kMoodle},
      {"kinematics-zoe/.git/HEAD", Platform::kGit},
      {"zoe/kinematics/.git/HEAD", Platform::kGit},
      {"assignment_7_export/submission_metadata.yml", Platform::kGradescope},
      {"zoe/main.cpp", Platform::kFolders},
      {"zoe.cpp", Platform::kFolders},
      {"mails/zoe.zip", Platform::kFolders}};
  for (const auto& [name, platform] : samples) {
    EXPECT_EQ(layout({name}).platform, platform) << name;
    EXPECT_FALSE(layout({name}).isReady) << name;
  }
}

TEST(DownloadLayout, IsReadyForGradingWithAFolderPerStudentAndExercise) {
  EXPECT_TRUE(layout({"zoe/01-kinematics/main.cpp"}).isReady);
  EXPECT_TRUE(layout({"zoe/01/main.cpp", "notes.txt"}).isReady);
  EXPECT_FALSE(layout({"zoe/01/main.cpp"}).platform);
  EXPECT_FALSE(layout({"zoe/07/main.cpp"}).isReady) << "no exercise";
}

TEST(DownloadLayout, SaysWhatIsThere) {
  EXPECT_EQ(layout({}).found, "nothing");
  EXPECT_EQ(layout({"__MACOSX/a.cpp", ".DS_Store"}).found, "nothing");
  EXPECT_EQ(layout({"a/b.txt"}).found, "1 file such as 'a/b.txt'");
  EXPECT_EQ(layout({"a/b.txt", "a/c.txt"}).found, "2 files such as 'a/b.txt'");
  EXPECT_EQ(layout({"b/c.txt", "a/b.txt", "a/d.txt"}).found, "2 entries such as 'a'");
  EXPECT_FALSE(layout({"a/b.txt"}).platform);
}

TEST(DownloadLayout, OfAFolderLooksIntoNoRepository) {
  const TemporaryFolder folder;
  writeTextFile(folder.path() / "hw-zoe/.git/objects/Zoe_1_assignsubmission_file_", "x");
  writeTextFile(folder.path() / "hw-zoe/01/main.cpp", "x");
  EXPECT_EQ(recognizeFolderLayout(folder.path(), twoExercises()).platform, Platform::kGit);
  EXPECT_EQ(recognizeFolderLayout(folder.path(), twoExercises()).found, "2 files such as 'hw-zoe/.git/HEAD'");
  requireLayout(Platform::kGit, folder.path(), twoExercises());
  EXPECT_REX_ERROR(
      requireLayout(Platform::kMoodle, folder.path(), twoExercises()),
      "nothing that `rex import moodle` knows: found 2 files such as 'hw-zoe/.git/HEAD', wanted the "
      "zip of \"Download all submissions\"");
}

TEST(DownloadLayout, IsRequiredOfArchives) {
  const TemporaryFolder folder;
  const std::filesystem::path zip = folder.path() / "all.zip";
  writeTextFile(zip, zipOf({{.name = "Zoe_501_assignsubmission_file_/main.cpp", .text = "x"}}));
  EXPECT_EQ(readPlatformDownload(Platform::kMoodle, zip, twoExercises()).files.size(), 1u);
  EXPECT_REX_ERROR(
      (void)readPlatformDownload(Platform::kFolders, zip, twoExercises()),
      "nothing that `rex import folders` knows: found 1 file such as "
      "'Zoe_501_assignsubmission_file_/main.cpp', wanted 'NAME/main.cpp', 'NAME.cpp' or 'NAME.zip' for "
      "each student; `rex import moodle` takes what is there");
}

// One student with too much is left out and named; it costs the others nothing.
TEST(Download, OfAFolderLeavesOutStudentsWithTooMuch) {
  const TemporaryFolder folder;
  writeTextFile(folder.path() / "Adam/main.cpp", "");
  for (int k = 0; k < 3; ++k) {
    writeTextFile(folder.path() / "Zoe" / (std::to_string(k) + ".zip"), "");
    std::filesystem::resize_file(folder.path() / "Zoe" / (std::to_string(k) + ".zip"), 19u << 20);
  }
  std::string deep = "Eve";
  for (int k = 0; k < 32; ++k) deep += "/a";
  writeTextFile(folder.path() / deep / "main.cpp", "");
  std::vector<std::string> found;
  for (const DownloadedFile& file : readDownload(folder.path()).files)
    found.push_back(file.name.substr(0, 5) + ": " + file.whyNot);
  EXPECT_THAT(found, ::testing::ElementsAre("Adam/: ", "Eve/a: more than 30 folders in folders",
                                            "Zoe/0: more than 40 MiB in the files of one student"));
}

TEST(Download, OfAFolderLooksIntoThirtyFoldersAndNoMore) {
  const TemporaryFolder folder;
  std::string deep = "zoe";
  for (int k = 0; k < 29; ++k) deep += "/d";
  writeTextFile(folder.path() / deep / "main.cpp", "a");
  writeTextFile(folder.path() / deep / "e/main.cpp", "b");
  const Download download = readDownload(folder.path());
  ASSERT_EQ(download.files.size(), 2u);
  EXPECT_EQ(download.files[0].whyNot, "more than 30 folders in folders");
  EXPECT_EQ(download.files[1].text, "a");
}

TEST(MoodleNames, ComeApart) {
  const auto parts = parseMoodleName("Group A-Zoe_M_501_assignsubmission_file_main_1.cpp");
  ASSERT_TRUE(parts);
  EXPECT_EQ(parts->person, "Group A-Zoe_M");
  EXPECT_EQ(parts->number, "501");
  EXPECT_EQ(parts->kind, "file");
  EXPECT_EQ(parts->file, "main_1.cpp");
  for (const char* folder : {"Zoe_7_assignsubmission_onlinetext_", "Zoe_7_assignsubmission_onlinetext"}) {
    EXPECT_EQ(parseMoodleName(folder).value().kind, "onlinetext") << folder;
    EXPECT_EQ(parseMoodleName(folder).value().file, "") << folder;
  }
  for (const char* other :
       {"", "zoe", "_assignsubmission_file_", "Zoe_assignsubmission_file_", "501_assignsubmission_file_",
        "Zoe__assignsubmission_file_", "Zoe_5x_assignsubmission_file_", "Zoe_501_assignsubmission_",
        "Zoe_501_assignsubmission_file.cpp"})
    EXPECT_FALSE(parseMoodleName(other)) << other;
}

TEST(Platforms, HaveTheNamesOfTheirCommands) {
  EXPECT_EQ(toString(Platform::kMoodle), "moodle");
  EXPECT_EQ(toString(Platform::kGit), "git");
  EXPECT_EQ(toString(Platform::kGradescope), "gradescope");
  EXPECT_EQ(toString(Platform::kFolders), "folders");
}

}  // namespace rex::classroom::download_test
