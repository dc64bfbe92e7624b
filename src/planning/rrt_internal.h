#pragma once

#include <vector>

#include "planning/nearest_neighbors.h"
#include "planning/path_problem.h"

namespace rex::internal {

/// A tree of configurations that grows from one root.
class SearchTree {
 public:
  SearchTree(const Space& space, const VectorArg& root);

  int add(const VectorArg& q, int parent);
  [[nodiscard]] const NearestNeighbors& points() const { return points_; }
  int count() const { return points_.count(); }
  int parent(int node) const { return parents_[static_cast<std::size_t>(node)]; }
  void setParent(int node, int parent) { parents_[static_cast<std::size_t>(node)] = parent; }

  /// The configurations from the root to a node, one per column.
  [[nodiscard]] Eigen::MatrixXd wayTo(int node) const;
  [[nodiscard]] PathTree drawn() const;

 private:
  NearestNeighbors points_;
  std::vector<int> parents_;
};

/// Moves from `near` towards `target` by at most `stepSize`, and no farther than the target, into `out`.
/// Whether that reaches it.
bool stepTowards(const Space& space, const VectorArg& near, const VectorArg& target, double stepSize,
                 Eigen::Ref<Eigen::VectorXd> out);

}  // namespace rex::internal
