// `rex filter` as a user meets it.
#include <algorithm>
#include <filesystem>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "cli/rex_command.h"
#include "render/png.h"
#include "support/file_text.h"
#include "support/needs_gnuplot.h"
#include "support/needs_osmesa.h"

namespace rex::cli::filter_test {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::StartsWith;

class FilterCommand : public RexCommand {
 protected:
  ProcessResult filter(std::vector<std::string> words) const {
    words.insert(words.begin(), "filter");
    return rex(words);
  }
  nlohmann::json answerOf(std::vector<std::string> words) const {
    words.push_back("--json");
    const ProcessResult result = filter(words);
    EXPECT_EQ(result.exitCode, 0) << result.error;
    return nlohmann::json::parse(result.output);
  }
};

TEST_F(FilterCommand, TellsErrorsAndConsistency) {
  const ProcessResult result = filter({"--steps", "80", "--seeds", "3"});
  ASSERT_EQ(result.exitCode, 0) << result.error;
  EXPECT_THAT(result.output, StartsWith("ekf, 5 landmarks, 80 steps, 3 runs\nerror "));
  for (const char* part : {"dead reckoning", "NEES", "NIS", "consistent: 3; means over the runs lie within"})
    EXPECT_THAT(result.output, HasSubstr(part));
  EXPECT_THAT(filter({"--filter", "ekf-slam", "--steps", "20"}).output,
              HasSubstr("\nmap        5 of 5 landmarks, "));
  EXPECT_THAT(filter({"--filter", "ekf-slam", "--steps", "20", "--seeds", "4"}).output,
              HasSubstr("\nmap        5 of 5 landmarks in each run on average, "))
      << "not the 20 of all runs together";
}

TEST_F(FilterCommand, AnswersPrograms) {
  const auto json = answerOf({"--filter", "particles", "--particles", "200", "--range-bearing", "--max-range",
                              "20", "--field-of-view", "3", "--bearing-noise", "0.05", "--steps", "60",
                              "--seeds", "2", "--seed", "5"});
  EXPECT_EQ(json.at("filter"), "particles");
  EXPECT_EQ(json.at("runs").size(), 2u);
  EXPECT_EQ(json.at("runs")[1].at("seed"), 6);
  EXPECT_TRUE(json.at("nis").is_null()) << "particles have no innovation";
  EXPECT_TRUE(json.at("map").is_null());
  EXPECT_GT(json.at("position"), 0);
  EXPECT_TRUE(json.at("files").empty());
  const auto slam = answerOf({"--filter", "ekf-slam", "--steps", "30", "--landmarks", "3"});
  EXPECT_GT(slam.at("map"), 0);
  EXPECT_GT(slam.at("nis").at("band")[1], slam.at("nis").at("mean"));
}

TEST_F(FilterCommand, EveryFilterRuns) {
  for (const char* name : {"ekf", "ukf", "information", "root", "rts", "particles", "ekf-slam", "fast-slam",
                           "fast-slam-2", "fast-slam-unnamed", "dead-reckoning"}) {
    const auto json = answerOf({"--filter", name, "--steps", "40"});
    EXPECT_LE(json.at("position").get<double>(), 1.5 * json.at("dead_reckoning").get<double>()) << name;
  }
}

// Where landmarks are far apart, names add nothing: the map has each of them once, and as precisely.
TEST_F(FilterCommand, FindsLandmarksWithoutNames) {
  const auto run = [&](const char* name) {
    return answerOf({"--filter", name, "--steps", "100", "--landmarks", "8", "--seed", "1", "--seeds", "2"});
  };
  const auto named = run("fast-slam"), unnamed = run("fast-slam-unnamed");
  EXPECT_EQ(unnamed.at("found_landmarks"), 16);
  EXPECT_LT(unnamed.at("map").get<double>(), 1.5 * named.at("map").get<double>());
  EXPECT_GT(unnamed.at("map"), 0);
}

TEST_F(FilterCommand, WritesTableFiguresAndFilm) {
  REX_NEEDS_OSMESA();
  REX_NEEDS_GNUPLOT();
  if (!runProcess({"ffmpeg", "-version"}).ok()) GTEST_SKIP() << "needs the package ffmpeg";
  const std::vector<std::string> words = {"--filter", "fast-slam", "--steps", "20", "-o"};
  const auto writeInto = [&](const std::string& out) {
    std::vector<std::string> all = words;
    all.push_back(out);
    return filter(all);
  };
  const ProcessResult result = writeInto("a");
  ASSERT_EQ(result.exitCode, 0) << result.error;
  for (const char* file : {"filter.csv", "error_x.png", "error_heading.png", "nees.png", "map.png",
                           "filter.mp4", "filter_sheet.png"}) {
    EXPECT_THAT(result.output, HasSubstr(std::string("\na/") + file));
    EXPECT_GT(fs::file_size(in("a") / file), 1000u) << file;
  }
  EXPECT_TRUE(fs::exists(in("a/filter/0020.png")));
  const std::string table = fileText(in("a/filter.csv"));
  EXPECT_THAT(table, StartsWith("time,x,y,heading,x_estimate"));
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 21);
  EXPECT_EQ(std::count(table.begin(), table.end(), ','), 21 * 19);
  ASSERT_EQ(writeInto("b").exitCode, 0);
  for (const char* file : {"filter.csv", "map.svg", "filter_sheet.png"})
    EXPECT_EQ(fileText(in("a") / file), fileText(in("b") / file)) << file;
  ASSERT_EQ(filter({"--steps", "20", "--no-film", "-o", "a"}).exitCode, 0);
  EXPECT_FALSE(fs::exists(in("a/filter.mp4"))) << "that of another run";
}

TEST_F(FilterCommand, TellsWhereTooFewParticlesAreLeft) {
  const ProcessResult result =
      filter({"--filter", "particles", "--particles", "5", "--steps", "30", "--assume-observation", "0.002"});
  EXPECT_EQ(result.exitCode, 0) << result.error;
  EXPECT_THAT(result.output, HasSubstr("\nsingular   covariances, left out of NEES: 30"));
  EXPECT_THAT(result.output, HasSubstr("in 0.0 % of the steps"));
  EXPECT_THAT(result.output, HasSubstr("\nNEES       none,"));
  const auto json = answerOf(
      {"--filter", "particles", "--particles", "5", "--steps", "30", "--assume-observation", "0.002"});
  EXPECT_TRUE(json.at("nees").at("mean").is_null());
  EXPECT_TRUE(json.at("runs").at(0).at("nees").is_null());
}

TEST_F(FilterCommand, SaysWhatIsWrong) {
  const auto expect = [&](const std::vector<std::string>& words, const char* text) {
    const ProcessResult result = filter(words);
    EXPECT_EQ(result.exitCode, 64) << text;
    EXPECT_THAT(flat(result.error), HasSubstr(text));
  };
  expect({"--filter", "ekff"}, "--filter: found 'ekff', wanted ekf, ukf,");
  expect({"--filter", "ekff"}, "(did you mean 'ekf'?)");
  expect({"--filter", "kalman"},
         "--filter: found 'kalman', wanted ekf, ukf, information or root: the motion of the car");
  expect({"--filter", "histogram"}, "--filter: found 'histogram', wanted particles: with cells finer than");
  expect({"--landmarks", "-1"}, "--landmarks: found -1, wanted 0 to 1000");
  expect({"--steps", "1"}, "--steps: found 1, wanted 2 to 100000");
  expect({"--dynamics-noise", "-1"}, "--dynamics-noise: found -1, wanted 0 to 10");
  expect({"--observation-noise", "0"}, "--observation-noise: found 0, wanted 1e-06 to 1000");
  expect({"--observation-noise", "nan"}, "--observation-noise: found nan");
  expect({"--bearing-noise", "0.1"},
         "--bearing-noise: found no effect on its own, wanted --range-bearing with it");
  expect({"--range-bearing", "--bearing-noise", "0"}, "--bearing-noise: found 0");
  expect({"--max-range", "0"}, "--max-range: found 0, wanted 0.001 to 1e+06");
  expect({"--field-of-view", "7"}, "--field-of-view: found 7, wanted 0.001 to 6.28319");
  expect({"--assume-dynamics", "0"}, "--assume-dynamics: found 0, wanted 0.001 to 1000");
  expect({"--assume-observation", "1e4"}, "--assume-observation: found 10000");
  expect({"--seeds", "0"}, "--seeds: found 0, wanted 1 to 10000");
  expect({"--seeds", "2", "--seed", "18446744073709551615"}, "wanted a whole number of at most 18 digits");
  expect({"--particles", "10"},
         "--particles: found no effect on its own, wanted --filter particles, fast-slam");
  expect({"--filter", "particles", "--particles", "1"}, "--particles: found 1, wanted 2 to 100000");
  expect({"--no-film"}, "--no-film: found no effect on its own, wanted -o with it");
  expect({"--filter", "information", "--dynamics-noise", "0"}, "seed 0, step 1: ");
  std::ofstream(in("file")) << "x";
  expect({"-o", "file"}, "-o file: found Not a directory, wanted a folder");
  expect({"-o", "file/below"}, "-o file/below: found Not a directory, wanted a folder");
  fs::create_directories(in("full/filter.csv"));
  expect({"-o", "full"}, "-o full: found Is a directory, wanted a folder to write to");
}

TEST_F(FilterCommand, HasExamplesThatRun) {
  REX_NEEDS_OSMESA();
  REX_NEEDS_GNUPLOT();
  const auto examples = examplesOf("filter");
  EXPECT_EQ(examples.size(), 4u);
  for (std::vector<std::string> words : examples) {
    words.insert(words.end(), {"--steps", "30"});
    EXPECT_EQ(rex(words).exitCode, 0) << words.back();
  }
}

}  // namespace rex::cli::filter_test
