#pragma once

#include "search_checks.h"

// Part 4: searches from both sides in the plane.

inline void twoTreesAreSound(rex::grading::Check& check, const TwoTreeSearch& search,
                             const PlaneProblem& problem, const SearchSettings& settings,
                             const EdgeRecord& record, const EdgeTest& isFree) {
  const double stepSize = settings.stepSize;
  const int most = kNodesPerTarget * settings.maxSamples;
  const std::vector<Tree> trees{search.fromStart, search.fromGoal};
  askedWell(check, "growBoth", record);
  isTree(check, "growBoth, from the start", search.fromStart, problem.start, true, most);
  isTree(check, "growBoth, from the goal", search.fromGoal, problem.goal, true, most);
  for (const std::size_t which : {0, 1})
    edgesAreSound(check, which == 0 ? "growBoth, from the start" : "growBoth, from the goal", trees[which],
                  stepSize, record, isFree,
                  [&](std::size_t here) { return treesSeen(problem, trees, search.path, which, here); });
  const auto shown = check.show([&] { return treesSeen(problem, trees, search.path); });
  pathIsSound(check, "growBoth", search.path, problem.start, problem.goal, stepSize, record, isFree);
  pathIsOfTrees(check, "growBoth", search.path, trees);
}

/// Whether the way from one point of the plane to the next leads straight towards q.
inline bool leadsTowards(const Eigen::Vector2d& from, const Eigen::Vector2d& to, const Eigen::Vector2d& q) {
  const Eigen::Vector2d along = (to - from).normalized(), way = q - from;
  return std::abs(along.x() * way.y() - along.y() * way.x()) < 1e-9 && along.dot(way) > -1e-9;
}

/// The number of edges of a tree in the plane that do not lead towards a node of the other tree.
inline int randomSteps(const Tree& tree, const Tree& other) {
  int count = 0;
  for (std::size_t i = 1; i < tree.nodes.size(); ++i) {
    const Eigen::Vector2d from = tree.nodes[static_cast<std::size_t>(tree.parents[i])];
    const auto isAhead = [&](const Eigen::Vector2d& q) { return leadsTowards(from, tree.nodes[i], q); };
    count += std::any_of(other.nodes.begin(), other.nodes.end(), isAhead) ? 0 : 1;
  }
  return count;
}

/// Whether the first step of a tree leads towards the first new node of the other, unless it could not.
inline bool answers(const Tree& tree, const Tree& other, double stepSize, const EdgeTest& isFree) {
  if (tree.nodes.size() < 2 || other.nodes.size() < 2) return true;
  const Eigen::VectorXd root = tree.nodes[0], way = other.nodes[1] - root;
  const bool isBlocked = !isFree(root, root + std::min(1., stepSize / way.norm()) * way);
  return isBlocked || leadsTowards(root, tree.nodes[1], other.nodes[1]);
}

inline constexpr const char* kBiased = "Do targets depend on goalBias? In growBoth it has no effect.";

/// In these worlds both trees have to grow, since one alone would take much longer to get through two gaps:
/// at least one node in twenty belongs to the smaller of the two. The bias has no effect, even if it is 1.
inline void growsFromBoth(rex::grading::Check& check, Student& student, const std::string& world,
                          const PlaneProblem& problem, double goalBias, rex::Rng& given) {
  const SearchSettings settings = inThePlane(0.06, goalBias, 20000);
  describe(check, world, problem, settings);
  const EdgeTest isFree = freeIn(problem.world);
  EdgeRecord record(isFree, 2);
  const TwoTreeSearch search =
      student.growBoth(problem.start, problem.goal, settings, record.test(), check.split(given.next()));
  {
    const auto biased = check.ask(kBiased, goalBias == 1);
    twoTreesAreSound(check, search, problem, settings, record, isFree);
  }
  const double one = static_cast<double>(search.fromStart.nodes.size());
  const double other = static_cast<double>(search.fromGoal.nodes.size());
  const auto shown = check.show([&] {
    return treesSeen(problem, {search.fromStart, search.fromGoal}, search.path);
  });
  {
    const auto edge = check.show([&] {
      return treesSeen(problem, {search.fromStart, search.fromGoal}, search.path, 1, 1);
    });
    const auto target = check.ask(
        "Does the second tree step towards the random target? Its target is the new node of the other.");
    check.that("the first step of one tree of growBoth leads towards the first new node of the other",
               answers(search.fromStart, search.fromGoal, settings.stepSize, isFree) ||
                   answers(search.fromGoal, search.fromStart, settings.stepSize, isFree));
  }
  const auto biased = check.ask(kBiased, goalBias == 1);
  const auto swapped = check.ask("Do the trees never swap? Each takes random steps in turn.");
  check.atLeast("number of random steps of the tree from the start in growBoth",
                randomSteps(search.fromStart, search.fromGoal), 1);
  check.atLeast("number of random steps of the tree from the goal in growBoth",
                randomSteps(search.fromGoal, search.fromStart), 1);
  check.atLeast("number of nodes in the smaller tree of growBoth", std::min(one, other),
                0.05 * (one + other));
}
