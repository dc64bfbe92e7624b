#include "submission/exercise_info.h"

#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/expect_error.h"
#include "support/temporary_folder.h"

namespace rex::submission::exercise_info_test {

constexpr const char* kGood = R"(title = "Kinematics"
script = "12.3"

[limits]
cpu_seconds = 2.5
memory_mb = 512
output_mb = 4

[[part]]
id = "maps"
title = "Task maps"
points = 5
hints = ["What moves?", "Which axis?"]

[[part]]
id = "step"
title = "One step"
points = 4
floor = 1

[[forbidden]]
function = "rex::inverseKinematicsStep"
reason = "the step is what you write here"
)";

class ExerciseInfoTest : public ::testing::Test {
 protected:
  std::filesystem::path write(const std::string& name, const std::string& text) {
    const std::filesystem::path folder = temporary_.path() / name;
    std::filesystem::create_directories(folder);
    std::ofstream(folder / "exercise.toml") << text;
    return folder;
  }
  ExerciseInfo read(const std::string& text) { return readExerciseInfo(write("01-demo", text)); }
  ExerciseInfo readWith(const std::string& good, const std::string& bad) {
    std::string text = kGood;
    return read(text.replace(text.find(good), good.size(), bad));
  }
  TemporaryFolder temporary_;
};

TEST_F(ExerciseInfoTest, ReadsEverything) {
  const ExerciseInfo info = read(kGood);
  EXPECT_EQ(info.name, "01-demo");
  EXPECT_EQ(info.title, "Kinematics");
  EXPECT_EQ(info.script, "12.3");
  EXPECT_EQ(info.limits.cpuSeconds, 2.5);
  EXPECT_EQ(info.limits.memory, 512 * grading::kMegabyte);
  EXPECT_EQ(info.limits.output, 4 * grading::kMegabyte);
  ASSERT_EQ(info.parts.size(), 2u);
  EXPECT_EQ(info.parts[0].id, "maps");
  EXPECT_EQ(info.parts[0].title, "Task maps");
  EXPECT_EQ(info.parts[0].floor, 0);
  EXPECT_THAT(info.parts[0].hints, ::testing::ElementsAre("What moves?", "Which axis?"));
  EXPECT_EQ(info.parts[1].points, 4);
  EXPECT_EQ(info.parts[1].floor, 1);
  EXPECT_EQ(info.points(), 9);
  ASSERT_EQ(info.forbidden.size(), 1u);
  EXPECT_EQ(info.forbidden[0].function, "rex::inverseKinematicsStep");
  EXPECT_EQ(info.forbidden[0].reason, "the step is what you write here");
  EXPECT_EQ(info.chapter, 0);
  EXPECT_EQ(info.hours, 0);
  EXPECT_TRUE(info.needs.empty());
  EXPECT_TRUE(info.parts[1].isCore);
  EXPECT_FALSE(readWith("floor = 1", "floor = 1\ncore = false").parts[1].isCore);
  const ExerciseInfo placed = readWith("[limits]", "chapter = 2\nneeds = [\"00\"]\nhours = 5\n[limits]");
  EXPECT_EQ(placed.chapter, 2);
  EXPECT_EQ(placed.hours, 5);
  EXPECT_THAT(placed.needs, ::testing::ElementsAre("00"));
  EXPECT_EQ(info.parts[1].lies, 0);
  EXPECT_EQ(readWith("floor = 1", "floor = 1\nlies = 2").parts[1].lies, 2);
  EXPECT_EQ(info.forbidden[0].part, "");
  EXPECT_THAT(info.allowed, ::testing::ElementsAre("course")) << "if it is left out";
  EXPECT_THAT(readWith("[limits]", "allowed = [\"simulator\", \"rex::lqr\"]\n[limits]").allowed,
              ::testing::ElementsAre("simulator", "rex::lqr"));
  const ExerciseInfo apart = readWith("floor = 1", "floor = 1\nfunctions = [\"f\"]\nallowed = [\"course\"]");
  EXPECT_THAT(apart.parts[1].functions, ::testing::ElementsAre("f"));
  EXPECT_THAT(apart.parts[1].allowed, ::testing::ElementsAre("course"));
  EXPECT_EQ(readWith("reason", "part = \"maps\"\nreason").forbidden[0].part, "maps");
  EXPECT_EQ(info.solution, SolutionRule::kNever);
  for (const auto& [word, rule] : {std::pair{"never", SolutionRule::kNever},
                                   {"after-pass", SolutionRule::kAfterPass},
                                   {"always", SolutionRule::kAlways}})
    EXPECT_EQ(readWith("[limits]", std::string("solution = \"") + word + "\"\n[limits]").solution, rule);
}

TEST_F(ExerciseInfoTest, RefusesBadFilesWithPlaceAndAdvice) {
  EXPECT_REX_ERROR(readExerciseInfo("no/where"), "no/where/exercise.toml: no such file");
  EXPECT_REX_ERROR(read("title = \"x\"\nscript = \n"), "exercise.toml:2:");
  EXPECT_REX_ERROR(
      readWith("title = \"Kin", "titel = \"Kin"),
      "exercise.toml:1:1: unknown key 'titel' in the exercise: wanted one of title, profile, script, "
      "chapter, needs, hours, solution, allowed, limits, part, forbidden (did you mean 'title'?)");
  EXPECT_REX_ERROR(readWith("memory_mb", "memory"), "exercise.toml:6:1: unknown key 'memory' in [limits]");
  EXPECT_REX_ERROR(readWith("floor = 1", "flor = 1"), "exercise.toml:19:1: unknown key 'flor' in [[part]]");
  EXPECT_REX_ERROR(readWith("reason", "why"), "exercise.toml:23:1: unknown key 'why' in [[forbidden]]");
  EXPECT_REX_ERROR(readWith("floor = 1", "functions = [\"f\"]"), "[[part]]: no 'allowed'");
  EXPECT_REX_ERROR(readWith("script = \"12.3\"", ""), "the exercise: no 'script': wanted a string");
  EXPECT_REX_ERROR(readWith("\"12.3\"", "12"),
                   "exercise.toml:2:10: the exercise: 'script': found 12, wanted a string that is not empty");
  EXPECT_REX_ERROR(
      readWith("points = 5", "points = 5.5"),
      "exercise.toml:12:10: [[part]]: 'points': found 5.5, wanted a whole number from 1 to 1000");
  EXPECT_REX_ERROR(readWith("floor = 1", "floor = 5"),
                   "[[part]]: 'floor': found 5, wanted a whole number from 0 to 4");
  EXPECT_REX_ERROR(readWith("[limits]", "solution = \"later\"\n[limits]"),
                   "the exercise: 'solution': found 'later', wanted one of never, after-pass, always");
  EXPECT_REX_ERROR(readWith("[limits]", "profile = \"own\"\n[limits]"),
                   "the exercise: 'profile': found 'own', wanted one of private, public");
  EXPECT_REX_ERROR(readWith("script = \"12.3\"", "profile = \"public\""), "the exercise: no 'script'");
  EXPECT_TRUE(readWith("script = \"12.3\"", "profile = \"private\"").isPrivate);
  EXPECT_REX_ERROR(readWith("2.5", "-1"), "[limits]: 'cpu_seconds': found -1, wanted a number above 0");
  EXPECT_REX_ERROR(readWith("2.5", "nan"), "[limits]: 'cpu_seconds': found nan, wanted a number above 0");
  EXPECT_REX_ERROR(readWith("[\"What moves?\", \"Which axis?\"]", "[1]"),
                   "'hints': found [ 1 ], wanted a list of strings");
  EXPECT_REX_ERROR(readWith("\"step\"", "\"maps\""), "exercise.toml:16:6: two parts are called 'maps'");
  EXPECT_REX_ERROR(read("title = \"x\"\nscript = \"y\"\n"),
                   "no part: wanted at least one table headed [[part]]");
  EXPECT_REX_ERROR(read("title = \"x\"\nscript = \"y\"\npart = 3\n"),
                   "exercise.toml:3:8: 'part': wanted tables headed [[part]]");
  EXPECT_REX_ERROR(read("title = \"x\"\nscript = \"y\"\nlimits = 3\n"),
                   "exercise.toml:3:10: 'limits': wanted a table headed [limits]");
}

TEST_F(ExerciseInfoTest, ListsByNameAndFindsByNumberOrTopic) {
  write("02-pegInAHole", kGood);
  write("01-kinematics", kGood);
  write("01-warmUp", kGood);
  std::filesystem::create_directories(temporary_.path() / "notes");
  const std::vector<ExerciseInfo> all = listExercises(temporary_.path());
  ASSERT_EQ(all.size(), 3u);
  EXPECT_EQ(all[0].name, "01-kinematics");
  EXPECT_EQ(all[2].name, "02-pegInAHole");
  EXPECT_EQ(findExercise(all, "kinematics").name, "01-kinematics");
  EXPECT_EQ(findExercise(all, "02").name, "02-pegInAHole");
  EXPECT_EQ(findExercise(all, "2").name, "02-pegInAHole");
  EXPECT_REX_ERROR(findExercise(all, ""), "no exercise is called");
  EXPECT_EQ(findExercise(all, "01-warmUp").name, "01-warmUp");
  EXPECT_REX_ERROR(findExercise(all, "01"),
                   "several exercises are called '01' (did you mean '01-kinematics' or '01-warmUp'?)");
  EXPECT_REX_ERROR(findExercise(all, "kinematcs"),
                   "no exercise is called 'kinematcs': wanted one of 01-kinematics, 01-warmUp, 02-pegInAHole "
                   "(did you mean 'kinematics' or '01-kinematics'?)");
  EXPECT_TRUE(exerciseNames("no/where").empty());
  EXPECT_TRUE(listExercises("no/where").empty());
}

}  // namespace rex::submission::exercise_info_test
