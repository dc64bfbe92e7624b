#include <limits>
#include <memory>
#include <string>

#include "base/rng.h"
#include "bench/cpu_seconds.h"
#include "bench/row.h"
#include "bench/rrt_star_peer.h"
#include "planning/rrt.h"
#include "planning/wall.h"

namespace rex::bench {
namespace {

// Ours spends a number of samples, not of seconds: the best path of the largest tree that keeps within the
// time.
double ourLength(const PathProblem& problem, double stepSize, std::uint64_t seed) {
  double best = std::numeric_limits<double>::infinity();
  for (int samples = 500;; samples += samples / 4) {
    Rng rng(seed);
    const double before = cpuSeconds();
    const PathResult result =
        growRrtStar(problem, {.growth = {.stepSize = stepSize, .maxSamples = samples}}, rng);
    if (cpuSeconds() - before > kStarSeconds) return best;
    if (result.status == PathStatus::kFound) best = result.length;
  }
}

Row starRow(int dimension, double gap, double stepSize) {
  const auto problem = std::make_shared<const PathProblem>(wallWithHole(dimension, gap));
  return {.name = "rrt-star-" + std::to_string(dimension) + "d",
          .ours = [=, seed = std::uint64_t{0}]() mutable { return ourLength(*problem, stepSize, ++seed); },
          .peerName = "OMPL",
          .peer = omplStarLength(problem, stepSize),
          .target = 1.,
          .unit = "",
          .repetitions = 11,
          .isMedian = true};
}

}  // namespace

// The length of the path from one side of a wall to the other through its hole, after a fifth of a second.
std::vector<Row> rrtStarRows() { return {starRow(2, .1, .2), starRow(3, .2, .5), starRow(6, .4, 1)}; }

}  // namespace rex::bench
