// `rex search` as a user meets it, and the curves of what searches learn.
#include <algorithm>
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "base/rng.h"
#include "cli/methods/learning_curves.h"
#include "cli/rex_command.h"
#include "optim/simplex_search.h"
#include "optim/test_functions.h"

namespace rex::cli::search_test {

using nlohmann::json;
using ::testing::HasSubstr;

using SearchCommand = RexCommand;

TEST_F(SearchCommand, CountsAsTheLibraryDoes) {
  const ProcessResult result = rex({"search", "--function", "rosenbrock", "--method", "simplex,cma", "--dim",
                                    "3", "--seeds", "2", "--json"});
  ASSERT_EQ(result.exitCode, 0) << result.error;
  const json cells = json::parse(result.output)["cells"];
  ASSERT_EQ(cells.size(), 2u);
  EXPECT_EQ(cells[0]["method"], "cma");
  double spent = 0;
  for (const std::uint64_t seed : {0, 1}) {
    Rng rng(seed);
    const TestFunction& function = testFunction("rosenbrock");
    const SearchResult own =
        minimizeBySimplex(function.value, rng.uniformVector(3, function.low, function.high),
                          {.step = function.deviation, .maxEvaluations = 100'000, .target = function.target});
    EXPECT_EQ(own.status, SearchStatus::kTargetReached);
    spent += static_cast<double>(own.evaluations);
  }
  EXPECT_EQ(cells[1]["evaluations_per_success"].get<double>(), spent / 2);
}

TEST_F(SearchCommand, ComparesAllMethodsOnAllFunctions) {
  const ProcessResult result = rex({"search", "--seeds", "1", "--dim", "2", "--max-evaluations", "5000"});
  EXPECT_EQ(result.exitCode, 0);
  for (const TestFunction& function : testFunctions())
    EXPECT_THAT(result.output, HasSubstr("\n" + std::string(function.name) + " "));
  EXPECT_THAT(flat(result.output),
              HasSubstr("cma one-plus-one evolution distribution simplex annealing climbing"));
  EXPECT_THAT(flat(result.error),
              HasSubstr("bayes is left out: it is compared with --max-evaluations up to 300"));
  EXPECT_EQ(rex({"search", "--seeds", "1", "--dim", "2", "--max-evaluations", "5000"}).output, result.output);
}

// With few evaluations a model pays: less is left than after as many of the other methods.
TEST_F(SearchCommand, ShowsWhatIsBestAfterFewEvaluations) {
  const std::vector<std::string> few = {
      "search", "--function", "rosenbrock", "--dim", "2", "--max-evaluations", "40", "--seeds", "3"};
  const ProcessResult result = rex([&] {
    std::vector<std::string> words = few;
    words.insert(words.end(), {"--best", "--json"});
    return words;
  }());
  const json cells = json::parse(result.output)["cells"];
  ASSERT_EQ(cells.size(), 8u);
  EXPECT_EQ(cells[7]["method"], "bayes");
  for (int i = 0; i < 7; ++i) {
    if (cells[i]["median"].is_null()) continue;  // one generation of `distribution` has more samples
    EXPECT_LT(cells[7]["median"].get<double>(), cells[i]["median"].get<double>()) << cells[i]["method"];
  }
  EXPECT_TRUE(cells[0]["median"].is_number());
  std::vector<std::string> words = few;
  words.insert(words.end(), {"--best", "--method", "simplex"});
  EXPECT_THAT(flat(rex(words).output),
              HasSubstr("The best value found in 2 dimensions with 40 evaluations, the median of 3 runs."));
}

TEST_F(SearchCommand, SaysWhatIsWrong) {
  const auto expect = [&](std::vector<std::string> words, const char* text) {
    words.insert(words.begin(), "search");
    const ProcessResult result = rex(words);
    EXPECT_EQ(result.exitCode, 64) << result.error;
    EXPECT_THAT(flat(result.error), HasSubstr(text));
  };
  expect({"--method", "simplx"}, "--method: found 'simplx', wanted cma, one-plus-one,");
  expect({"--method", "simplx"}, "(did you mean 'simplex'?)");
  expect({"--function", "spere"}, "--function: found 'spere', wanted sphere, ellipsoid,");
  expect({"--dim", "1"}, "--dim: found 1, wanted 2 to 100");
  expect({"--seeds", "0"}, "--seeds: found 0, wanted 1 to 1000");
  expect({"--max-evaluations", "1"}, "--max-evaluations: found 1, wanted 10 to 1e+08");
  expect({"--method", "bayes"}, "--max-evaluations of bayes: found 100000, wanted 10 to 300");
  EXPECT_EQ(rex({"search", "--method", "climbing", "--function", "rosenbrock", "--dim", "20", "--seeds", "1",
                 "--max-evaluations", "100"})
                .exitCode,
            1);
}

TEST(LearningCurves, TakeTheMedianOfWhatWasReached) {
  const LearningCurve fast{{10, 20, 30}, {8, 1, 0.5}}, slow{{10, 100}, {9, 4}}, done{{10, 20}, {7, 0}};
  const Figure figure = figureOf({fast, slow, done}, 0.5, "three");
  ASSERT_EQ(figure.series.size(), 1u);
  ASSERT_EQ(figure.bands.size(), 1u);
  const Series& median = figure.series[0];
  const Band& band = figure.bands[0];
  EXPECT_EQ(median.x.front(), 10);
  EXPECT_EQ(median.x.back(), 100);
  EXPECT_EQ(median.y.front(), 8);
  const auto at = [&](double evaluations) {
    return static_cast<std::size_t>(std::ranges::upper_bound(median.x, evaluations) - median.x.begin() - 1);
  };
  EXPECT_EQ(median.y[at(25)], 1);
  EXPECT_EQ(band.low[at(25)], 1e-20);  // a logarithmic axis has no 0
  EXPECT_EQ(band.high[at(25)], 9);
  EXPECT_EQ(median.y.back(), 0.5);  // those that have ended keep what they found
  EXPECT_EQ(band.high.back(), 4);
  ASSERT_EQ(figure.horizontalLines.size(), 1u);
  EXPECT_EQ(figure.horizontalLines[0].at, 0.5);
}

TEST(LearningCurves, NeedNoBandForOne) {
  const Figure figure = figureOf({{{5, 6}, {2, 1}}}, -1, "one");
  EXPECT_TRUE(figure.bands.empty());
  EXPECT_TRUE(figure.horizontalLines.empty());
  EXPECT_EQ(figure.series[0].y.back(), 1);
}

}  // namespace rex::cli::search_test
