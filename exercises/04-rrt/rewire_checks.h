#pragma once

#include <algorithm>
#include <optional>
#include <vector>

#include "tree_evidence.h"

// Part 7: the best parent of a new node, and rewiring.

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

/// The parents of a new node at q among `near`, rightly and by usual mistakes; -1: none.
struct Candidates {
  int best = -1, nearest = -1, blocked = -1, cheapest = -1;

  Candidates(const PlaneWorld& world, const Tree& tree, const std::vector<int>& near,
             const Eigen::VectorXd& q) {
    const auto length = [&](int k) { return (tree.nodes[static_cast<std::size_t>(k)] - q).norm(); };
    const auto before = [&](int k) { return tree.costs[static_cast<std::size_t>(k)]; };
    const auto cost = [&](int k) { return before(k) + length(k); };
    const auto least = [](int& kept, int k, const auto& of) {
      if (kept < 0 || of(k) < of(kept)) kept = k;
    };
    int first = -1;
    for (const int k : near) {
      least(blocked, k, cost);
      if (!wayIsFree(world, tree.nodes[static_cast<std::size_t>(k)], q)) continue;
      if (first < 0) first = k;
      least(best, k, cost);
      least(nearest, k, length);
      least(cheapest, k, before);
    }
  }
};

inline void parentFits(rex::grading::Check& check, const Tree& tree, const std::vector<int>& near,
                       const Eigen::VectorXd& q, const Candidates& by, const ParentChoice& got) {
  {
    const bool isIndex = got.parent >= 0 && got.parent < static_cast<int>(near.size()) &&
                         near[static_cast<std::size_t>(got.parent)] == by.best;
    const auto index =
        check.ask("Is it the position in `near`? Wanted is the number of the node there.", isIndex);
    check.near("parent of bestParent", got.parent, by.best, 0,
               {{"Is it the nearest? Wanted is the least cost from the root.", by.nearest},
                {"Is the edge to q left out of the cost?", by.cheapest}});
  }
  const auto k = static_cast<std::size_t>(by.best);
  const double length = (q - tree.nodes[k]).norm();
  check.near("cost of bestParent", got.cost, tree.costs[k] + length, 1e-9,
             {{"Is it the cost of the parent, without the edge to q?", tree.costs[k]},
              {"Is it the length of the edge alone?", length}},
             "m");
}

inline void choosesParent(rex::grading::Check& check, Student& student, const PlaneWorld& world,
                          const Tree& tree, const Eigen::VectorXd& q, const std::vector<int>& near) {
  const Candidates by(world, tree, near, q);
  std::vector<Eigen::VectorXd> places;
  Eigen::VectorXd costs(static_cast<Eigen::Index>(near.size()));
  for (const int k : near) {
    costs[static_cast<Eigen::Index>(places.size())] = tree.costs[static_cast<std::size_t>(k)];
    places.push_back(tree.nodes[static_cast<std::size_t>(k)]);
  }
  check.input("a tree of 60 nodes in the unit square", {{"q", q},
                                                        {"near", numbersOf(near)},
                                                        {"their positions, in columns", nodesOf(places)},
                                                        {"their costs", costs}});
  EdgeRecord record(freeIn(world), 2);
  const std::optional<ParentChoice> got = student.bestParent(tree, near, q, record.test());
  const auto shown = check.show([&] {
    return edgeSeen("The parent of a new node", world, tree, {got ? got->parent : -1, q}, {by.best, q});
  });
  askedWell(check, "bestParent", record);
  if (by.best < 0) {
    const auto ignored = check.ask("Is the answer of edgeFree ignored?", !near.empty());
    return check.that("bestParent gives nothing, since no edge is free", !got.has_value());
  }
  check.that("bestParent gives a parent, since an edge is free", got.has_value());
  parentFits(check, tree, near, q, by, *got);
  check.that("bestParent calls edgeFree for the edge from the parent to q",
             record.wasFree(tree.nodes[static_cast<std::size_t>(by.best)], q));
}

/// A tree whose last node makes at least two of the nodes near it cheaper, one of which has children.
struct Rewiring {
  PlaneWorld world{};
  Tree tree{}, wanted{};
  std::vector<int> near{};
  int node = 79;

  explicit Rewiring(rex::Rng& rng) : world(twoWalls(rng).world) {
    for (int gaining = 0, carried = 0; gaining < 2 || carried == 0;) {
      tree = wildTree(world, node + 1, rng);
      near = nodesNear(tree, tree.nodes.back(), 0.35, rng);
      near.erase(std::find(near.begin(), near.end(), node));
      gaining = carried = 0;
      wanted = tree;
      for (const int other : near) {
        if (!gains(world, tree, other, node)) continue;
        wanted.parents[static_cast<std::size_t>(other)] = node;
        ++gaining;
        carried += static_cast<int>(std::count(tree.parents.begin(), tree.parents.end(), other));
      }
    }
  }
};

inline void rewiredNodeFits(rex::grading::Check& check, const Rewiring& in, const Tree& got,
                            const EdgeRecord& record, std::size_t k) {
  const auto node = static_cast<std::size_t>(in.node);
  const double through = in.tree.costs[node] + (in.tree.nodes[k] - in.tree.nodes[node]).norm();
  const bool moves = in.wanted.parents[k] != in.tree.parents[k];
  const bool isNear = std::find(in.near.begin(), in.near.end(), static_cast<int>(k)) != in.near.end();
  check.input(fmt::format("node {} of a tree of 80 nodes, {}", k, isNear ? "in `near`" : "not in `near`"),
              {{"its cost before", in.tree.costs[k]},
               {"its parent before", in.tree.parents[k]},
               {"node", in.node},
               {"its cost through node", through}});
  const bool isTaken = got.parents[k] == in.node && !moves;
  const auto kept = check.ask("Is the node left with its parent, although it costs less through `node`?",
                              moves && got.parents[k] == in.tree.parents[k]);
  const auto more = check.ask("Is the cost not compared? The node costs more through `node`.",
                              isTaken && through > in.tree.costs[k]);
  const auto blocked = check.ask("Is edgeFree not asked, or its answer ignored?",
                                 isTaken && !wayIsFree(in.world, in.tree.nodes[node], in.tree.nodes[k]));
  check.near("parent of a node after rewired", got.parents[k], in.wanted.parents[k], 0);
  if (moves)
    check.that("rewired calls edgeFree for each new edge", record.wasFree(got.nodes[k], got.nodes[node]));
}

/// Every near node that gains by it is a child of the node afterwards, no other node has a new parent, and
/// all costs are lengths of paths again. The order of `near` does not matter: a node that becomes cheaper
/// because its parent does would still be cheaper through the node, by the triangle inequality.
inline void rewiringFits(rex::grading::Check& check, Student& student) {
  const Rewiring in(check.rng());
  check.input("a tree of 80 nodes, its last node, and all nodes within 0.35 m of that");
  EdgeRecord record(freeIn(in.world), 2);
  const Tree got = student.rewired(in.tree, in.near, in.node, record.test());
  askedWell(check, "rewired", record);
  check.near("number of nodes after rewired", static_cast<double>(got.nodes.size()), in.node + 1, 0);
  check.near("nodes after rewired", nodesOf(got.nodes), nodesOf(in.tree.nodes), 0, "m");
  isTree(check, "rewired", got, in.tree.nodes[0], false, in.node + 1);
  check.near("number of costs after rewired", static_cast<double>(got.costs.size()), in.node + 1, 0);
  std::size_t here = 0;
  const auto shown = check.show([&] { return rewiredSeen(in.world, got, in.wanted, in.node, here); });
  for (; here < got.nodes.size(); ++here) rewiredNodeFits(check, in, got, record, here);
  const std::vector<double> costs = costsOf(got);
  for (here = 0; here < got.nodes.size(); ++here) {
    const bool moves = in.wanted.parents[here] != in.tree.parents[here];
    check.input(fmt::format("node {} of a tree of 80 nodes, {}", here,
                            moves ? "which has a new parent" : "which keeps its parent"),
                {{"its cost before", in.tree.costs[here]}});
    check.near("cost of a node after rewired: the length of its path", got.costs[here], costs[here], 1e-9,
               {{moves ? "Does the node keep its cost, although it has a new parent?"
                       : "Do descendants keep their costs? With their ancestor they become "
                         "cheaper, too.",
                 in.tree.costs[here]}},
               "m");
  }
}
