#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "classroom/import_table.h"

namespace rex::classroom::import_names_test {

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

}  // namespace rex::classroom::import_names_test
