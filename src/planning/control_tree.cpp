#include "planning/control_tree.h"

#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/error.h"
#include "base/require.h"
#include "base/rng.h"
#include "planning/search_tree_internal.h"

namespace rex {
namespace {

std::string listed(const VectorArg& x) {
  return fmt::format("({:.4g})", fmt::join(x.begin(), x.end(), ", "));
}

void requireSound(const ControlSystem& system, const ControlTreeOptions& options) {
  if (!system.motion)
    throw Error({.what = "control system",
                 .found = "no motion",
                 .wanted = "a function that gives the state after a motion"});
  requireSize("upper bounds of controls", system.upper.size(), system.lower.size());
  requirePositive("duration of controls", options.duration, kSeconds);
  requireCount("checks of a motion", options.checks, 1);
  requireCount("trials of controls", options.trials, 1);
  requireCount("number of samples", options.maxSamples, 1);
  requireNotNegative("tolerance of a goal", options.tolerance);
  if (!(options.goalBias >= 0 && options.goalBias <= 1))
    throw Error({.what = "goal bias of a tree",
                 .found = fmt::format("{:g}", options.goalBias),
                 .wanted = "a number from 0 to 1"});
}

class ControlTree {
 public:
  ControlTree(const ControlSystem& system, const PathProblem& problem, const ControlTreeOptions& options,
              Rng& rng)
      : system_(system),
        problem_(problem),
        options_(options),
        rng_(rng),
        tree_(system.space, problem.start),
        controls_{Eigen::VectorXd::Zero(system.lower.size())} {}

  ControlPath grow() {
    int goal = distance(problem_.start, problem_.goal) <= options_.tolerance ? 0 : -1;
    Eigen::VectorXd target(system_.space.size());
    while (goal < 0 && samples_ < options_.maxSamples) {
      ++samples_;
      if (rng_.uniform() < options_.goalBias)
        target = problem_.goal;
      else
        system_.space.sample(rng_, target);
      const int node = options_.towardsTargets ? extend(nearest(target), target, options_.trials)
                                               : extend(rng_.index(tree_.count()), target, 1);
      if (node >= 0 && distance(tree_.points().point(node), problem_.goal) <= options_.tolerance) goal = node;
    }
    return finish(goal);
  }

 private:
  double distance(const VectorArg& from, const VectorArg& to) const {
    if (!system_.distance) return system_.space.distance(from, to);
    const double distance = system_.distance(from, to);
    if (std::isnan(distance)) {
      throw Error({.what = fmt::format("distance from {} to {}", listed(from), listed(to)),
                   .found = "not a number",
                   .wanted = "a number, 0 or more"});
    }
    return distance;
  }

  // A tree of neighbours helps only if the distance is the metric of the space.
  int nearest(const VectorArg& target) const {
    if (!system_.distance) return tree_.points().nearest(target);
    std::pair<double, int> best{std::numeric_limits<double>::infinity(), 0};
    for (int i = 0; i < tree_.count(); ++i)
      best = std::min(best, {distance(tree_.points().point(i), target), i});
    return best.second;
  }

  Eigen::VectorXd move(const VectorArg& x, const VectorArg& u, double seconds) const {
    Eigen::VectorXd next = system_.motion(x, u, seconds);
    requireSize("state after a motion", next.size(), system_.space.size());
    if (!next.allFinite()) {
      throw Error({.what = fmt::format("motion from {} by {}", listed(x), listed(u)),
                   .found = "a number that is not finite",
                   .wanted = "a state"});
    }
    return next;
  }

  // The node that the best of some random controls leads to, -1 if something is in the way.
  int extend(int from, const VectorArg& target, int trials) {
    const Eigen::VectorXd x = tree_.points().point(from);
    Eigen::VectorXd best;
    double nearest = std::numeric_limits<double>::infinity();
    for (int i = 0; i < trials; ++i) {
      const Eigen::VectorXd u =
          system_.lower.array() + rng_.uniformVector(static_cast<int>(system_.lower.size()), 0, 1).array() *
                                      (system_.upper - system_.lower).array();
      const double distance = this->distance(move(x, u, options_.duration), target);
      if (best.size() > 0 && distance >= nearest) continue;
      nearest = distance;
      best = u;
    }
    Eigen::MatrixXd states(x.size(), options_.checks);
    for (int k = 0; k < options_.checks; ++k)
      states.col(k) = move(x, best, options_.duration * (k + 1) / options_.checks);
    asked_ += options_.checks;
    if (!problem_.allValid(states)) return -1;
    controls_.push_back(best);
    return tree_.add(states.rightCols<1>(), from);
  }

  ControlPath finish(int goal) const {
    ControlPath path{.controls = Eigen::MatrixXd(system_.lower.size(), 0), .duration = options_.duration};
    PathResult& found = path.found;
    found.samples = samples_;
    found.asked = asked_;
    found.trees.push_back(tree_.drawn());
    const bool isFound = goal >= 0;
    found.message = fmt::format("{} after {} samples: {} nodes, {} states checked",
                                isFound ? "found a path" : "no path", samples_, tree_.count(), asked_);
    if (!isFound) return path;
    found.status = PathStatus::kFound;
    found.path = tree_.wayTo(goal);
    found.length = pathLength(system_.space, found.path);
    path.controls.resize(Eigen::NoChange, found.path.cols() - 1);
    for (Eigen::Index k = path.controls.cols() - 1, at = goal; k >= 0;
         --k, at = tree_.parent(static_cast<int>(at)))
      path.controls.col(k) = controls_[static_cast<std::size_t>(at)];
    return path;
  }

  const ControlSystem& system_;
  const PathProblem& problem_;
  const ControlTreeOptions& options_;
  Rng& rng_;
  internal::SearchTree tree_;
  std::vector<Eigen::VectorXd> controls_;  // that led to each node
  int samples_ = 0;
  long asked_ = 0;
};

}  // namespace

ControlPath growControlTree(const ControlSystem& system, const PathProblem& problem,
                            const ControlTreeOptions& options, Rng& rng) {
  requireSound(system, options);
  rex::requireSound(problem);
  return ControlTree(system, problem, options, rng).grow();
}

}  // namespace rex
