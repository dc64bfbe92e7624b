#pragma once

#include <functional>
#include <string>

#include "planning/space.h"
#include "planning/validity.h"

namespace rex {

/// A planning problem: find a path through valid configurations.
struct PathProblem {
  Space space;
  AllValid allValid{};
  Eigen::VectorXd start{}, goal{};
  double resolution =
      0.01;  ///< edges are checked at points no farther apart than this, in the metric of the space
  /// Explains why a configuration is not valid, and by how much; only for messages. May be empty.
  std::function<std::string(const VectorArg& q)> reason{};
};

/// Throws Error for a start or goal with a wrong size, out of bounds, or not valid, saying which and why.
void requireSound(const PathProblem& problem);

/// A tree of configurations, as grown by planners and shown in pictures.
struct PathTree {
  Eigen::MatrixXd nodes{};     ///< one per column
  std::vector<int> parents{};  ///< of each node; -1: a root
};

enum class PathStatus { kFound, kBudgetSpent };

/// What a planner found.
struct PathResult {
  PathStatus status = PathStatus::kBudgetSpent;
  Eigen::MatrixXd path{};  ///< from start to goal, one configuration per column; empty if none was found
  double length = 0;       ///< of the path, in the metric of the space
  int samples = 0;         ///< random targets; RRT* may draw up to 101 configurations for an informed one
  long asked = 0;          ///< configurations that were checked for validity
  std::vector<PathTree> trees{};
  std::string message{};
};

/// The length of a path, one configuration per column.
[[nodiscard]] double pathLength(const Space& space, const MatrixArg& path);

/// A lower bound on the length of paths from a to b through `via`.
[[nodiscard]] double lengthThrough(const Space& space, const VectorArg& a, const VectorArg& via,
                                   const VectorArg& b);

}  // namespace rex
