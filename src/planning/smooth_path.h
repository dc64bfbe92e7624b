#pragma once

#include "planning/path_problem.h"

namespace rex {

class Rng;

/// Replaces pieces between random points of a path by straight segments if these are valid. The result is
/// never longer, and valid at the resolution of the problem. Throws Error for a path of the wrong size or
/// without points.
[[nodiscard]] Eigen::MatrixXd shortcut(const PathProblem& problem, const MatrixArg& path, int rounds,
                                       Rng& rng);

/// Rounds the corners of a path by cutting them again and again (Chaikin 1974: towards a quadratic B-spline
/// with the path as control points), as far as that stays valid; start and goal stay. Throws like shortcut.
[[nodiscard]] Eigen::MatrixXd roundCorners(const PathProblem& problem, const MatrixArg& path, int rounds);

}  // namespace rex
