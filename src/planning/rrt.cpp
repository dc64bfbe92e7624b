#include "planning/rrt.h"

#include <array>

#include "planning/tree_growth_internal.h"

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

}  // namespace rex
