#include <string>

#include "base/rng.h"
#include "bench/row.h"
#include "optim/cma_search.h"
#include "optim/test_functions.h"

namespace rex::bench {
namespace {

constexpr int kSeeds = 40;

// Evaluations of the successful runs divided by their share.
double evaluationsPerSuccess(const TestFunction& function, int n, int lambda) {
  double spent = 0, successes = 0;
  for (int seed = 0; seed < kSeeds; ++seed) {
    Rng rng(static_cast<std::uint64_t>(seed));
    const Eigen::VectorXd start = rng.uniformVector(n, function.low, function.high);
    const SearchResult result =
        minimizeByCma(batched(function.value), start, Eigen::VectorXd::Constant(n, function.deviation), rng,
                      {.lambda = lambda}, {.target = function.target});
    if (result.status != SearchStatus::kTargetReached) continue;
    spent += static_cast<double>(result.evaluations);
    ++successes;
  }
  return spent * kSeeds / (successes * successes);
}

// Against the table of slide 9:32, with some room for luck.
Row row(const char* name, int n, int lambda, double published) {
  return {.name = "cma-" + std::string(name) + "-" + std::to_string(n),
          .ours = [=] { return evaluationsPerSuccess(testFunction(name), n, lambda); },
          .peerName = "limit",
          .peer = [=] { return 1.15 * published; },
          .target = 1.,
          .unit = "evals",
          .repetitions = 1};
}

}  // namespace

std::vector<Row> cmaRows() {
  return {row("ackley", 20, 12, 2667),      row("ackley", 30, 13, 3701),
          row("griewank", 20, 15, 3111),    row("griewank", 30, 13, 4455),
          row("rastrigin", 20, 600, 68586), row("rastrigin", 30, 1000, 147416),
          row("schwefel", 5, 600, 43810),   row("schwefel", 10, 1400, 240899)};
}

}  // namespace rex::bench
