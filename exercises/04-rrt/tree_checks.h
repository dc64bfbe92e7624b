#pragma once

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <vector>

#include "exercise.h"
#include "grading/check.h"
#include "plane_problems.h"

// What trees and paths must satisfy, and which edges were tested.

/// Answers a student's queries about edges, and records which edges were free.
class EdgeRecord {
 public:
  EdgeRecord(EdgeTest isFree, int size) : isFree_(std::move(isFree)), size_(size) {}

  EdgeTest test() {
    return [this](const Eigen::VectorXd& qa, const Eigen::VectorXd& qb) { return ask(qa, qb); };
  }
  bool wasFree(const Eigen::VectorXd& qa, const Eigen::VectorXd& qb) const {
    return free_.count(key(qa, qb)) > 0 || free_.count(key(qb, qa)) > 0;
  }
  bool isMalformed() const { return malformed_; }

 private:
  static constexpr long kMost = 1'000'000;  // more queries are never needed, and memory is finite

  static std::vector<double> key(const Eigen::VectorXd& qa, const Eigen::VectorXd& qb) {
    std::vector<double> both(qa.begin(), qa.end());
    both.insert(both.end(), qb.begin(), qb.end());
    return both;
  }
  bool ask(const Eigen::VectorXd& qa, const Eigen::VectorXd& qb) {
    const bool fits = qa.size() == size_ && qb.size() == size_ && qa.allFinite() && qb.allFinite();
    malformed_ = malformed_ || !fits;
    if (!fits || ++asked_ > kMost || !isFree_(qa, qb)) return false;
    free_.insert(key(qa, qb));
    return true;
  }

  EdgeTest isFree_;
  int size_;
  long asked_ = 0;
  bool malformed_ = false;
  std::set<std::vector<double>> free_;
};

inline void askedWell(rex::grading::Check& check, const EdgeRecord& record) {
  check.that("edgeFree is asked about configurations of the right size, with finite numbers",
             !record.isMalformed());
}

/// Root, sizes, and parents that lead to the root; `inOrder`: they come before their children.
inline void isTree(rex::grading::Check& check, const Tree& tree, const Eigen::VectorXd& root, bool inOrder) {
  check.that("the tree has nodes", !tree.nodes.empty());
  check.near("number of parents", static_cast<double>(tree.parents.size()),
             static_cast<double>(tree.nodes.size()), 0);
  for (const Eigen::VectorXd& q : tree.nodes) check.shape("node", q, root.size(), 1);
  check.near("the root", tree.nodes[0], root, 0);
  const int count = static_cast<int>(tree.nodes.size());
  check.near("parent of the root", tree.parents[0], -1, 0);
  for (int i = 1; i < count; ++i) {
    const int parent = tree.parents[static_cast<std::size_t>(i)];
    check.that("every other node has a parent in the tree", parent >= 0 && parent < count);
    if (inOrder) check.that("a parent comes before its children", parent < i);
  }
  for (int i = 0; i < count && !inOrder; ++i) {
    int steps = 0;
    for (int at = i; at > 0 && steps <= count; ++steps) at = tree.parents[static_cast<std::size_t>(at)];
    check.that("parents lead to the root", steps <= count);
  }
}

/// No edge is longer than a step; each was tested, and is free according to the grader itself.
inline void edgesAreSound(rex::grading::Check& check, const Tree& tree, double stepSize,
                          const EdgeRecord& record, const EdgeTest& isFree) {
  for (std::size_t i = 1; i < tree.nodes.size(); ++i) {
    const Eigen::VectorXd &qa = tree.nodes[static_cast<std::size_t>(tree.parents[i])], &qb = tree.nodes[i];
    check.atMost("length of an edge of the tree", (qb - qa).norm(), stepSize + 1e-9);
    check.that("edgeFree was called for every edge of the tree and returned true", record.wasFree(qa, qb));
    check.that("every edge of the tree is free", isFree(qa, qb));
  }
}

/// From start to goal, in steps, over free edges.
inline void pathIsSound(rex::grading::Check& check, const Path& path, const Eigen::VectorXd& start,
                        const Eigen::VectorXd& goal, double stepSize, const EdgeTest& isFree) {
  check.that("a path is found", path.size() >= 2);
  for (const Eigen::VectorXd& q : path) check.shape("configuration of the path", q, start.size(), 1);
  check.near("first configuration of the path", path.front(), start, 0);
  check.near("last configuration of the path", path.back(), goal, 0);
  for (std::size_t i = 1; i < path.size(); ++i) {
    check.atMost("length of a piece of the path", (path[i] - path[i - 1]).norm(), stepSize + 1e-9);
    check.that("every piece of the path is free", isFree(path[i - 1], path[i]));
  }
}

/// Every configuration of a path is a node of a tree, and none appears twice in a row.
inline void pathIsOfTrees(rex::grading::Check& check, const Path& path, const std::vector<Tree>& trees) {
  for (const Eigen::VectorXd& q : path) {
    bool found = false;
    for (const Tree& tree : trees)
      found = found || std::find(tree.nodes.begin(), tree.nodes.end(), q) != tree.nodes.end();
    check.that("the path consists of nodes of the tree", found);
  }
  check.that("no configuration appears twice in a row",
             std::adjacent_find(path.begin(), path.end()) == path.end());
}

/// n nodes at random free positions. The parent of each is a random earlier node with a free edge to it, not
/// the best. The costs are right.
inline Tree wildTree(const PlaneWorld& world, int n, rex::Rng& rng) {
  Tree tree;
  while (static_cast<int>(tree.nodes.size()) < n) {
    const Eigen::VectorXd place = rng.uniformVector(2, 0, 1);
    if (!wayIsFree(world, place, place)) continue;
    const int parent = tree.nodes.empty() ? -1 : rng.index(static_cast<int>(tree.nodes.size()));
    const auto p = static_cast<std::size_t>(std::max(parent, 0));
    if (parent >= 0 && !wayIsFree(world, tree.nodes[p], place)) continue;
    tree.costs.push_back(parent < 0 ? 0 : tree.costs[p] + (place - tree.nodes[p]).norm());
    tree.nodes.push_back(place);
    tree.parents.push_back(parent);
  }
  return tree;
}

/// The costs that follow from the parents; the nodes may be in any order.
inline std::vector<double> costsOf(const Tree& tree) {
  std::vector<double> costs;
  for (std::size_t i = 0; i < tree.nodes.size(); ++i) {
    double cost = 0;
    for (std::size_t at = i; tree.parents[at] >= 0;) {
      const auto parent = static_cast<std::size_t>(tree.parents[at]);
      cost += (tree.nodes[at] - tree.nodes[parent]).norm();
      at = parent;
    }
    costs.push_back(cost);
  }
  return costs;
}

/// The number of the node nearest to `target`, by comparing all.
inline int nearestOf(const std::vector<Eigen::VectorXd>& nodes, const Eigen::VectorXd& target) {
  const auto nearer = [&](const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
    return (a - target).norm() < (b - target).norm();
  };
  return static_cast<int>(std::min_element(nodes.begin(), nodes.end(), nearer) - nodes.begin());
}

/// Random configurations in the plane.
inline Path randomPath(int count, rex::Rng& rng) {
  Path path;
  for (int i = 0; i < count; ++i) path.emplace_back(rng.uniformVector(2, 0, 1));
  return path;
}

/// A tree with a given path from its root to its node `last`, and with other branches.
struct TreeWithWay {
  Tree tree{};
  int last = -1;
};

inline TreeWithWay treeAround(const Path& way, rex::Rng& rng) {
  TreeWithWay made;
  for (const Eigen::VectorXd& place : way) {
    made.tree.nodes.push_back(place);
    made.tree.parents.push_back(made.last);
    made.last = static_cast<int>(made.tree.nodes.size()) - 1;
    for (const Eigen::VectorXd& leaf : randomPath(rng.index(4), rng)) {
      made.tree.nodes.push_back(leaf);
      made.tree.parents.push_back(rng.index(made.last + 1));
    }
  }
  return made;
}

inline void isPath(rex::grading::Check& check, const Path& path, const Path& wanted) {
  check.near("number of configurations", static_cast<double>(path.size()), static_cast<double>(wanted.size()),
             0);
  for (std::size_t i = 0; i < path.size(); ++i)
    check.near("configuration " + std::to_string(i) + " of the path", path[i], wanted[i], 0);
}

/// All nodes within `reach` of q, in random order.
inline std::vector<int> nodesNear(const Tree& tree, const Eigen::VectorXd& q, double reach, rex::Rng& rng) {
  std::vector<int> near;
  for (std::size_t i = 0; i < tree.nodes.size(); ++i)
    if ((tree.nodes[i] - q).norm() <= reach) near.push_back(static_cast<int>(i));
  for (int i = static_cast<int>(near.size()) - 1; i > 0; --i)
    std::swap(near[static_cast<std::size_t>(i)], near[static_cast<std::size_t>(rng.index(i + 1))]);
  return near;
}

/// Whether a node of the tree would be reached at less cost through another, over a free edge.
inline bool gains(const PlaneWorld& world, const Tree& tree, int one, int through) {
  const auto i = static_cast<std::size_t>(one), by = static_cast<std::size_t>(through);
  const Eigen::VectorXd &q = tree.nodes[i], &via = tree.nodes[by];
  return tree.costs[by] + (q - via).norm() < tree.costs[i] - 1e-9 && wayIsFree(world, via, q);
}

/// The share of the total cost of all nodes that would be saved if each took the best parent at most `reach`
/// away.
inline double leftToGain(const PlaneWorld& world, const Tree& tree, double reach) {
  double gain = 0, sum = 0;
  for (std::size_t i = 0; i < tree.nodes.size(); ++i) {
    double best = tree.costs[i];
    sum += best;
    for (std::size_t k = 0; k < tree.nodes.size(); ++k) {
      const double way = (tree.nodes[i] - tree.nodes[k]).norm(), cost = tree.costs[k] + way;
      if (way <= reach && cost < best && wayIsFree(world, tree.nodes[k], tree.nodes[i])) best = cost;
    }
    gain += tree.costs[i] - best;
  }
  return gain / sum;
}

/// The share of free positions with a node at most `reach` away.
inline double shareReached(const PlaneWorld& world, const Tree& tree, double reach, rex::Rng& rng) {
  int free = 0, reached = 0;
  while (free < 200) {
    const Eigen::VectorXd place = rng.uniformVector(2, 0, 1);
    if (!wayIsFree(world, place, place)) continue;
    ++free;
    const auto nearest = static_cast<std::size_t>(nearestOf(tree.nodes, place));
    if ((tree.nodes[nearest] - place).norm() <= reach) ++reached;
  }
  return 1. * reached / free;
}

/// What holds for the tree of RRT*, but not for a short path alone. Over 900 seeds the reference solution has
/// at least 0.7 nodes per sample, with one near every position, and reaches the goal within 0.6 of the
/// samples. Better parents would save at most 0.002 of the costs, but at least 0.045 if nothing is rewired.
inline void growsWhileItImproves(rex::grading::Check& check, const StarSearch& search,
                                 const PlaneWorld& world, const SearchSettings& settings) {
  check.atLeast("number of nodes per sample",
                static_cast<double>(search.tree.nodes.size()) / settings.maxSamples, 1. / 3);
  check.atLeast("share of the free positions with a node within a step",
                shareReached(world, search.tree, settings.stepSize, check.rng()), 0.95);
  check.atMost("share of the cost of all nodes that better parents within a step would save",
               leftToGain(world, search.tree, settings.stepSize), 0.01);
  const double early = search.best[static_cast<std::size_t>(0.9 * settings.maxSamples)];
  check.that("the goal is reached before the last tenth of the samples", early < 1e9);
  const auto first =
      std::find_if(search.best.begin(), search.best.end(), [](double cost) { return cost < 1e9; });
  check.that("the cost of the goal falls after it is first reached", *first > search.best.back());
}
