#include <algorithm>
#include <stdexcept>
#include <string>

#include "base/rng.h"
#include "bench/row.h"
#include "optim/cma_search.h"
#include "optim/test_functions.h"
#ifdef REX_WITH_PAGMO
#include "bench/pagmo_peer.h"
#endif

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

// Against the table of slide 9:32; the target leaves room for luck.
Row row(const char* name, int n, int lambda, double published) {
  return {.name = "cma-" + std::string(name) + "-" + std::to_string(n),
          .ours = [=] { return evaluationsPerSuccess(testFunction(name), n, lambda); },
          .peerName = "published",
          .peer = [=] { return published; },
          .target = 1.15,
          .unit = "k",
          .repetitions = 1};
}

// A generation: samples, their values, and all that is learnt from them.
Row generationRow() {
  constexpr int n = 20, kLambda = 20, kGenerations = 400;
  const auto perGeneration = [](const Measurement& all) { return [=] { return all() / kGenerations; }; };
  const TestFunction& sphere = testFunction("sphere");
  const auto ours = [&sphere] {
    Rng rng(1);
    CmaEs es(rng.uniformVector(n, sphere.low, sphere.high), Eigen::VectorXd::Constant(n, sphere.deviation),
             {.lambda = kLambda});
    Eigen::MatrixXd X;
    Eigen::VectorXd values;
    for (int i = 0; i <= kGenerations; ++i) {
      es.step(X, values, rng);
      batched(sphere.value)(X, values);
    }
    return es.result().value;
  };
  Row row{.name = "cma-generation-20",
          .ours = perGeneration(timed([=] { (void)ours(); })),
          .peerName = "pagmo",
          .target = 1.,
          .unit = "us"};
#ifdef REX_WITH_PAGMO
  const auto peer = [&sphere] { return minimizeByPagmo(sphere, n, kLambda, kGenerations); };
  if (std::max(ours(), peer()) > 1e-8) throw std::logic_error("one of the two does not find the minimum");
  row.peer = perGeneration(timed([=] { (void)peer(); }));
#endif
  return row;
}

}  // namespace

std::vector<Row> cmaRows() {
  return {
      row("ackley", 20, 12, 2667),    row("ackley", 30, 13, 3701),       row("griewank", 20, 15, 3111),
      row("griewank", 30, 13, 4455),  row("rastrigin", 20, 600, 68586),  row("rastrigin", 30, 1000, 147416),
      row("schwefel", 5, 600, 43810), row("schwefel", 10, 1500, 240899), generationRow()};
}

}  // namespace rex::bench
