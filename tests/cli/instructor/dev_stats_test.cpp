// `rex dev stats` on results that are made by hand.
#include <nlohmann/json.hpp>

#include "cli/command_schema.h"
#include "cli/template_project.h"
#include "grading/results.h"
#include "support/needs_gnuplot.h"

namespace rex::cli::dev_stats_test {

using grading::Outcome;
using ::testing::HasSubstr;
using Json = nlohmann::json;

class DevStatsTest : public TemplateProject {
 protected:
  fs::path results() const { return root() / "results"; }
  void save(const std::string& student, int score, std::optional<Outcome> first, double seconds) const {
    grading::GradeResult result;
    result.exerciseId = "98-template";
    result.outcome = score == 3 ? Outcome::kPass : Outcome::kFail;
    result.score = score;
    result.maxScore = 3;
    result.usage.wallSeconds = seconds;
    result.checks = {{.id = "keeps",
                      .part = "p",
                      .title = "Keeps, \"all\"",
                      .status = Outcome::kPass,
                      .points = 1,
                      .maxPoints = 1},
                     {.id = "turns",
                      .part = "r",
                      .title = "Turns",
                      .group = grading::Group::kHidden,
                      .status = first,
                      .points = first == Outcome::kPass ? 2 : 0,
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
    TemplateProject::SetUp();
    save("adam", 3, Outcome::kPass, 1), save("bob", 1, Outcome::kTimeLimit, 9),
        save("carl", 0, Outcome::kFail, 2), save("dora", 2, Outcome::kFail, 3);
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
            "  part p  #################### 100 % of 1 points, 4 of 4 have them all\n"
            "  part r  #####...............  25 % of 2 points, 1 of 4 have them all\n"
            "  3 of 4 failed: Turns [turns, hidden]: 1 timeout, 2 wrong; correlation with\n"
            "      the rest 0.00\n"
            "  1 check passed by all\n");
}

TEST_F(DevStatsTest, PrintsJsonAndCsv) {
  const std::string text = stats({"--json"}).output;
  EXPECT_EQ(schemaFaultsOf(text, "dev_stats"), "");
  const Json json = Json::parse(text);
  const Json& one = json.at("exercises").at(0);
  EXPECT_EQ(one.at("mean_points"), 1.5);
  EXPECT_EQ(one.at("distribution").at("none"), 1);
  EXPECT_EQ(one.at("parts").at(1), (Json{{"id", "r"}, {"max_points", 2}, {"mean_points", 0.5}, {"full", 1}}));
  EXPECT_EQ(one.at("checks").at(0), (Json{{"id", "turns"},
                                          {"part", "r"},
                                          {"title", "Turns"},
                                          {"group", "hidden"},
                                          {"failed", 3},
                                          {"classes", {{"timeout", 1}, {"wrong", 2}}},
                                          {"questions", Json::object()},
                                          {"discrimination", 0.0}}));
  EXPECT_TRUE(json.at("not_counted").empty());
  EXPECT_EQ(stats({"--csv"}).output,
            "exercise,part,check,group,graded,failed,classes,question,discrimination\n"
            "98-template,r,turns,hidden,4,3,\"1 timeout, 2 wrong\",,0.00\n"
            "98-template,p,keeps,visible,4,0,,,\n");
}

TEST_F(DevStatsTest, TellsWhatItDoesNotCount) {
  write(results() / "adam" / "98-template" / "results.json", "[1, 2");
  const Ended ended = stats({"--json"});
  EXPECT_EQ(ended.code, 2);
  EXPECT_THAT(flat(ended.error), HasSubstr("adam/98-template/results.json: result file: not JSON"));
  EXPECT_EQ(Json::parse(ended.output).at("not_counted").size(), 1u);
  EXPECT_EQ(Json::parse(ended.output).at("exercises").at(0).at("graded"), 3);
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

}  // namespace rex::cli::dev_stats_test
