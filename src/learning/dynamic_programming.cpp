#include "learning/dynamic_programming.h"

#include <fmt/format.h>

#include "base/error.h"
#include "base/require.h"
#include "learning/policy_values.h"

namespace rex {
namespace {

// The error that rounding may add to one sweep, from each product and each sum.
double roundingOfSweep(const Mdp& mdp, double largest) {
  Eigen::Index terms = 0;
  for (const TransitionMatrix& P : mdp.transitions)
    for (int s = 0; s < mdp.states(); ++s) terms = std::max(terms, P.row(s).nonZeros());
  return static_cast<double>(terms + 3) * std::numeric_limits<double>::epsilon() * largest;
}

// |V - V*| from how far V is from solving Bellman's equation; without discount the residual itself.
double boundOf(const Mdp& mdp, const MdpSolution& solution) {
  const double residual = (solution.Q.rowwise().maxCoeff() - solution.V).cwiseAbs().maxCoeff();
  const double scale = solution.V.cwiseAbs().maxCoeff() + mdp.rewards.cwiseAbs().maxCoeff();
  return (residual + roundingOfSweep(mdp, scale)) / (mdp.discount < 1 ? 1 - mdp.discount : 1);
}

// For each state, an action that may lead one step closer to a terminal state, so that the policy ends if any
// does.
std::vector<int> actionsTowardTheEnd(const Mdp& mdp) {
  std::vector<int> actions(static_cast<std::size_t>(mdp.states()), 0);
  std::vector<bool> ends = mdp.terminal;
  ends.resize(actions.size(), false);
  for (bool isGrowing = true; isGrowing;) {
    const std::vector<bool> nearer = ends;
    for (int a = 0; a < mdp.actions(); ++a)
      for (int s = 0; s < mdp.states(); ++s)
        for (TransitionMatrix::InnerIterator entry(mdp.transitions[static_cast<std::size_t>(a)], s); entry;
             ++entry)
          if (!ends[static_cast<std::size_t>(s)] && nearer[static_cast<std::size_t>(entry.col())] &&
              entry.value() > 0) {
            actions[static_cast<std::size_t>(s)] = a;
            ends[static_cast<std::size_t>(s)] = true;
          }
    isGrowing = ends != nearer;
  }
  return actions;
}

// The old action stays unless another is better by more than rounding: so that equally good ones do not
// alternate.
bool improve(const Mdp& mdp, MdpSolution& solution) {
  const double scale = solution.V.cwiseAbs().maxCoeff() + mdp.rewards.cwiseAbs().maxCoeff();
  const std::vector<int> best = greedyActions(solution.Q);
  bool isBetter = false;
  for (std::size_t s = 0; s < best.size(); ++s) {
    const auto row = static_cast<Eigen::Index>(s);
    const double gain = solution.Q(row, best[s]) - solution.Q(row, solution.actions[s]);
    if (!(gain > 1e-12 * scale)) continue;
    solution.actions[s] = best[s];
    isBetter = true;
  }
  return isBetter;
}

}  // namespace

MdpSolution valueIteration(const Mdp& mdp, const ValueIterationOptions& options) {
  requireMdp(mdp);
  if (mdp.discount == 1)
    throw Error({.what = "discount of value iteration",
                 .found = "1",
                 .wanted = "less than 1: otherwise its error has no bound, and policyIteration is exact"});
  requirePositive("tolerance of value iteration", options.tolerance);
  requireCount("maxIterations of value iteration", options.maxIterations, 1);
  MdpSolution solution;
  solution.V = Eigen::VectorXd::Zero(mdp.states());
  while (solution.iterations < options.maxIterations && solution.errorBound > options.tolerance) {
    const Eigen::VectorXd next = actionValues(mdp, solution.V).rowwise().maxCoeff();
    const double change = (next - solution.V).cwiseAbs().maxCoeff();
    const double rounding =
        roundingOfSweep(mdp, next.cwiseAbs().maxCoeff() + mdp.rewards.cwiseAbs().maxCoeff());
    solution.V = next;
    solution.errorBound = (mdp.discount * change + rounding) / (1 - mdp.discount);
    solution.history.push_back(change);
    ++solution.iterations;
    if (change == 0) break;
  }
  solution.Q = actionValues(mdp, solution.V);
  solution.actions = greedyActions(solution.Q);
  const bool isSolved = solution.errorBound <= options.tolerance;
  solution.status = isSolved ? MdpStatus::kSolved : MdpStatus::kNotConverged;
  solution.message =
      fmt::format("{} after {} iterations: values within {:.3g}", isSolved ? "solved" : "not converged",
                  solution.iterations, solution.errorBound);
  return solution;
}

MdpSolution policyIteration(const Mdp& mdp, int maxIterations) {
  requireMdp(mdp);
  requireCount("maxIterations of policy iteration", maxIterations, 1);
  MdpSolution solution;
  solution.actions = actionsTowardTheEnd(mdp);
  while (solution.iterations < maxIterations) {
    const PolicyValues values = policyValues(mdp, policyOf(mdp, solution.actions));
    if (values.status != MdpStatus::kSolved) {
      solution.status = values.status;
      if (values.status == MdpStatus::kEndless)  // then the optimum is not finite, and no V is near it
        solution.errorBound = std::numeric_limits<double>::infinity();
      solution.message = fmt::format("policy {}: {}", solution.iterations + 1, values.message);
      return solution;
    }
    if (solution.iterations > 0) solution.history.push_back((values.V - solution.V).cwiseAbs().maxCoeff());
    ++solution.iterations;
    solution.V = values.V;
    solution.Q = actionValues(mdp, solution.V);
    solution.errorBound = boundOf(mdp, solution);
    if (!improve(mdp, solution)) {
      solution.status = MdpStatus::kSolved;
      solution.message = fmt::format("solved after {} policies", solution.iterations);
      return solution;
    }
  }
  solution.message = fmt::format("not converged after {} policies", solution.iterations);
  return solution;
}

}  // namespace rex
