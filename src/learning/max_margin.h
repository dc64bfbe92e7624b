#pragma once

#include "base/vector_arg.h"

namespace rex {

/// The maximum margin between a teacher and all candidates.
struct MarginResult {
  /// The point in the candidates' hull nearest to the teacher, as convex weights: >= 0, sum 1.
  Eigen::VectorXd shares{};
  Eigen::VectorXd w{};  ///< unit vector from that point to the teacher; zero if the teacher is in the hull
  double margin = 0;    ///< min_i w^T (teacher - candidate_i): the distance to the hull
  int iterations = 0;
  bool converged = false;
};

/// The quadratic programme of slide 9:13: max xi with w^T teacher >= w^T candidate_i + xi for each i and
/// |w| <= 1. Its dual is the nearest point in the hull of the candidates (one per column), found with an
/// active set of corners (Wolfe 1976). Throws Error without candidates, for sizes that do not fit, and for
/// numbers that are not finite.
[[nodiscard]] MarginResult maxMargin(const VectorArg& teacher, const MatrixArg& candidates,
                                     int maxIterations = 1000);

}  // namespace rex
