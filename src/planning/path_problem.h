#pragma once

#include <functional>
#include <string>

#include "planning/space.h"
#include "planning/validity.h"

namespace rex {

/// What to plan: a way through valid configurations.
struct PathProblem {
  Space space;
  AllValid allValid{};
  Eigen::VectorXd start{}, goal{};
  double resolution =
      0.01;  ///< ways are checked at points that are no farther apart, in the metric of the space
  /// Why a configuration is not valid, and by how much; only for messages. Empty: not known.
  std::function<std::string(const VectorArg& q)> reason{};
};

/// Throws Error for a start or goal with a wrong size, out of bounds, or not valid, saying which and why.
void requireSound(const PathProblem& problem);

/// Configurations that are joined to their parents, as planners grow them and pictures show them.
struct PathTree {
  Eigen::MatrixXd nodes{};     ///< one per column
  std::vector<int> parents{};  ///< of each node; -1: a root
};

enum class PathStatus { kFound, kBudgetSpent };

/// What a planner found.
struct PathResult {
  PathStatus status = PathStatus::kBudgetSpent;
  Eigen::MatrixXd path{};  ///< from start to goal, one configuration per column; empty where none was found
  double length = 0;       ///< of the path, in the metric of the space
  int samples = 0;         ///< random targets; RRT* may draw up to 101 configurations for an informed one
  long asked = 0;          ///< configurations that the validity function was asked for
  std::vector<PathTree> trees{};
  std::string message{};
};

/// The length of a path, one configuration per column.
[[nodiscard]] double pathLength(const Space& space, const MatrixArg& path);

/// No way from a to b through `via` is shorter.
[[nodiscard]] double lengthThrough(const Space& space, const VectorArg& a, const VectorArg& via,
                                   const VectorArg& b);

}  // namespace rex
