// `rex dev stats` on results that are made by hand, and its figures.
#include <set>
#include <utility>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "classroom/import_table.h"
#include "classroom/task_list.h"
#include "cli/command_schema.h"
#include "cli/instructor/class_grades.h"
#include "commands/built_project.h"
#include "grading/results.h"
#include "support/expect_error.h"
#include "support/needs_gnuplot.h"

namespace rex::cli::dev_stats_test {

using grading::Outcome;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

using Json = nlohmann::json;

class DevStatsTest : public BuiltProject {
 protected:
  fs::path results() const { return root() / "results"; }
  void save(const std::string& student, bool keeps, Outcome turns, double seconds) const {
    grading::GradeResult result;
    result.exerciseId = "98-template";
    result.score = (keeps ? 1 : 0) + (turns == Outcome::kPass ? 2 : 0);
    result.outcome = result.score == 3 ? Outcome::kPass : Outcome::kFail;
    result.maxScore = 3;
    result.usage.wallSeconds = seconds;
    result.checks = {{.id = "keeps",
                      .part = "p",
                      .title = "Keeps, \"all\"",
                      .status = keeps ? Outcome::kPass : Outcome::kFail,
                      .points = keeps ? 1 : 0,
                      .maxPoints = 1},
                     {.id = "turns",
                      .part = "r",
                      .title = "Turns",
                      .group = grading::Group::kHidden,
                      .status = turns,
                      .points = turns == Outcome::kPass ? 2 : 0,
                      .maxPoints = 2,
                      .message = ""}};
    fs::create_directories(results() / student / "98-template");
    write(results() / student / "98-template" / "results.json", toJson(result));
  }
  Ended stats(std::vector<std::string> more = {}) const {
    std::vector<std::string> arguments = {"dev", "stats", results().string()};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return rex(arguments);
  }
  void SetUp() override {
    BuiltProject::SetUp();
    save("adam", true, Outcome::kPass, 1), save("bob", true, Outcome::kTimeLimit, 9),
        save("carl", false, Outcome::kFail, 2), save("dora", false, Outcome::kPass, 3);
  }
};

TEST_F(DevStatsTest, PrintsATable) {
  const Ended ended = stats();
  EXPECT_EQ(ended.code, 0) << ended.error;
  EXPECT_EQ(ended.output,
            "98-template: 4 graded, 1 with full score\n"
            "  points   mean 1.5, median 1.5 of 3\n"
            "  at least full: 1   75 %: 0   50 %: 1   25 %: 1   less: 0   none: 1\n"
            "  grading  median 2.5 s, longest 9.0 s (bob)\n"
            "  first full score: at an unknown time, as no list of tasks (tasks.tsv) has it\n"
            "  attempts unknown: neither a platform nor an import has counted them\n"
            "  part p  ##########..........  50 % of 1 points, 2 of 4 have them all\n"
            "  part r  ##########..........  50 % of 2 points, 2 of 4 have them all\n"
            "  2 of 4 failed: Keeps, \"all\" [keeps]: 2 wrong; correlation with the rest\n"
            "      0.00\n"
            "  2 of 4 failed: Turns [turns, hidden]: 1 timeout, 1 wrong; correlation with\n"
            "      the rest 0.00\n");
}

TEST_F(DevStatsTest, PrintsJsonAndCsv) {
  const std::string text = stats({"--json"}).output;
  EXPECT_EQ(schemaFaultsOf(text, "dev_stats"), "");
  const Json json = Json::parse(text);
  const Json& one = json.at("exercises").at(0);
  EXPECT_EQ(one.at("mean_points"), 1.5);
  EXPECT_EQ(one.at("distribution").at("none"), 1);
  EXPECT_EQ(one.at("parts").at(1), (Json{{"id", "r"},
                                         {"max_points", 2},
                                         {"mean_points", 1.0},
                                         {"full", 2},
                                         {"timed", 0},
                                         {"median_hours", nullptr}}));
  EXPECT_EQ(one.at("work"), Json());
  EXPECT_EQ(one.at("checks").at(1), (Json{{"id", "turns"},
                                          {"part", "r"},
                                          {"title", "Turns"},
                                          {"group", "hidden"},
                                          {"failed", 2},
                                          {"classes", {{"timeout", 1}, {"wrong", 1}}},
                                          {"questions", Json::object()},
                                          {"discrimination", 0.0}}));
  EXPECT_TRUE(json.at("not_counted").empty());
  EXPECT_EQ(stats({"--csv"}).output,
            "exercise,part,check,group,graded,failed,classes,question,discrimination\n"
            "98-template,p,keeps,visible,4,2,2 wrong,,0.00\n"
            "98-template,r,turns,hidden,4,2,\"1 timeout, 1 wrong\",,0.00\n");
}

TEST_F(DevStatsTest, TellsWhatItDoesNotCount) {
  write(results() / "adam" / "98-template" / "results.json", "[1, 2");
  const Ended ended = stats({"--json"});
  EXPECT_EQ(ended.code, 2);
  EXPECT_THAT(flat(ended.error), HasSubstr("adam/98-template/results.json: result file: not JSON"));
  EXPECT_EQ(Json::parse(ended.output).at("not_counted").size(), 1u);
  EXPECT_EQ(Json::parse(ended.output).at("exercises").at(0).at("graded"), 3);
}

TEST_F(DevStatsTest, SaysWhenTheFirstFullScoreCameAndHowOftenStudentsHandedIn) {
  save("dora", true, Outcome::kPass, 3);
  std::vector<classroom::Task> tasks;
  for (const auto& [student, submitted] : {std::pair("adam", 1'700'000'000), {"dora", 1'699'990'000}}) {
    tasks.push_back(
        {.student = student, .exercise = "98-template", .submitted = submitted, .timeFrom = "platform"});
  }
  write(results() / "tasks.tsv", classroom::toManifest(tasks));
  const auto entry = [](const std::string& student, int attempts, const std::string& from) {
    return classroom::ImportedStudent{
        .student = student,
        .exercises = {{"98-template",
                       {.platform = "moodle",
                        .status = classroom::SubmissionStatus::kHandedIn,
                        .handedInBy = student,
                        .attempts = attempts,
                        .attemptsFrom = from,
                        .work = submission::WorkTime{.seconds = 3600 * attempts, .parts = {{"p", 1800}}}}}}};
  };
  write(results() / "import.json",
        classroom::importTableText({{entry("adam", 5, "platform"), entry("bob", 2, "imports")}}));
  const std::string deadlines = (root() / "deadlines.toml").string();
  write(deadlines, "[all]\nopening = 2023-11-13T00:00:00Z\ndeadline = 2023-11-14T21:00:00Z\n");
  const Ended ended = stats({"--deadlines", deadlines});
  EXPECT_EQ(ended.code, 0) << ended.error;
  EXPECT_THAT(
      flat(ended.output),
      HasSubstr("first full score: dora, handed in 2023-11-14T19:26:40Z, 1 day 19 h after the opening, "
                "1 h 33 min before the deadline (time from platform)"));
  EXPECT_THAT(flat(ended.output),
              HasSubstr("attempts median 3.5, most 5 (adam); known of 2 of 4, of 1 as the number of imports "
                        "that brought another file: at least so many"));
  EXPECT_THAT(
      ended.output,
      HasSubstr("\n  work     median 3.5 h until the last save, by the 2 who handed in their progress\n"));
  EXPECT_THAT(ended.output, HasSubstr(" have them all; first passed after 0.5 h (median of 2)\n"));
  const std::string text = stats({"--json", "--deadlines", deadlines}).output;
  EXPECT_EQ(schemaFaultsOf(text, "dev_stats"), "");
  const Json one = Json::parse(text).at("exercises").at(0);
  EXPECT_EQ(one.at("first_full").at("student"), "dora");
  EXPECT_EQ(one.at("first_full").at("seconds_before_deadline"), 5600);
  EXPECT_EQ(one.at("attempts"),
            (Json{{"known", 2}, {"at_least", 1}, {"median", 3.5}, {"most", 5}, {"most_by", "adam"}}));
  EXPECT_EQ(one.at("work"), (Json{{"known", 2}, {"median_hours", 3.5}}));
  EXPECT_THAT(stats({"--students"}).output,
              ::testing::StartsWith(
                  "student,exercise,points,possible,outcome,submitted,time_from,attempts,attempts_from\n"
                  "adam,98-template,3,3,pass,2023-11-14T22:13:20Z,platform,5,platform\n"
                  "bob,98-template,1,3,fail,,,2,imports\n"));
  write(deadlines, "[all]\ndeadline = 2023-11-14T19:20:00Z\n");
  EXPECT_THAT(flat(stats({"--deadlines", deadlines}).output), HasSubstr("Z, 6 min after the deadline (time"));
}

TEST_F(DevStatsTest, BelievesNoResultThatWasEdited) {
  const fs::path file = results() / "carl" / "98-template" / "results.json";
  Json json = Json::parse(fileText(file));
  json["score"] = 3;
  write(file, json.dump());
  const Ended ended = stats();
  EXPECT_EQ(ended.code, 2);
  EXPECT_THAT(flat(ended.error),
              HasSubstr("carl/98-template/results.json: a result that does not add up: score"));
  EXPECT_THAT(ended.output, HasSubstr("98-template: 3 graded"));
}

TEST_F(DevStatsTest, TellsWrongUse) {
  EXPECT_EQ(rex({"dev", "stats"}).code, 64);
  const Ended missing = rex({"dev", "stats", (root() / "none").string()});
  EXPECT_EQ(missing.code, 64);
  EXPECT_THAT(flat(missing.error), HasSubstr("none: no such folder: wanted the folder of results"));
  fs::create_directory(root() / "empty");
  const Ended empty = rex({"dev", "stats", (root() / "empty").string()});
  EXPECT_EQ(empty.code, 64);
  EXPECT_THAT(flat(empty.error),
              HasSubstr("nothing to evaluate: found no results, wanted STUDENT/EXERCISE/"));
  EXPECT_EQ(stats({"--json", "--csv"}).code, 64);
  EXPECT_EQ(stats({"--json", "--students"}).code, 64);
}

TEST_F(DevStatsTest, DrawsThePoints) {
  REX_NEEDS_GNUPLOT();
  const fs::path figure = root() / "points.png";
  const Ended ended = stats({"-o", figure.string()});
  EXPECT_EQ(ended.code, 0) << ended.error;
  EXPECT_TRUE(fileText(figure).starts_with("\x89PNG"));
  EXPECT_THAT(ended.error, HasSubstr("Drawn: "));
  const fs::path parts = root() / "parts.png";
  EXPECT_EQ(stats({"--parts", parts.string()}).code, 0);
  EXPECT_TRUE(fileText(parts).starts_with("\x89PNG"));
}

classroom::StudentResult resultOf(const std::string& exercise, int score) {
  classroom::StudentResult one{.student = "s", .exercise = exercise, .result = {}};
  one.result.outcome = grading::Outcome::kFail;
  one.result.score = score;
  one.result.maxScore = 4;
  return one;
}

TEST(ClassFigure, ShowsEveryStudentAndTheMedians) {
  const Figure figure = pointsFigure({resultOf("01-a", 4), resultOf("01-a", 4), resultOf("01-a", 1),
                                      resultOf("05-b", 2), resultOf("05-b", 3), resultOf("extra", 0)});
  ASSERT_EQ(figure.series.size(), 2u);
  EXPECT_THAT(figure.series[0].y, ElementsAre(100, 100, 25, 50, 75, 0));
  EXPECT_THAT(figure.series[1].x, ElementsAre(1, 5, 6)) << "without a number: after all others";
  EXPECT_THAT(figure.series[1].y, ElementsAre(100, 62.5, 0));
  EXPECT_NO_THROW(static_cast<void>(figure.xRange.value()));
}

TEST(ClassFigure, LaysNoTwoPointsOnEachOther) {
  std::vector<classroom::StudentResult> results;
  for (int k = 0; k < 200; ++k) results.push_back(resultOf("03-a", k % 3));
  const Series students = pointsFigure(results).series[0];
  std::set<std::pair<double, double>> places;
  for (std::size_t k = 0; k < 200; ++k) {
    places.insert({students.x[k], students.y[k]});
    EXPECT_LT(std::abs(students.x[k] - 3), 0.5);
  }
  EXPECT_EQ(places.size(), 200u);
}

TEST(ClassFigure, NeedsPoints) {
  std::vector<classroom::StudentResult> results = {resultOf("01-a", 0)};
  results[0].result.outcome = grading::Outcome::kGraderError;
  EXPECT_REX_ERROR(pointsFigure(results), "no points to draw: found only faults of the grader");
}

TEST(ClassFigure, ShowsWhichPartIsHard) {
  classroom::ExerciseStatistics first{.exercise = "03-a", .graded = 2},
      second{.exercise = "05-b", .graded = 2}, none{.exercise = "06-c"};
  first.parts = {{.id = "easy", .maxPoints = 4, .meanPoints = 4},
                 {.id = "hard", .maxPoints = 4, .meanPoints = 1}};
  second.parts = {{.id = "half", .maxPoints = 2, .meanPoints = 1}};
  none.parts = {{.id = "ungraded", .maxPoints = 2}};
  const Figure figure = partsFigure({first, second, none});
  EXPECT_THAT(figure.yNames, ElementsAre("05-b: half", "03-a: hard", "03-a: easy")) << "the first at the top";
  ASSERT_EQ(figure.notes.size(), 3u);
  EXPECT_EQ(figure.notes[1].text, "25 %");
  ASSERT_EQ(figure.regions.size(), 6u);
  EXPECT_THAT(figure.regions[3].x, ElementsAre(0, 25, 25, 0));
  EXPECT_LT(figure.regions[1].y[2], figure.regions[3].y[0]) << "their bars lie on each other";
  EXPECT_GE(figure.xRange->second, 100);
  EXPECT_REX_ERROR(partsFigure({{.exercise = "01-a"}}), "no points to draw: found only faults of the grader");
}

}  // namespace rex::cli::dev_stats_test
