#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "rewire_checks.h"

// Part 7: whole trees of RRT*.

/// The best parent of each node within `reach`, as far as it saves cost; otherwise the parent it has.
struct Savings {
  Tree better{};
  double share = 0;  ///< of the total cost of all nodes

  Savings(const PlaneWorld& world, const Tree& tree, double reach) : better(tree) {
    double gain = 0, sum = 0;
    for (std::size_t i = 0; i < tree.nodes.size(); ++i) {
      double best = tree.costs[i];
      sum += best;
      for (std::size_t k = 0; k < tree.nodes.size(); ++k) {
        const double way = (tree.nodes[i] - tree.nodes[k]).norm(), cost = tree.costs[k] + way;
        if (way > reach || cost >= best || !wayIsFree(world, tree.nodes[k], tree.nodes[i])) continue;
        best = cost;
        if (cost < tree.costs[i] - 1e-9) better.parents[i] = static_cast<int>(k);
      }
      gain += tree.costs[i] - best;
    }
    share = gain / sum;
  }
};

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

/// No node has more than one child.
inline bool isOneBranch(const Tree& tree) {
  std::vector<int> children(tree.nodes.size(), 0);
  for (std::size_t i = 1; i < tree.parents.size(); ++i) ++children[static_cast<std::size_t>(tree.parents[i])];
  return std::all_of(children.begin(), children.end(), [](int count) { return count <= 1; });
}

/// What holds for the tree of RRT*, but not for a short path alone. Over 900 seeds the reference solution has
/// at least 0.7 nodes per sample, with one near every position, and reaches the goal within 0.6 of the
/// samples. Better parents would save at most 0.002 of the costs, but at least 0.045 if nothing is rewired.
inline void growsWhileItImproves(rex::grading::Check& check, const StarSearch& search,
                                 const PlaneProblem& problem, const SearchSettings& settings) {
  const Tree& grown = search.tree;
  {
    const auto branch = check.ask(
        "Is the tree the branch of a path? Each of maxSamples targets makes it grow.", isOneBranch(grown));
    check.atLeast("number of nodes in the tree of growStar", static_cast<double>(grown.nodes.size()),
                  settings.maxSamples / 3);
    check.atLeast("share of the free positions with a node of growStar within a step",
                  shareReached(problem.world, grown, settings.stepSize, check.rng()), 0.95);
  }
  {
    const auto count = std::count(grown.nodes.begin(), grown.nodes.end(), problem.goal);
    const auto shown = check.show([&] {
      rex::grading::Evidence evidence = treesSeen(problem, {grown}, {});
      evidence.figures[0].series.push_back(rex::grading::wrongPoint(
          fmt::format("{} nodes in one place", count), problem.goal[0], problem.goal[1]));
      return evidence;
    });
    const auto again =
        check.ask("Do targets still aim at the goal after a step ended there? Then they are wasted on it.");
    check.near("number of nodes of growStar that are the goal", static_cast<double>(count), 1, 0);
  }
  const Savings savings(problem.world, grown, settings.stepSize);
  {
    const auto shown = check.show([&] { return betterSeen(problem, grown, savings.better); });
    const auto rewiring = check.ask("Are near nodes not rewired, or are too few of them near?");
    check.atMost("share of the cost of all nodes of growStar that better parents within a step would save",
                 savings.share, 0.01);
  }
  const auto reached =
      std::find_if(search.best.begin(), search.best.end(), [](double cost) { return cost < 1e9; });
  check.atMost("number of samples before growStar reaches the goal",
               static_cast<double>(reached - search.best.begin()), 0.9 * settings.maxSamples);
  check.atMost("last cost in `best` of growStar, against that when the goal was reached", search.best.back(),
               *reached - 1e-12, "m");
}

/// Costs and `best` of a sound tree.
inline void starCostsFit(rex::grading::Check& check, const StarSearch& search, const PlaneProblem& problem,
                         const SearchSettings& settings) {
  const Tree& grown = search.tree;
  check.near("number of costs in the tree of growStar", static_cast<double>(grown.costs.size()),
             static_cast<double>(grown.nodes.size()), 0);
  const std::vector<double> costs = costsOf(grown);
  std::size_t here = 0;
  const auto shown = check.show([&] { return treesSeen(problem, {grown}, {}, 0, here); });
  const std::string input = check.input();
  for (; here < costs.size(); ++here) {
    if (std::abs(grown.costs[here] - costs[here]) > 1e-9)
      check.input(fmt::format("{}, node {}", input, here));
    const auto old =
        check.ask("Do descendants of a rewired node keep their costs?", grown.costs[here] > costs[here]);
    check.near("cost of a node of growStar: the length of its path", grown.costs[here], costs[here], 1e-9,
               "m");
  }
  check.near("number of costs in `best` of growStar", static_cast<double>(search.best.size()),
             settings.maxSamples, 0);
  for (std::size_t i = 1; i < search.best.size(); ++i)
    if (!(search.best[i] <= search.best[i - 1]))
      holdsAt(check, "the costs in `best` of growStar never grow", false, fmt::format("sample {}", i));
  check.that("growStar reaches the goal",
             search.goal >= 0 && search.goal < static_cast<int>(grown.nodes.size()));
  const auto goal = static_cast<std::size_t>(search.goal);
  check.near("the node `goal` of growStar", grown.nodes[goal], problem.goal, 0, "m");
  check.near("last cost in `best` of growStar: the length of the path", search.best.back(), costs[goal], 1e-9,
             "m");
}

/// Checks what holds for every tree of RRT*, and returns the cost of its path.
inline double starIsSound(rex::grading::Check& check, Student& student, const PlaneProblem& problem,
                          const SearchSettings& settings, rex::Rng& given) {
  const EdgeTest isFree = freeIn(problem.world);
  EdgeRecord record(isFree, 2);
  const StarSearch search = student.growStar.orInfinite()(problem.start, problem.goal, settings, 1.5,
                                                          record.test(), check.split(given.next()));
  askedWell(check, "growStar", record);
  isTree(check, "growStar", search.tree, problem.start, false, settings.maxSamples + 1);
  const auto shown = check.show([&] { return treesSeen(problem, {search.tree}, {}); });
  edgesAreSound(check, "growStar", search.tree, settings.stepSize, record, isFree,
                [&](std::size_t here) { return treesSeen(problem, {search.tree}, {}, 0, here); });
  starCostsFit(check, search, problem, settings);
  growsWhileItImproves(check, search, problem, settings);
  return search.best.back();
}
