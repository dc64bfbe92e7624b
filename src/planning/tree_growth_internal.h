#pragma once

#include <initializer_list>
#include <limits>

#include "planning/edge_checker.h"
#include "planning/rrt.h"
#include "planning/search_tree_internal.h"

namespace rex::internal {

/// What planners that grow trees hold: the problem, its checks, its random targets, and what to report in the
/// end.
class TreeGrowth {
 public:
  /// Throws as growRrt.
  TreeGrowth(const PathProblem& problem, const RrtOptions& options, Rng& rng);

  const Space& space() const { return problem_.space; }
  EdgeChecker& edges() { return edges_; }
  bool isSpent() const { return result_.samples >= options_.maxSamples; }

  /// A random target, or the goal with that probability. Where only ways from start to goal shorter than
  /// `length` matter, targets off all of them are drawn anew, which counts as one sample.
  const Eigen::VectorXd& draw(double goalBias, double length = std::numeric_limits<double>::infinity());
  /// The node that a tree gains by one step towards a target, -1 if something is in the way.
  int extend(SearchTree& tree, const VectorArg& target);
  [[nodiscard]] PathResult finish(Eigen::MatrixXd path, std::initializer_list<const SearchTree*> trees);

 private:
  const PathProblem& problem_;
  const RrtOptions& options_;
  Rng& rng_;
  EdgeChecker edges_;
  Eigen::VectorXd target_, from_, to_;
  PathResult result_{};
};

}  // namespace rex::internal
