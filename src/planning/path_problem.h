#pragma once

#include <functional>
#include <string>

#include "planning/space.h"
#include "scene/model.h"

namespace rex {

/// Whether all configurations, one per column of Q, are valid, for example free of collision. It may stop
/// at the first invalid one, and is called with any number of columns.
using AllValid = std::function<bool(const MatrixArg& Q)>;

/// Makes one from a function of a single configuration.
[[nodiscard]] AllValid eachColumn(std::function<bool(const VectorArg& q)> isValid);

/// A configuration is valid if its clearance is positive. Throws Error, naming it, if that is not a number.
[[nodiscard]] AllValid whereClear(std::function<double(const VectorArg& q)> clearance);

/// A planning problem: find a path through valid configurations.
struct PathProblem {
  Space space;
  AllValid allValid{};
  Eigen::VectorXd start{}, goal{};
  double resolution =
      0.01;  ///< edges are checked at points no farther apart than this, in the metric of the space
  /// Explains why a configuration is not valid, and by how much; only for messages. May be empty.
  std::function<std::string(const VectorArg& q)> reason{};
  /// Asked before each sample: true ends the search as if its budget were spent, with what was explored so
  /// far. Empty: never. What a search with a limit of time finds depends on the machine only if the limit
  /// ends it.
  std::function<bool()> isTimeUp{};
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
  std::string message{};  ///< for people: whether a path was found, after how much work
};

/// The length of a path, one configuration per column.
[[nodiscard]] double pathLength(const Space& space, const MatrixArg& path);

/// A lower bound on the length of paths from a to b through `via`.
[[nodiscard]] double lengthThrough(const Space& space, const VectorArg& a, const VectorArg& via,
                                   const VectorArg& b);

/// Checks straight edges between configurations at points no more than `resolution` apart. Points are
/// checked in blocks of 8 (the block size of the kernels), each spread over the whole edge, so that
/// obstacles are found early wherever they are (the idea of Thomason, Kingston and Kavraki, Motions in
/// microseconds, 2024).
class EdgeChecker {
 public:
  /// Throws Error for a resolution that is not positive and finite.
  EdgeChecker(const Space& space, AllValid allValid, double resolution);

  [[nodiscard]] bool isValid(const VectorArg& q);
  /// Checks the edge from a valid configuration to another one, which is checked too. Throws Error for
  /// wrong sizes and if it takes more than 1e8 points, naming resolution and distance.
  [[nodiscard]] bool isValid(const VectorArg& from, const VectorArg& to);
  /// How many configurations the validity function has been asked about so far.
  long asked() const { return asked_; }

 private:
  Space space_;
  AllValid allValid_;
  double resolution_;
  Eigen::MatrixXd block_;
  long asked_ = 0;
};

}  // namespace rex
