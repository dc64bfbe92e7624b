#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <fmt/format.h>

#include "base/error.h"
#include "planning/tree_growth_internal.h"

namespace rex {
namespace {

using internal::SearchTree;
using internal::stepTowards;
using internal::TreeGrowth;

// How many dimensions a space has as a manifold, and its volume by its own metric.
struct Extent {
  int dimension = 0;
  double volume = 1;
};

Extent extentOf(const Space& space) {
  using Kind = SpacePart::Kind;
  Extent extent;
  for (const SpacePart& part : space.parts()) {
    const bool isRotation = part.kind == Kind::kQuaternion;
    const int dimension = isRotation ? 3 : 1;
    // Of unit quaternions, half of the sphere: opposite ones are the same.
    const double size = isRotation                 ? std::numbers::pi * std::numbers::pi
                        : part.kind == Kind::kLine ? part.upper - part.lower
                                                   : 2 * std::numbers::pi;
    extent.dimension += dimension;
    extent.volume *= size * std::pow(part.weight, dimension);
  }
  return extent;
}

double volumeOfUnitBall(int dimension) {
  return std::pow(std::numbers::pi, dimension / 2.) / std::tgamma(dimension / 2. + 1);
}

// A tree that knows what it costs to come to each node.
class CostTree {
 public:
  explicit CostTree(const PathProblem& problem) : space_(problem.space), tree_(problem.space, problem.start) {
    costs_.push_back(0);
    children_.emplace_back();
  }

  const SearchTree& tree() const { return tree_; }
  double cost(int node) const { return costs_[static_cast<std::size_t>(node)]; }
  double costThrough(int node, const Eigen::VectorXd& q) const {
    return cost(node) + space_.distance(tree_.points().point(node), q);
  }

  int add(const Eigen::VectorXd& q, int parent) {
    const int node = tree_.add(q, parent);
    costs_.push_back(costThrough(parent, q));
    children_.emplace_back();
    childrenOf(parent).push_back(node);
    return node;
  }

  // Hangs a node on another parent; all that hangs on it becomes cheaper.
  void move(int node, int parent) {
    std::erase(childrenOf(tree_.parent(node)), node);
    childrenOf(parent).push_back(node);
    tree_.setParent(node, parent);
    const double gain = cost(node) - costThrough(parent, tree_.points().point(node));
    std::vector<int> open{node};
    while (!open.empty()) {
      const int at = open.back();
      open.pop_back();
      costs_[static_cast<std::size_t>(at)] -= gain;
      open.insert(open.end(), childrenOf(at).begin(), childrenOf(at).end());
    }
  }

 private:
  std::vector<int>& childrenOf(int node) { return children_[static_cast<std::size_t>(node)]; }

  const Space& space_;
  SearchTree tree_;
  std::vector<double> costs_;
  std::vector<std::vector<int>> children_;
};

// The neighbour from which q is reached at the least cost, -1 if from none.
int bestParent(const CostTree& tree, const std::vector<int>& near, const Eigen::VectorXd& q,
               EdgeChecker& edges) {
  std::vector<std::pair<double, int>> candidates;
  for (const int node : near) candidates.emplace_back(tree.costThrough(node, q), node);
  std::sort(candidates.begin(), candidates.end());
  for (const auto& [cost, node] : candidates)
    if (edges.isValid(tree.tree().points().point(node), q)) return node;
  return -1;
}

// The goal as a node, if a new node is it, or a step that nothing bars leads there; -1 otherwise. The new one
// is the only parent that it can have: older ones near it were tried when they were new.
int goalBehind(CostTree& tree, int node, const PathProblem& problem, double stepSize, EdgeChecker& edges) {
  const Eigen::VectorXd q = tree.tree().points().point(node);
  if (q == problem.goal) return node;
  const bool isNear = problem.space.distance(q, problem.goal) <= stepSize;
  return isNear && edges.isValid(q, problem.goal) ? tree.add(problem.goal, node) : -1;
}

}  // namespace

PathResult growRrtStar(const PathProblem& problem, const RrtStarOptions& options, Rng& rng) {
  TreeGrowth growth(problem, options.growth, rng);
  if (!(options.gamma >= 0)) {
    throw Error({.what = "gamma of RRT*",
                 .found = fmt::format("{:g}", options.gamma),
                 .wanted = "zero or a positive number"});
  }
  const Extent extent = extentOf(problem.space);
  const double power = 1. / extent.dimension;
  const double gamma =
      options.gamma > 0
          ? options.gamma
          : 2 * std::pow((1 + power) * extent.volume / volumeOfUnitBall(extent.dimension), power);
  CostTree tree(problem);
  int goal = -1;
  Eigen::VectorXd q(problem.space.size());
  while (!growth.isSpent()) {
    const Eigen::VectorXd& target = growth.draw(goal < 0 ? options.growth.goalBias : 0);
    const int nearest = tree.tree().points().nearest(target);
    stepTowards(problem.space, tree.tree().points().point(nearest), target, options.growth.stepSize, q);
    const double n = tree.tree().count();
    const double radius = std::min(options.growth.stepSize, gamma * std::pow(std::log(n) / n, power));
    std::vector<int> near = tree.tree().points().within(q, radius);
    if (std::find(near.begin(), near.end(), nearest) == near.end()) near.push_back(nearest);
    const int parent = bestParent(tree, near, q, growth.edges());
    if (parent < 0) continue;
    const int node = tree.add(q, parent);
    if (goal < 0) goal = goalBehind(tree, node, problem, options.growth.stepSize, growth.edges());
    for (const int other : near) {
      const Eigen::VectorXd at = tree.tree().points().point(other);
      if (tree.costThrough(node, at) < tree.cost(other) && growth.edges().isValid(q, at))
        tree.move(other, node);
    }
  }
  return growth.finish(goal < 0 ? Eigen::MatrixXd() : tree.tree().wayTo(goal), {&tree.tree()});
}

}  // namespace rex
