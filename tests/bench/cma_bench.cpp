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

std::vector<Row> cmaRows() { return {generationRow()}; }

}  // namespace rex::bench
