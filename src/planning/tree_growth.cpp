#include <utility>

#include <fmt/format.h>

#include "base/error.h"
#include "base/require.h"
#include "base/rng.h"
#include "planning/tree_growth_internal.h"

namespace rex::internal {
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
