#include <cmath>
#include <memory>
#include <stdexcept>
#include <string>

#include "base/rng.h"
#include "bench/row.h"
#include "estimation/pose_graph.h"
#include "estimation/street_graph.h"
#ifdef REX_WITH_CERES
#include "bench/ceres_peer.h"
#endif

namespace rex::bench {
namespace {

// The best map of a robot that drove so many streets, with the bound of how much better another could be: the
// peer has no such bound.
Row poseGraphRow(int poses, double target) {
  Rng rng(1);
  const auto graph = std::make_shared<const PlanarPoseGraph>(test::streets(poses, 0.05, rng));
  const auto ours = [graph] {
    PlanarPoseGraph moved = *graph;
    const double cost = optimize(moved).cost;
    if (!(certifiedGap(moved) < 0.1 * cost)) throw std::logic_error("the map is not proved to be good");
    return cost;
  };
  Row row{.name = "pose-graph-" + std::to_string(poses),
          .ours = timed([=] { (void)ours(); }),
          .peerName = "Ceres",
          .target = target,
          .unit = "ms",
          .repetitions = 5};
#ifdef REX_WITH_CERES
  const auto peer = [graph] {
    PlanarPoseGraph moved = *graph;
    return optimizeByCeres(moved);
  };
  if (std::abs(ours() - peer()) > 1e-6 * peer()) throw std::logic_error("not the map that Ceres finds");
  row.peer = timed([=] { (void)peer(); });
#endif
  return row;
}

}  // namespace

std::vector<Row> estimationRows() {  // As large as the well-known maps of Manhattan and of a city.
  return {poseGraphRow(3500, 0.5), poseGraphRow(10000, 0.45)};
}

}  // namespace rex::bench
