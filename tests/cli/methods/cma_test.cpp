// `rex cma` as a user meets it.
#include <filesystem>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "cli/rex_command.h"
#include "optim/cma_search.h"
#include "optim/test_functions.h"

namespace rex::cli::cma_test {

using ::testing::HasSubstr;
using CmaCommand = RexCommand;

const std::vector<std::string> kAckley = {"cma",  "--function", "ackley", "--dim",     "5",  "--sigma",
                                          "14.5", "--x0-low",   "1",      "--x0-high", "30", "--lambda",
                                          "12",   "--target",   "1e-3",   "--seeds",   "3"};

std::vector<std::string> operator+(std::vector<std::string> words, const std::vector<std::string>& more) {
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

TEST_F(CmaCommand, CountsAsTheLibraryDoes) {
  const ProcessResult result = rex(kAckley + std::vector<std::string>{"--json"});
  ASSERT_EQ(result.exitCode, 0) << result.error;
  const nlohmann::json json = nlohmann::json::parse(result.output);
  ASSERT_EQ(json["runs"].size(), 3u);
  double sum = 0;
  for (std::uint64_t seed = 0; seed < 3; ++seed) {
    const nlohmann::json& run = json["runs"][seed];
    Rng rng(seed);
    const Eigen::VectorXd start = rng.uniformVector(5, 1, 30);
    const SearchResult own =
        minimizeByCma(batched(testFunction("ackley").value), start, Eigen::VectorXd::Constant(5, 14.5), rng,
                      {.lambda = 12}, {.target = 1e-3});
    EXPECT_EQ(run["seed"], seed);
    EXPECT_EQ(run["evaluations"], own.evaluations);
    EXPECT_EQ(run["best"], own.value);
    EXPECT_EQ(run["success"], true);
    EXPECT_EQ(run["status"], "target reached");
    sum += static_cast<double>(own.evaluations);
  }
  EXPECT_NEAR(json["evaluations_per_success"].get<double>(), sum / 3, 1e-9);
  EXPECT_EQ(rex(kAckley + std::vector<std::string>{"--json"}).output, result.output);
  // What the slide says is what it does by itself.
  const ProcessResult usual =
      rex({"cma", "--function", "ackley", "--dim", "5", "--lambda", "12", "--seeds", "3", "--json"});
  EXPECT_EQ(usual.output, result.output);
}

// Where some runs fail: evaluations of the others, divided by their share.
TEST_F(CmaCommand, CountsFailuresAsTheSlideDoes) {
  const ProcessResult result =
      rex({"cma", "--function", "rastrigin", "--dim", "3", "--lambda", "20", "--seeds", "12", "--json"});
  ASSERT_EQ(result.exitCode, 0) << result.error;
  const nlohmann::json json = nlohmann::json::parse(result.output);
  double spent = 0, successes = 0;
  for (const nlohmann::json& run : json["runs"]) {
    EXPECT_EQ(run["success"], run["best"].get<double>() <= 0.9);
    if (!run["success"].get<bool>()) continue;
    spent += run["evaluations"].get<double>();
    ++successes;
  }
  ASSERT_GT(successes, 0);
  ASSERT_LT(successes, 12);
  EXPECT_NEAR(json["evaluations_per_success"].get<double>(), spent / successes / (successes / 12), 1e-6);
}

TEST_F(CmaCommand, PrintsATableAndDrawsACurve) {
  const std::string folder = in("curve").string();
  const ProcessResult result = rex(kAckley + std::vector<std::string>{"-o", folder, "--seed", "4"});
  ASSERT_EQ(result.exitCode, 0) << result.error;
  EXPECT_THAT(result.output, HasSubstr("seed  evaluations         best  ended by\n       4 "));
  EXPECT_THAT(result.output, HasSubstr("3 of 3 reached the target, "));
  EXPECT_THAT(result.output, HasSubstr("evaluations per success"));
  EXPECT_THAT(result.output, HasSubstr(folder + "/learning-curve.png"));
  EXPECT_GT(std::filesystem::file_size(in("curve") / "learning-curve.png"), 5000u);
}

TEST_F(CmaCommand, SaysThatNoRunSucceeds) {
  const std::vector<std::string> rastrigin = {"cma", "--function", "rastrigin", "--seeds", "2", "--json"};
  const ProcessResult result = rex(rastrigin);
  EXPECT_EQ(result.exitCode, 1);
  const nlohmann::json json = nlohmann::json::parse(result.output);
  EXPECT_EQ(json["runs"][1]["success"], false);
  EXPECT_EQ(json["runs"][1]["status"], "flat");
  EXPECT_TRUE(json["evaluations_per_success"].is_null());
  EXPECT_EQ(rex(rastrigin + std::vector<std::string>{"--restarts", "9"}).exitCode, 0);

  const ProcessResult few = rex({"cma", "--function", "sphere", "--max-evaluations", "5", "--json"});
  EXPECT_EQ(few.exitCode, 1);
  EXPECT_TRUE(nlohmann::json::parse(few.output)["runs"][0]["best"].is_null());
  const ProcessResult drawn = rex({"cma", "--function", "sphere", "--max-evaluations", "5", "-o", "none"});
  EXPECT_EQ(drawn.exitCode, 64);
  EXPECT_THAT(drawn.error, HasSubstr("-o: found no evaluations to draw"));
}

TEST_F(CmaCommand, HasExamplesThatRun) {
  const auto examples = examplesOf("cma");
  EXPECT_EQ(examples.size(), 3u);
  for (const auto& words : examples) EXPECT_EQ(rex(words).exitCode, 0);
}

TEST_F(CmaCommand, SaysWhatIsWrong) {
  const auto expect = [&](std::vector<std::string> words, const char* text, const char* function = "sphere") {
    const ProcessResult result = rex(std::vector<std::string>{"cma", "--function", function} + words);
    EXPECT_EQ(result.exitCode, 64) << result.error;
    EXPECT_THAT(flat(result.error), HasSubstr(text));
  };
  EXPECT_THAT(rex({"cma"}).error, HasSubstr("--function is required"));
  expect({}, "--function: test function: found 'spere', wanted sphere, ellipsoid,", "spere");
  expect({"--dim", "0"}, "--dim: found 0, wanted 1 to 1000");
  expect({"--dim", "1"}, "--dim: found 1, wanted 2 to 1000", "rosenbrock");
  expect({"--sigma", "0"}, "--sigma: found 0");
  expect({"--sigma", "nan"}, "--sigma: found nan");
  expect({"--x0-low", "inf"}, "--x0-low: found inf");
  expect({"--x0-low", "3", "--x0-high", "2"}, "--x0-high: found 2, wanted 3 to 1e+12");
  expect({"--lambda", "1"}, "--lambda: found 1, wanted 2 to 1e+06");
  expect({"--lambda", "100000", "--dim", "1000"}, "--lambda: found 100000, wanted 2 to 10000");
  expect({"--target", "nan"}, "--target: found nan");
  expect({"--restarts", "-1"}, "--restarts: found -1");
  expect({"--max-evaluations", "0"}, "--max-evaluations: found 0");
  expect({"--seeds", "0"}, "--seeds: found 0, wanted 1 to 10000");
  expect({"--seed", "18446744073709551615"}, "wanted a whole number of at most 18 digits");
  std::ofstream(in("file")) << "here";
  expect({"-o", in("file").string()}, "file: found Not a directory, wanted a folder");
  expect({"-o", in("file/below").string()}, "below: found Not a directory");
}

}  // namespace rex::cli::cma_test
