#include <algorithm>

#include "planning/search_tree_internal.h"

namespace rex::internal {

SearchTree::SearchTree(const Space& space, const VectorArg& root) : points_(space) { add(root, -1); }

int SearchTree::add(const VectorArg& q, int parent) {
  parents_.push_back(parent);
  return points_.add(q);
}

Eigen::MatrixXd SearchTree::wayTo(int node) const {
  std::vector<int> way;
  for (int at = node; at >= 0; at = parent(at)) way.push_back(at);
  std::reverse(way.begin(), way.end());
  Eigen::MatrixXd path(points_.point(0).size(), static_cast<Eigen::Index>(way.size()));
  for (Eigen::Index k = 0; k < path.cols(); ++k)
    path.col(k) = points_.point(way[static_cast<std::size_t>(k)]);
  return path;
}

PathTree SearchTree::drawn() const {
  PathTree tree{Eigen::MatrixXd(points_.point(0).size(), count()), parents_};
  for (int i = 0; i < count(); ++i) tree.nodes.col(i) = points_.point(i);
  return tree;
}

bool stepTowards(const Space& space, const VectorArg& near, const VectorArg& target, double stepSize,
                 Eigen::Ref<Eigen::VectorXd> out) {
  const double length = space.wayLength(near, target);
  if (length <= stepSize) {
    out = target;
    return true;
  }
  space.interpolate(near, target, stepSize / length, out);
  return false;
}

}  // namespace rex::internal
