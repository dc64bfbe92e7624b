#pragma once

#include <memory>

#include "bench/row.h"
#include "planning/path_problem.h"

namespace rex::bench {

inline constexpr double kStarSeconds = 0.2;  ///< of processor time, for both sides

/// The length of the path that OMPL's RRT* has found after that time, another seed each time; infinite
/// without one. Empty without OMPL.
#ifdef REX_WITH_OMPL
[[nodiscard]] Measurement omplStarLength(const std::shared_ptr<const PathProblem>& problem, double stepSize);
#else
[[nodiscard]] inline Measurement omplStarLength(const std::shared_ptr<const PathProblem>&, double) {
  return {};
}
#endif

}  // namespace rex::bench
