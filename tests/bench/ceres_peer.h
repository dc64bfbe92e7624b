#pragma once

#include "estimation/pose_graph.h"

namespace rex::bench {

/// Moves the poses of a planar graph to where the sum of squared errors is least, by Ceres on sparse normal
/// equations, with derivatives in closed form and hardly any damping, its fastest settings here; pose 0
/// stays. Returns that sum.
double optimizeByCeres(PlanarPoseGraph& graph);

}  // namespace rex::bench
