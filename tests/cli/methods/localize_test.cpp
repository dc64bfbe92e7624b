// `rex localize` as a user meets it.
#include <algorithm>
#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "cli/rex_command.h"
#include "support/file_text.h"
#include "support/needs_gnuplot.h"
#include "support/needs_osmesa.h"

namespace rex::cli::localize_test {

namespace fs = std::filesystem;
using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::StartsWith;
using LocalizeCommand = RexCommand;

// With more rays than by default, so that a scan says nearly everything.
TEST_F(LocalizeCommand, FindsTheRobotAlsoAfterAKidnapping) {
  const std::vector<std::string> words{"localize", "--steps",  "29",          "--particles", "300",
                                       "--rays",   "24",       "--max-range", "8",           "--seeds",
                                       "2",        "--kidnap", "--json"};
  const ProcessResult result = rex(words);
  ASSERT_EQ(result.exitCode, 0) << result.error;
  const json answer = json::parse(result.output);
  EXPECT_EQ(answer["particles"], 300);
  for (const json& run : answer["runs"]) {
    EXPECT_LT(run["found"], 15);
    EXPECT_EQ(run["kidnapped"], 15);
    EXPECT_GE(run["found_again"], 15);
    EXPECT_LT(run["position"], .15);
    EXPECT_LT(run["heading"], .05);
  }
  EXPECT_EQ(answer["runs"][1]["seed"], 1);
}

// Few particles that start elsewhere and are never drawn from a scan do not find it.
TEST_F(LocalizeCommand, SaysThatTheRobotIsLost) {
  const std::vector<std::string> lost{"localize", "--steps", "5", "--particles", "10", "--share", "0"};
  const ProcessResult text = rex(lost);
  EXPECT_EQ(text.exitCode, 1) << text.error;
  EXPECT_THAT(text.output, StartsWith("seed     found  kidnapped  found again"));
  EXPECT_THAT(text.output, HasSubstr("\n0        never"));
  EXPECT_EQ(rex(lost).output, text.output) << "same seed, same bytes";
  std::vector<std::string> words = lost;
  words.push_back("--json");
  const json run = json::parse(rex(words).output)["runs"][0];
  for (const char* name : {"found", "kidnapped", "found_again", "position", "heading"})
    EXPECT_TRUE(run.at(name).is_null()) << name;
  words.insert(words.end(), {"--start", "known"});
  const ProcessResult known = rex(words);
  EXPECT_EQ(known.exitCode, 0) << known.error;
  EXPECT_EQ(json::parse(known.output)["runs"][0]["found"], 0);
}

TEST_F(LocalizeCommand, WritesBeliefErrorAndFilm) {
  REX_NEEDS_OSMESA();
  REX_NEEDS_GNUPLOT();
  const ProcessResult result =
      rex({"localize", "--steps", "4", "--start", "known", "--particles", "50", "-o", "office"});
  ASSERT_EQ(result.exitCode, 0) << result.error;
  for (const char* file : {"localize.csv", "error.png", "localize.png", "localize_sheet.png"}) {
    EXPECT_THAT(result.output, HasSubstr(std::string("\noffice/") + file));
    EXPECT_GT(fs::file_size(in("office") / file), 50u) << file;
  }
  EXPECT_TRUE(fs::exists(in("office/localize/0002.png")));
  const std::string table = fileText(in("office/localize.csv"));
  EXPECT_THAT(table, StartsWith("step,error,heading_error\n0,"));
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 6);
}

TEST_F(LocalizeCommand, SaysWhatIsWrong) {
  const auto expect = [&](std::vector<std::string> words, const char* text) {
    words.insert(words.begin(), "localize");
    const ProcessResult result = rex(words);
    EXPECT_EQ(result.exitCode, 64) << text;
    EXPECT_THAT(flat(result.error), HasSubstr(text));
  };
  expect({"--start", "knwon"}, "--start: found 'knwon', wanted anywhere, known (did you mean 'known'?)");
  expect({"--particles", "9"}, "--particles: found 9, wanted 10 to 5000");
  expect({"--share", "1"}, "--share: found 1, wanted 0 to 0.9");
  expect({"--rays", "2"}, "--rays: found 2, wanted 3 to 1000");
  expect({"--no-film"}, "--no-film: found no effect on its own, wanted -o with it");
}

TEST_F(LocalizeCommand, HasExamplesThatRun) {
  REX_NEEDS_OSMESA();
  REX_NEEDS_GNUPLOT();
  const auto examples = examplesOf("localize");
  EXPECT_EQ(examples.size(), 3u);
  for (std::vector<std::string> words : examples) {
    words.insert(words.end(), {"--steps", "2"});
    const int code = rex(words).exitCode;
    EXPECT_TRUE(code == 0 || code == 1) << words.back() << ": " << code;
  }
}

}  // namespace rex::cli::localize_test
