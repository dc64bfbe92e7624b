#pragma once

#include "base/vector_arg.h"

namespace rex {

/// How a teacher differs from all candidates at once.
struct MarginResult {
  /// The point of the hull of the candidates nearest to the teacher, as shares of them: >= 0, sum 1.
  Eigen::VectorXd shares{};
  Eigen::VectorXd w{};  ///< of length one, from that point to the teacher; zero if the teacher is in the hull
  double margin = 0;    ///< min_i w^T (teacher - candidate_i): the distance to the hull
  int iterations = 0;
  bool converged = false;
};

/// The quadratic programme of slide 9:13: max xi with w^T teacher >= w^T candidate_i + xi for each i and
/// |w| <= 1. Its dual is the nearest point of the hull of the candidates (one per column), which an active
/// set of corners finds (Wolfe 1976). Throws Error without candidates, for sizes, and for what is not finite.
[[nodiscard]] MarginResult maxMargin(const VectorArg& teacher, const MatrixArg& candidates,
                                     int maxIterations = 1000);

}  // namespace rex
