#include "planning/rrt.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <initializer_list>
#include <limits>
#include <numbers>
#include <utility>

#include <fmt/format.h>

#include "base/error.h"
#include "base/require.h"
#include "base/rng.h"
#include "planning/path_problem.h"
#include "planning/rrt_internal.h"

namespace rex::internal {

/// What planners that grow trees hold: the problem, its checks, its random targets, and what to report in the
/// end.
class TreeGrowth {
 public:
  /// Throws as growRrt.
  TreeGrowth(const PathProblem& problem, const RrtOptions& options, Rng& rng);

  const Space& space() const { return problem_.space; }
  EdgeChecker& edges() { return edges_; }
  bool isSpent() const {
    return result_.samples >= options_.maxSamples || (problem_.isTimeUp && problem_.isTimeUp());
  }

  /// A random target, or the goal with that probability. Where only ways from start to goal shorter than
  /// `length` matter, targets off all of them are drawn again, which counts as one sample.
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

namespace {

constexpr int kMostRedraws = 100;  // then any target will do: shorter paths may lie in too thin a region

void requireSound(const RrtOptions& options) {
  requirePositive("step size of a tree", options.stepSize);
  requireCount("number of samples", options.maxSamples, 1);
  if (!(options.goalBias >= 0 && options.goalBias <= 1))
    throw Error({.what = "goal bias of a tree",
                 .found = fmt::format("{:g}", options.goalBias),
                 .wanted = "a number from 0 to 1"});
}

}  // namespace

TreeGrowth::TreeGrowth(const PathProblem& problem, const RrtOptions& options, Rng& rng)
    : problem_(problem),
      options_(options),
      rng_(rng),
      edges_(problem.space, problem.allValid, problem.resolution),
      target_(problem.space.size()),
      to_(problem.space.size()) {
  requireSound(options);
  rex::requireSound(problem);
}

const Eigen::VectorXd& TreeGrowth::draw(double goalBias, double length) {
  ++result_.samples;
  if (goalBias > 0 && rng_.uniform() < goalBias) return target_ = problem_.goal;
  const auto isOff = [&] { return lengthThrough(space(), problem_.start, target_, problem_.goal) > length; };
  space().sample(rng_, target_);
  for (int i = 0; i < kMostRedraws && isOff(); ++i) space().sample(rng_, target_);
  return target_;
}

int TreeGrowth::extend(SearchTree& tree, const VectorArg& target) {
  const int near = tree.points().nearest(target);
  from_ = tree.points().point(near);
  stepTowards(space(), from_, target, options_.stepSize, to_);
  return edges_.isValid(from_, to_) ? tree.add(to_, near) : -1;
}

PathResult TreeGrowth::finish(Eigen::MatrixXd path, std::initializer_list<const SearchTree*> trees) {
  const bool isFound = path.cols() > 0;
  result_.status = isFound ? PathStatus::kFound : PathStatus::kBudgetSpent;
  result_.path = std::move(path);
  result_.length = pathLength(space(), result_.path);
  result_.asked = edges_.asked();
  int nodes = 0;
  for (const SearchTree* tree : trees) {
    result_.trees.push_back(tree->drawn());
    nodes += tree->count();
  }
  result_.message = fmt::format("{} after {} samples: {} nodes, {} configurations checked",
                                isFound ? "found a path" : "no path", result_.samples, nodes, result_.asked);
  return std::move(result_);
}

}  // namespace rex::internal

namespace rex {
namespace {

using internal::SearchTree;
using internal::stepTowards;
using internal::TreeGrowth;

// Whether one unobstructed step leads from a configuration to the goal.
bool reachesGoal(const PathProblem& problem, const VectorArg& q, double stepSize, EdgeChecker& edges) {
  return problem.space.distance(q, problem.goal) <= stepSize && edges.isValid(q, problem.goal);
}

Eigen::MatrixXd joined(const Eigen::MatrixXd& fromStart, const Eigen::MatrixXd& fromGoal) {
  Eigen::MatrixXd path(fromStart.rows(), fromStart.cols() + fromGoal.cols() - 1);
  path.leftCols(fromStart.cols()) = fromStart;
  path.rightCols(fromGoal.cols()) = fromGoal.rowwise().reverse();
  return path;
}

}  // namespace

PathResult growRrt(const PathProblem& problem, const RrtOptions& options, Rng& rng) {
  TreeGrowth growth(problem, options, rng);
  SearchTree tree(problem.space, problem.start);
  for (int node = 0;; node = growth.extend(tree, growth.draw(options.goalBias))) {
    if (node >= 0 && reachesGoal(problem, tree.points().point(node), options.stepSize, growth.edges()))
      return growth.finish(tree.wayTo(tree.add(problem.goal, node)), {&tree});
    if (growth.isSpent()) return growth.finish({}, {&tree});
  }
}

PathResult connectRrts(const PathProblem& problem, const RrtOptions& options, Rng& rng) {
  TreeGrowth growth(problem, options, rng);
  std::array<SearchTree, 2> trees{SearchTree(problem.space, problem.start),
                                  SearchTree(problem.space, problem.goal)};
  if (reachesGoal(problem, problem.start, options.stepSize, growth.edges()))
    return growth.finish(joined(trees[0].wayTo(trees[0].add(problem.goal, 0)), trees[1].wayTo(0)),
                         {&trees[0], &trees[1]});
  for (std::size_t turn = 0; !growth.isSpent(); turn = 1 - turn) {
    SearchTree &one = trees[turn], &other = trees[1 - turn];
    const int node = growth.extend(one, growth.draw(0));
    if (node < 0) continue;
    const Eigen::VectorXd target = one.points().point(node);
    int last = other.points().nearest(target);
    Eigen::VectorXd from = other.points().point(last), to(from.size());
    bool isReached = problem.space.distance(from, target) == 0;
    while (!isReached) {
      const bool wouldReach = stepTowards(problem.space, from, target, options.stepSize, to);
      if (!growth.edges().isValid(from, to)) break;
      last = other.add(to, last);
      from = to;
      isReached = wouldReach;
    }
    if (!isReached) continue;
    const int ofStart = turn == 0 ? node : last, ofGoal = turn == 0 ? last : node;
    return growth.finish(joined(trees[0].wayTo(ofStart), trees[1].wayTo(ofGoal)), {&trees[0], &trees[1]});
  }
  return growth.finish({}, {&trees[0], &trees[1]});
}

namespace {

using internal::SearchTree;
using internal::stepTowards;
using internal::TreeGrowth;

constexpr double kNoCost = std::numeric_limits<double>::infinity();

// The dimension of a space as a manifold, and its volume by its own metric.
struct Extent {
  int dimension = 0;
  double volume = 1;
};

Extent extentOf(const Space& space) {
  Extent extent;
  for (const SpacePart& part : space.parts()) {
    const bool isRotation = part.kind == SpacePart::Kind::kQuaternion;
    const int dimension = isRotation ? 3 : 1;
    // For unit quaternions, half of the sphere: opposite ones are the same rotation.
    const double size = isRotation                            ? std::numbers::pi * std::numbers::pi
                        : part.kind == SpacePart::Kind::kLine ? part.upper - part.lower
                                                              : 2 * std::numbers::pi;
    extent.dimension += dimension;
    extent.volume *= size * std::pow(part.weight, dimension);
  }
  return extent;
}

double volumeOfUnitBall(int dimension) {
  return std::pow(std::numbers::pi, dimension / 2.) / std::tgamma(dimension / 2. + 1);
}

// The volume of all points whose distances from two others, which are `apart`, sum up to at most `length`.
double volumeOfEllipsoid(int dimension, double apart, double length) {
  const double thin = std::sqrt(std::max(0., length * length - apart * apart)) / 2;
  return volumeOfUnitBall(dimension) * length / 2 * std::pow(thin, dimension - 1);
}

// The distance up to which neighbours are considered, so that the tree becomes optimal. Once only paths
// shorter than the best matter, they lie in an ellipsoid, and its volume and the nodes in it count. If angles
// close up, it may meet its own images: then the whole space counts.
class Reach {
 public:
  Reach(const PathProblem& problem, const RrtStarOptions& options)
      : problem_(problem), options_(options), extent_(extentOf(problem.space)) {
    const auto parts = problem.space.parts();
    isFlat_ = std::all_of(parts.begin(), parts.end(),
                          [](const SpacePart& part) { return part.kind == SpacePart::Kind::kLine; });
    apart_ = problem.space.distance(problem.start, problem.goal);
    add(problem.start);
  }

  void add(const VectorArg& node) {
    lengths_.push_back(lengthThrough(problem_.space, problem_.start, node, problem_.goal));
    if (lengths_.back() <= best_) ++inside_;
  }

  // `best` is the length of the shortest path known.
  double radius(double best) {
    if (isFlat_ && best < best_) {
      best_ = best;
      inside_ = std::count_if(lengths_.begin(), lengths_.end(), [=](double one) { return one <= best; });
    }
    const double power = 1. / extent_.dimension, nodes = std::max(2., static_cast<double>(inside_));
    const double volume = std::min(extent_.volume, volumeOfEllipsoid(extent_.dimension, apart_, best_));
    const double gamma =
        options_.gamma > 0 ? options_.gamma
                           : 2 * std::pow((1 + power) * volume / volumeOfUnitBall(extent_.dimension), power);
    return std::min(
        options_.growth.stepSize,
        gamma * std::pow(std::log(nodes) / nodes, options_.exponent > 0 ? options_.exponent : power));
  }

 private:
  const PathProblem& problem_;
  const RrtStarOptions& options_;
  Extent extent_;
  bool isFlat_;
  double apart_, best_ = kNoCost;
  std::vector<double> lengths_;  // of the nodes: no path through one is shorter
  std::ptrdiff_t inside_ = 0;    // nodes through which a path may be as short as the best
};

// A tree that knows the cost of reaching each node.
class CostTree {
 public:
  explicit CostTree(const PathProblem& problem) : space_(problem.space), tree_(problem.space, problem.start) {
    costs_.push_back(0);
    children_.emplace_back();
  }

  const SearchTree& tree() const { return tree_; }
  double cost(int node) const { return costs_[static_cast<std::size_t>(node)]; }
  int add(const VectorArg& q, int parent) {
    costs_.push_back(cost(parent) + space_.distance(tree_.points().point(parent), q));
    const int node = tree_.add(q, parent);
    children_.emplace_back();
    childrenOf(parent).push_back(node);
    return node;
  }

  // Attaches a node to another parent, which makes it and all its descendants cheaper to reach.
  void move(int node, int parent, double newCost) {
    std::erase(childrenOf(tree_.parent(node)), node);
    childrenOf(parent).push_back(node);
    tree_.setParent(node, parent);
    const double gain = cost(node) - newCost;
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

// The neighbour from which q is reached at the least cost, -1 if there is none. `open` is scratch space.
int bestParent(const CostTree& tree, const std::vector<Neighbor>& near, const VectorArg& q,
               EdgeChecker& edges, std::vector<Neighbor>& open) {
  open.clear();
  for (const auto& [distance, node] : near) open.push_back({tree.cost(node) + distance, node});
  std::make_heap(open.begin(), open.end(), std::greater<>());
  for (; !open.empty(); open.pop_back()) {
    const int node = open.front().point;
    if (edges.isValid(tree.tree().points().point(node), q)) return node;
    std::pop_heap(open.begin(), open.end(), std::greater<>());
  }
  return -1;
}

// The goal as a node, if a new node is the goal or one unobstructed step leads there; -1 otherwise. Only the
// new node can be its parent: older ones near the goal were tried when they were new.
int goalBehind(CostTree& tree, int node, const PathProblem& problem, double stepSize, EdgeChecker& edges) {
  const Eigen::VectorXd q = tree.tree().points().point(node);
  if (q == problem.goal) return node;
  const bool isNear = problem.space.distance(q, problem.goal) <= stepSize;
  return isNear && edges.isValid(q, problem.goal) ? tree.add(problem.goal, node) : -1;
}

}  // namespace

PathResult growRrtStar(const PathProblem& problem, const RrtStarOptions& options, Rng& rng) {
  TreeGrowth growth(problem, options.growth, rng);
  requireNotNegative("gamma of RRT*", options.gamma);
  requireNotNegative("exponent of RRT*", options.exponent);
  Reach reach(problem, options);
  CostTree tree(problem);
  const NearestNeighbors& points = tree.tree().points();
  const auto joinGoal = [&](int node) {
    const int goal = goalBehind(tree, node, problem, options.growth.stepSize, growth.edges());
    if (goal > node) reach.add(problem.goal);
    return goal;
  };
  int goal = joinGoal(0);
  Eigen::VectorXd q(problem.space.size());
  std::vector<Neighbor> near, open;
  while (!growth.isSpent()) {
    const double best = goal >= 0 && options.isInformed ? tree.cost(goal) : kNoCost;
    const Eigen::VectorXd& target = growth.draw(goal < 0 ? options.growth.goalBias : 0, best);
    const int nearest = points.nearest(target);
    stepTowards(problem.space, points.point(nearest), target, options.growth.stepSize, q);
    points.within(q, reach.radius(best), near);
    if (std::none_of(near.begin(), near.end(), [&](const Neighbor& one) { return one.point == nearest; }))
      near.push_back({problem.space.distance(points.point(nearest), q), nearest});
    const int parent = bestParent(tree, near, q, growth.edges(), open);
    if (parent < 0) continue;
    const int node = tree.add(q, parent);
    reach.add(q);
    if (goal < 0) goal = joinGoal(node);
    for (const auto& [distance, other] : near) {
      const double cost = tree.cost(node) + distance;
      if (cost < tree.cost(other) && growth.edges().isValid(q, points.point(other)))
        tree.move(other, node, cost);
    }
  }
  return growth.finish(goal < 0 ? Eigen::MatrixXd() : tree.tree().wayTo(goal), {&tree.tree()});
}

}  // namespace rex
