// The package cmaes learns the same from the same samples, and needs as many of its own.
#include <algorithm>
#include <sstream>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include "base/process.h"
#include "optim/cma_search.h"
#include "optim/test_functions.h"
#include "support/paths.h"

namespace rex::cma_peer_test {

constexpr const char* kPython = "/usr/bin/python3";  // where Debian's packages are known

class CmaPeer : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!runProcess({kPython, "-c", "import cmaes"}).ok()) GTEST_SKIP() << "python3-cmaes is not installed";
  }

  static std::vector<double> ask(const std::string& request) {
    const ProcessResult result =
        runProcess({kPython, sourcePath("tests/optim/cma_peer.py")}, {.input = request, .timeout = 280});
    EXPECT_TRUE(result.ok()) << result.error;
    std::istringstream text(result.output);
    std::vector<double> numbers;
    for (double number; text >> number;) numbers.push_back(number);
    return numbers;
  }
};

TEST_F(CmaPeer, LearnsTheSameFromTheSameSamples) {
  constexpr int n = 6, kGenerations = 60;
  const TestFunction& function = testFunction("rosenbrock");
  for (const int lambda : {9, 40}) {
    Rng rng(1);
    CmaEs es(rng.normalVector(n), Eigen::VectorXd::Constant(n, 0.7),
             {.lambda = lambda, .decompositionGap = 1});
    std::string request = fmt::format("follow {} {} 0.7\n{}\n", n, lambda, fmt::join(es.mean(), " "));
    Eigen::MatrixXd X(n, lambda);
    Eigen::VectorXd values(lambda);
    std::vector<double> ours;
    for (int i = 0; i < kGenerations; ++i) {
      es.sample(X, rng);
      batched(function.value)(X, values);
      es.update(X, values);
      for (int k = 0; k < lambda; ++k) request += fmt::format("{} {}\n", fmt::join(X.col(k), " "), values[k]);
      ours.insert(ours.end(), es.mean().begin(), es.mean().end());
      ours.push_back(es.sigma());
      ours.insert(ours.end(), es.covariance().reshaped().begin(), es.covariance().reshaped().end());
    }
    const std::vector<double> theirs = ask(request);
    ASSERT_EQ(ours.size(), theirs.size());
    for (std::size_t i = 0; i < ours.size(); ++i)
      ASSERT_NEAR(ours[i], theirs[i], 1e-7 * (1 + std::abs(theirs[i])));
  }
}

TEST_F(CmaPeer, NeedsAsManyEvaluations) {
  constexpr int kSeeds = 15;
  const auto medianOf = [](std::vector<double> counts) {
    std::ranges::sort(counts);
    return counts[counts.size() / 2];
  };
  for (const auto& [name, n] : {std::pair{"ellipsoid", 6}, {"rosenbrock", 5}, {"ackley", 8}}) {
    const TestFunction& function = testFunction(name);
    const std::vector<double> theirs =
        ask(fmt::format("race {} {} {} {} {} {} {}\n", name, n, function.low, function.high,
                        function.deviation, function.target, kSeeds));
    ASSERT_EQ(theirs.size(), kSeeds);
    std::vector<double> ours;
    for (int seed = 0; seed < kSeeds; ++seed) {
      Rng rng(static_cast<std::uint64_t>(seed));
      const SearchResult result = minimizeByCma(
          batched(function.value), rng.uniformVector(n, function.low, function.high),
          Eigen::VectorXd::Constant(n, function.deviation), rng, {}, {.target = function.target});
      ours.push_back(result.status == SearchStatus::kTargetReached ? static_cast<double>(result.evaluations)
                                                                   : 0);
    }
    const double ratio = medianOf(ours) / medianOf(theirs);
    EXPECT_LE(ratio, 1.15) << name;
    EXPECT_GE(ratio, 1 / 1.15) << name;  // or the two do not solve the same
  }
}

}  // namespace rex::cma_peer_test
