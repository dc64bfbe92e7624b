#pragma once

#include "planning/path_problem.h"
#include "planning/sphere_robot.h"

namespace rex {

struct SpherePlanOptions {
  double range = 1;        ///< how far a tree grows in one step, radians or metres
  int firstPoint = 1;      ///< of the Halton sequence: the seed
  long budget = 16000000;  ///< postures to check: about a second
};

/// Plans a motion by two trees (RRT-Connect, Kuffner and LaValle 2000) that grow towards points of a Halton
/// sequence, the smaller one first. All segments of the path are proven free. A search that takes long is
/// restarted with other points and another range. The same options give the same path on every machine. The
/// result contains no trees. Throws Error for vectors of a wrong size, a start or goal that is outside the
/// limits or not free, and options out of range.
[[nodiscard]] PathResult planSpheres(const SphereWorld& world, const VectorArg& start, const VectorArg& goal,
                                     const SpherePlanOptions& options = {});

/// Shortens a path whose segments are free: leaves out postures, then goes straight between points of the
/// path, as long as the new segments can be proven free. Start and goal stay. Throws Error for a path of a
/// wrong size, and with less than two postures.
[[nodiscard]] Eigen::MatrixXd shortenPath(const SphereWorld& world, const MatrixArg& path);

}  // namespace rex
