#include "bench/pagmo_peer.h"

#include <utility>

#include <pagmo/algorithms/cmaes.hpp>
#include <pagmo/population.hpp>
#include <pagmo/problem.hpp>
#include <pagmo/types.hpp>

namespace rex::bench {
namespace {

// As pagmo wants it.
struct Problem {
  pagmo::vector_double fitness(const pagmo::vector_double& x) const {
    return {function.value(Eigen::Map<const Eigen::VectorXd>(x.data(), n))};
  }
  std::pair<pagmo::vector_double, pagmo::vector_double> get_bounds() const {
    const auto size = static_cast<std::size_t>(n);
    return {pagmo::vector_double(size, function.low), pagmo::vector_double(size, function.high)};
  }

  TestFunction function = testFunctions().front();
  int n = 1;
};

}  // namespace

double minimizeByPagmo(const TestFunction& function, int n, int lambda, int generations) {
  const auto usual = -1.;
  const pagmo::cmaes search(static_cast<unsigned>(generations), usual, usual, usual, usual, 0.5, 0, 0, false,
                            false, 1);
  const pagmo::population start(pagmo::problem(Problem{function, n}), static_cast<unsigned>(lambda), 1u);
  return search.evolve(start).champion_f()[0];
}

}  // namespace rex::bench
