// `rex map` as a user meets it.
#include <algorithm>
#include <filesystem>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "cli/rex_command.h"
#include "support/file_text.h"
#include "support/needs_gnuplot.h"
#include "support/needs_osmesa.h"

namespace rex::cli::map_test {

namespace fs = std::filesystem;
using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::StartsWith;
using MapCommand = RexCommand;

TEST_F(MapCommand, MapsTheBeginningOfTheWalk) {
  const std::vector<std::string> words{"map", "--steps", "15", "--particles", "4", "--json"};
  const ProcessResult result = rex(words);
  ASSERT_EQ(result.exitCode, 0) << result.error;
  const json answer = json::parse(result.output), run = answer["runs"][0];
  EXPECT_EQ(answer["particles"], 4);
  EXPECT_TRUE(answer["files"].empty());
  EXPECT_EQ(run["seed"], 0);
  EXPECT_GT(run["precision"], .95);
  EXPECT_GT(run["recall"], .9);
  EXPECT_NEAR(run["overlap"], 2 / (1 / run["precision"].get<double>() + 1 / run["recall"].get<double>()),
              1e-9);
  EXPECT_LT(run["position"], .5 * run["dead_reckoning"].get<double>());
  EXPECT_LT(run["heading"], .02);
  EXPECT_EQ(rex(words).output, result.output) << "same seed, same bytes";
  const ProcessResult text =
      rex({"map", "--steps", "5", "--particles", "2", "--no-scan-matching", "--seeds", "2", "--seed", "3"});
  EXPECT_EQ(text.exitCode, 0) << text.error;
  EXPECT_THAT(text.output, StartsWith("seed    overlap  precision   recall"));
  EXPECT_THAT(text.output, HasSubstr("\n3 "));
  EXPECT_THAT(text.output, HasSubstr("\n4 "));
}

TEST_F(MapCommand, WritesMapAndFilm) {
  REX_NEEDS_OSMESA();
  REX_NEEDS_GNUPLOT();
  const ProcessResult result = rex({"map", "--steps", "6", "--particles", "2", "-o", "office"});
  ASSERT_EQ(result.exitCode, 0) << result.error;
  for (const char* file : {"map.csv", "map.png", "map_sheet.png"}) {
    EXPECT_THAT(result.output, HasSubstr(std::string("\noffice/") + file));
    EXPECT_GT(fs::file_size(in("office") / file), 300u) << file;
  }
  EXPECT_TRUE(fs::exists(in("office/map/0003.png"))) << "every second step";
  const std::string table = fileText(in("office/map.csv"));
  EXPECT_THAT(table, StartsWith("step,x,y,heading,x_estimate"));
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 8);
  EXPECT_EQ(std::count(table.begin(), table.end(), ','), 8 * 9);
  ASSERT_EQ(rex({"map", "--steps", "2", "--particles", "1", "--no-film", "-o", "office"}).exitCode, 0);
  EXPECT_FALSE(fs::exists(in("office/map_sheet.png"))) << "that of another run";
}

TEST_F(MapCommand, SaysWhatIsWrong) {
  const auto expect = [&](std::vector<std::string> words, const char* text) {
    words.insert(words.begin(), "map");
    const ProcessResult result = rex(words);
    EXPECT_EQ(result.exitCode, 64) << text;
    EXPECT_THAT(flat(result.error), HasSubstr(text));
  };
  expect({"--particles", "0"}, "--particles: found 0, wanted 1 to 300");
  expect({"--cell", "1"}, "--cell: found 1, wanted 0.05 to 0.5");
  expect({"--rays", "2"}, "--rays: found 2, wanted 3 to 1000");
  expect({"--max-range", "0"}, "--max-range: found 0, wanted 0.5 to 100");
  expect({"--range-noise", "-1"}, "--range-noise: found -1, wanted 0 to 1");
  expect({"--odometry-noise", "0"}, "--odometry-noise: found 0, wanted 0.001 to 0.3");
  expect({"--steps", "1"}, "--steps: found 1, wanted 2 to 187");
  expect({"--seeds", "0"}, "--seeds: found 0, wanted 1 to 1000");
  expect({"--no-film"}, "--no-film: found no effect on its own, wanted -o with it");
  std::ofstream(in("file")) << "x";
  expect({"-o", "file"}, "-o file: found Not a directory, wanted a folder");
}

TEST_F(MapCommand, HasExamplesThatRun) {
  REX_NEEDS_OSMESA();
  REX_NEEDS_GNUPLOT();
  const auto examples = examplesOf("map");
  EXPECT_EQ(examples.size(), 3u);
  for (std::vector<std::string> words : examples) {
    words.insert(words.end(), {"--steps", "2"});
    EXPECT_EQ(rex(words).exitCode, 0) << words.back();
  }
}

}  // namespace rex::cli::map_test
