#include "classroom/tutors.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/text_file.h"
#include "classroom/gradebook.h"
#include "support/class_results.h"
#include "support/expect_error.h"
#include "support/temporary_folder.h"

namespace rex::classroom::tutors_test {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

const std::string kEx = "01-kinematics";

TEST(TutorShares, AreSectionsAndEvenPartsOfTheRest) {
  Course course{.tutors = {{.name = "A"}, {.name = "B"}, {.name = "S", .section = "south"}}};
  for (int k = 0; k < 10; ++k)
    course.students.push_back({.id = fmt::format("s{}", k), .section = k < 4 ? "south" : ""});
  course.students[4].group = course.students[5].group = "pair";
  std::map<std::string, int> counts;
  const auto shares = tutorShares(course);
  for (const auto& [student, tutor] : shares) ++counts[tutor];
  EXPECT_EQ(counts, (std::map<std::string, int>{{"A", 3}, {"B", 3}, {"S", 4}}));
  EXPECT_EQ(shares.at("s0"), "S");
  EXPECT_EQ(shares.at("s4"), shares.at("s5")) << "a group stays together";
  course.tutors = {{.name = "S", .section = "south"}};
  EXPECT_EQ(tutorShares(course).size(), 4u) << "the others are nobody's";
}

TEST(BlindIds, LeadToPeopleByTheSecretOnly) {
  const Course course{.students = {{.id = "adam"}, {.id = "zoe"}}};
  const std::string zoe = blindId("the secret of the course", "zoe");
  EXPECT_THAT(zoe, AllOf(HasSubstr("blind-"), ::testing::SizeIs(16)));
  EXPECT_NE(zoe, blindId("another secret of it", "zoe"));
  EXPECT_EQ(blindIds("the secret of the course", course).at(zoe), "zoe");
}

/// Ten tutors of 300 people, each with a file.
class TutorsTest : public ::testing::Test {
 protected:
  TutorsTest() {
    for (int k = 0; k < 300; ++k) course_.students.push_back({.id = fmt::format("s{:03}", k)});
    for (int t = 0; t < 10; ++t) course_.tutors.push_back({.name = fmt::format("T{}", t)});
    exercises_[0].name = kEx;
  }
  static std::string adjustment(const std::string& student, const std::string& what) {
    return fmt::format(
        "[[adjustment]]\nstudent = \"{}\"\nexercise = \"01\"\n{}\nreason = \"seen\"\n"
        "author = \"T\"\ndate = 2026-12-01\n",
        student, what);
  }
  Adjustments read(const std::string& name, const std::string& text) const {
    const auto file = folder_.path() / (name + ".toml");
    writeTextFile(file, text);
    return readAdjustments(file, course_, exercises_);
  }
  std::string at(const std::string& name, int line) const {
    return fmt::format("{}:{}:12", (folder_.path() / (name + ".toml")).string(), line);
  }

  TemporaryFolder folder_;
  Course course_;
  std::vector<submission::ExerciseInfo> exercises_{1};
};

TEST_F(TutorsTest, AreMergedAndConflictsNamed) {
  std::map<std::string, std::string> texts;
  for (const auto& [student, tutor] : tutorShares(course_)) texts[tutor] += adjustment(student, "points = 7");
  ASSERT_EQ(texts.size(), 10u);
  texts["T0"] = adjustment("s001", "points = 3") + adjustment("s002", "add = 1\ncheck = \"hand\"") +
                adjustment("s004", "points = 7") + texts["T0"];
  texts["T9"] += adjustment("s002", "add = 1\ncheck = \"hand\"") + adjustment("s003", "points = 2") +
                 adjustment("s009", "add = -1");
  std::vector<std::pair<std::string, Adjustments>> all;
  for (const auto& [tutor, text] : texts) all.emplace_back(tutor, read(tutor, text));
  const Adjustments merged = mergeAdjustments(read("own", adjustment("s009", "points = 9")), all);
  EXPECT_THAT(
      merged.conflicts,
      ElementsAre("s001 01-kinematics: 3 points (T0: " + at("T0", 3) + "), 7 points (T1: " + at("T1", 3) +
                      "): none of it counts until the adjustments of the course decide",
                  "s002 01-kinematics [hand]: +1 points (T0: " + at("T0", 10) + "), +1 points (T9: " +
                      at("T9", 213) + "): none of it counts until the adjustments of the course decide",
                  "s003 01-kinematics: 7 points (T3: " + at("T3", 3) + "), 2 points (T9: " + at("T9", 221) +
                      "): none of it counts until the adjustments of the course decide"));
  std::map<std::string, std::vector<std::int64_t>> points;
  for (const Adjustment& one : merged.adjustments) points[one.students.at(0)].push_back(*one.points);
  EXPECT_EQ(points.size(), 298u) << "without s001 and s003; of s002, the final points are no conflict";
  EXPECT_THAT(points.at("s004"), ElementsAre(700)) << "two tutors agree";
  EXPECT_THAT(points.at("s009"), ElementsAre(900)) << "the course decides";
  EXPECT_THAT(merged.notes, ElementsAre(at("own", 3) + " decides instead of " + at("T9", 3),
                                        at("own", 3) + " decides instead of " + at("T9", 228)));
}

TEST_F(TutorsTest, NameStudentsByBlindIdsAndListComplaints) {
  const BlindIds blind = blindIds("the secret of the course", course_);
  const std::string id = blindId("the secret of the course", "s007");
  writeTextFile(folder_.path() / "t.toml",
                adjustment(id, "points = 5") + "[[complaint]]\nstudent = \"" + id +
                    "\"\nexercise = \"01\"\ndate = 2026-12-02\n"
                    "text = \"The hand is right.\"\n[[complaint]]\nstudent = \"s008\"\n"
                    "exercise = \"01\"\ndate = 2026-12-01\ntext = \"Late.\"\n"
                    "answer = \"It was.\"\n");
  const Adjustments all = readAdjustments(folder_.path() / "t.toml", course_, exercises_, blind);
  EXPECT_THAT(all.adjustments.at(0).students, ElementsAre("s007"));
  ASSERT_EQ(all.complaints.size(), 2u);
  EXPECT_THAT(all.complaints[0].students, ElementsAre("s007"));
  EXPECT_TRUE(all.complaints[0].answer.empty());
  EXPECT_EQ(all.complaints[1].answer, "It was.");
  EXPECT_THAT(
      messageOf([&] { (void)readAdjustments(folder_.path() / "t.toml", course_, exercises_); }),
      HasSubstr("found an id without a name, wanted the secret_file of the course, which leads to the "
                "student"));
}

}  // namespace rex::classroom::tutors_test
