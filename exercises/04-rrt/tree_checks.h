#pragma once

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

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
  bool wasAsked(const Eigen::VectorXd& qa, const Eigen::VectorXd& qb) const {
    return answers_.count(key(qa, qb)) > 0 || answers_.count(key(qb, qa)) > 0;
  }
  bool wasFree(const Eigen::VectorXd& qa, const Eigen::VectorXd& qb) const {
    const auto isFree = [&](const std::vector<double>& both) {
      const auto found = answers_.find(both);
      return found != answers_.end() && found->second;
    };
    return isFree(key(qa, qb)) || isFree(key(qb, qa));
  }
  bool isMalformed() const { return malformed_; }
  double queries() const { return static_cast<double>(asked_); }

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
    if (!fits || ++asked_ > kMost) return false;
    return answers_[key(qa, qb)] = isFree_(qa, qb);
  }

  EdgeTest isFree_;
  int size_;
  long asked_ = 0;
  bool malformed_ = false;
  std::map<std::vector<double>, bool> answers_;
};

/// A requirement at a place, which the input names if it does not hold.
inline void holdsAt(rex::grading::Check& check, const std::string& property, bool holds,
                    const std::string& where) {
  if (!holds) check.input(check.input() + ", " + where);
  check.that(property, holds);
}

inline void askedWell(rex::grading::Check& check, const std::string& function, const EdgeRecord& record) {
  check.that(function + " calls edgeFree with configurations of the right size, with finite numbers",
             !record.isMalformed());
}

/// "from node 3 at (0.1, 0.2) to node 7 at (0.2, 0.2)"; joint angles are left out.
inline std::string nameOfEdge(const std::string& what, std::size_t i, const Eigen::VectorXd& qa,
                              std::size_t k, const Eigen::VectorXd& qb) {
  const auto at = [](const Eigen::VectorXd& q) {
    return q.size() == 2 ? fmt::format(" at ({:.6g}, {:.6g})", q[0], q[1]) : "";
  };
  return fmt::format("from {0} {1}{2} to {0} {3}{4}", what, i, at(qa), k, at(qb));
}

inline const char* unitOf(const Eigen::VectorXd& q) { return q.size() == 2 ? "m" : "rad"; }

/// At most so many nodes of two trees for each target: each has one new node, or several steps towards that.
inline constexpr int kNodesPerTarget = 10;
/// Far more than any path here needs.
inline constexpr int kMostConfigurations = 10000;

/// The nodes that are reached from the root, each after its parent. Every node has a parent in the tree,
/// except for the root, which is node 0.
inline std::vector<std::size_t> fromTheRoot(const std::vector<int>& parents) {
  std::vector<std::vector<std::size_t>> children(parents.size());
  for (std::size_t i = 1; i < parents.size(); ++i)
    children[static_cast<std::size_t>(parents[i])].push_back(i);
  std::vector<std::size_t> order{0};
  for (std::size_t next = 0; next < order.size(); ++next) {
    const std::vector<std::size_t>& here = children[order[next]];
    order.insert(order.end(), here.begin(), here.end());
  }
  return order;
}

/// Root, sizes, and parents that lead to the root; `inOrder`: they come before their children. There are at
/// most `most` nodes, so that no answer decides how long its check takes.
inline void isTree(rex::grading::Check& check, const std::string& function, const Tree& tree,
                   const Eigen::VectorXd& root, bool inOrder, int most) {
  const int count = static_cast<int>(tree.nodes.size());
  check.atLeast("number of nodes in the tree of " + function, count, 1);
  check.atMost("number of nodes in the tree of " + function, count, most);
  check.near("number of parents in the tree of " + function, static_cast<double>(tree.parents.size()), count,
             0);
  for (const Eigen::VectorXd& q : tree.nodes)
    check.shape("a node in the tree of " + function, q, root.size(), 1);
  check.near("root of the tree of " + function, tree.nodes[0], root, 0);
  check.near("parent of the root of " + function, tree.parents[0], -1, 0);
  for (int i = 1; i < count; ++i) {
    const int parent = tree.parents[static_cast<std::size_t>(i)];
    const std::string where =
        parent >= 0 && parent < count ? "" : fmt::format("node {} has parent {}", i, parent);
    holdsAt(check, "every node in the tree of " + function + " but the root has a parent there",
            where.empty(), where);
    if (inOrder && parent >= i)
      holdsAt(check, "parents in the tree of " + function + " come before their children", false,
              fmt::format("node {} has parent {}", i, parent));
  }
  if (!inOrder)
    check.that("parents in the tree of " + function + " lead to the root",
               fromTheRoot(tree.parents).size() == tree.nodes.size());
}

/// While the returned objects are alive, failures ask how an edge was tested.
[[nodiscard]] inline auto askAboutEdge(rex::grading::Check& check, const EdgeRecord& record,
                                       const Eigen::VectorXd& qa, const Eigen::VectorXd& qb) {
  const char* question = record.wasFree(qa, qb)    ? ""
                         : record.wasAsked(qa, qb) ? "Is the answer of edgeFree ignored?"
                         : record.wasAsked(qb, qb)
                             ? "Is only the new node tested? What lies between two free nodes may be blocked."
                             : "Was edgeFree never asked about it?";
  return check.ask(question, *question != '\0');
}

/// No edge is longer than a step; each is free according to the grader itself, and was tested. `seen` shows
/// the edge to a node.
template <class Seen>
void edgesAreSound(rex::grading::Check& check, const std::string& function, const Tree& tree, double stepSize,
                   const EdgeRecord& record, const EdgeTest& isFree, const Seen& seen) {
  std::size_t here = 1;
  const auto shown = check.show([&] { return seen(here); });
  for (; here < tree.nodes.size(); ++here) {
    const auto parent = static_cast<std::size_t>(tree.parents[here]);
    const Eigen::VectorXd &qa = tree.nodes[parent], &qb = tree.nodes[here];
    const double length = (qb - qa).norm();
    const bool free = isFree(qa, qb), asked = record.wasFree(qa, qb);
    const std::string where =
        free && asked && length <= stepSize ? "" : nameOfEdge("node", parent, qa, here, qb);
    const std::string input = check.input();
    if (length > stepSize + 1e-9) check.input(input + ", " + where);
    check.atMost("length of an edge in the tree of " + function, length, stepSize + 1e-9, unitOf(qa));
    if (free && asked) continue;
    const auto how = askAboutEdge(check, record, qa, qb);
    holdsAt(check, "every edge in the tree of " + function + " is free", free, where);
    holdsAt(check, "edgeFree was called for every edge in the tree of " + function + " and returned true",
            asked, where);
  }
}

inline void endsFit(rex::grading::Check& check, const std::string& function, const Path& path,
                    const Eigen::VectorXd& start, const Eigen::VectorXd& goal) {
  const bool begins = path.front() == start, ends = path.back() == goal;
  const auto reversed = check.ask("Does the path lead from the goal to the start? Wanted is the opposite.",
                                  path.front() == goal && path.back() == start);
  const auto noStart = check.ask("Is the start missing?", ends && !begins && path.size() > 2);
  const auto noGoal = check.ask("Is the goal missing?", begins && !ends && path.size() > 2);
  check.near("first configuration in the path of " + function, path.front(), start, 0, unitOf(start));
  check.near("last configuration in the path of " + function, path.back(), goal, 0, unitOf(start));
}

/// From start to goal, in steps, over free edges.
inline void pathIsSound(rex::grading::Check& check, const std::string& function, const Path& path,
                        const Eigen::VectorXd& start, const Eigen::VectorXd& goal, double stepSize,
                        const EdgeRecord& record, const EdgeTest& isFree) {
  check.that(function + " finds a path", path.size() >= 2);
  check.atMost("number of configurations in the path of " + function, static_cast<double>(path.size()),
               kMostConfigurations);
  for (const Eigen::VectorXd& q : path)
    check.shape("a configuration in the path of " + function, q, start.size(), 1);
  endsFit(check, function, path, start, goal);
  rex::grading::Signal lengths{.axis = "piece"};
  for (std::size_t i = 1; i < path.size(); ++i)
    lengths.add(static_cast<double>(i), (path[i] - path[i - 1]).norm());
  check.atMostAlong("lengths of the pieces in the path of " + function, lengths, stepSize + 1e-9,
                    unitOf(start));
  for (std::size_t i = 1; i < path.size(); ++i) {
    if (isFree(path[i - 1], path[i])) continue;
    const auto how = askAboutEdge(check, record, path[i - 1], path[i]);
    holdsAt(check, "every piece in the path of " + function + " is free", false,
            nameOfEdge("configuration", i - 1, path[i - 1], i, path[i]));
  }
}

/// Every configuration of a path is a node of a tree, and none appears twice in a row.
inline void pathIsOfTrees(rex::grading::Check& check, const std::string& function, const Path& path,
                          const std::vector<Tree>& trees) {
  const auto numbersAt = [](const Eigen::VectorXd& q) { return std::vector<double>(q.begin(), q.end()); };
  std::set<std::vector<double>> nodes;
  for (const Tree& tree : trees)
    for (const Eigen::VectorXd& q : tree.nodes) nodes.insert(numbersAt(q));
  for (std::size_t i = 0; i < path.size(); ++i)
    holdsAt(check, "the path of " + function + " consists of nodes of its tree",
            nodes.contains(numbersAt(path[i])), fmt::format("configuration {} of the path", i));
  const auto twice = std::adjacent_find(path.begin(), path.end());
  const auto meeting =
      check.ask("Is the node where the trees meet there twice? It belongs to both.", trees.size() == 2);
  holdsAt(check, "no configuration is twice in a row in the path of " + function, twice == path.end(),
          fmt::format("configurations {0} and {0} + 1", twice - path.begin()));
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

/// The costs that follow from the parents of a tree; the nodes may be in any order.
inline std::vector<double> costsOf(const Tree& tree) {
  std::vector<double> costs(tree.nodes.size(), 0);
  for (const std::size_t i : fromTheRoot(tree.parents)) {
    if (i == 0) continue;
    const auto parent = static_cast<std::size_t>(tree.parents[i]);
    costs[i] = costs[parent] + (tree.nodes[i] - tree.nodes[parent]).norm();
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

/// The wanted configurations, one after the other.
inline void isPath(rex::grading::Check& check, const std::string& function, const Path& path,
                   const Path& wanted) {
  const Path reversed(path.rbegin(), path.rend());
  const auto order = check.ask("Is the path in the reverse order?", reversed == wanted && path != wanted);
  const auto isPart = [&](auto begin, auto end) { return path == Path(begin, end); };
  const auto noFirst =
      check.ask("Is the first configuration missing?", isPart(wanted.begin() + 1, wanted.end()));
  const auto noLast =
      check.ask("Is the last configuration missing?", isPart(wanted.begin(), wanted.end() - 1));
  const auto twice = check.ask("Is a configuration there twice in a row?",
                               std::adjacent_find(path.begin(), path.end()) != path.end());
  check.near("number of configurations in the path of " + function, static_cast<double>(path.size()),
             static_cast<double>(wanted.size()), 0);
  for (std::size_t i = 0; i < path.size(); ++i)
    check.near(fmt::format("configuration {} in the path of {}", i, function), path[i], wanted[i], 0, "m");
}

/// The nodes in the columns.
inline Eigen::MatrixXd nodesOf(const std::vector<Eigen::VectorXd>& nodes) {
  Eigen::MatrixXd columns(nodes.empty() ? 0 : nodes[0].size(), static_cast<Eigen::Index>(nodes.size()));
  for (std::size_t i = 0; i < nodes.size(); ++i) columns.col(static_cast<Eigen::Index>(i)) = nodes[i];
  return columns;
}

inline Eigen::VectorXd numbersOf(const std::vector<int>& numbers) {
  Eigen::VectorXd column(static_cast<Eigen::Index>(numbers.size()));
  for (std::size_t i = 0; i < numbers.size(); ++i) column[static_cast<Eigen::Index>(i)] = numbers[i];
  return column;
}
