#include "learning/dynamic_programming.h"

#include <cmath>
#include <deque>
#include <optional>
#include <utility>

#include <Eigen/SparseLU>
#include <fmt/format.h>

#include "base/error.h"
#include "base/require.h"

namespace rex {
namespace {

using SparseMatrix = Eigen::SparseMatrix<double>;

SparseMatrix transitionsUnder(const Mdp& mdp, const MatrixArg& policy) {
  TransitionMatrix P(mdp.states(), mdp.states());
  for (int a = 0; a < mdp.actions(); ++a)
    P += policy.col(a).asDiagonal() * mdp.transitions[static_cast<std::size_t>(a)];
  return P;
}

// A state from which no terminal state is reached.
std::optional<int> endlessState(const Mdp& mdp, const SparseMatrix& P) {
  std::vector<bool> ends(static_cast<std::size_t>(mdp.states()), false);
  std::deque<int> open;
  for (int s = 0; s < mdp.states(); ++s)
    if (mdp.isTerminal(s)) open.push_back(s);
  for (const int s : open) ends[static_cast<std::size_t>(s)] = true;
  while (!open.empty()) {
    for (SparseMatrix::InnerIterator entry(P, open.front()); entry; ++entry) {
      const auto before = static_cast<std::size_t>(entry.row());
      if (entry.value() <= 0 || ends[before]) continue;
      ends[before] = true;
      open.push_back(static_cast<int>(entry.row()));
    }
    open.pop_front();
  }
  for (int s = 0; s < mdp.states(); ++s)
    if (!ends[static_cast<std::size_t>(s)]) return s;
  return std::nullopt;
}

SparseMatrix identityMinus(double discount, const SparseMatrix& P) {
  SparseMatrix I(P.rows(), P.cols());
  I.setIdentity();
  SparseMatrix M = I - discount * P;
  M.makeCompressed();
  return M;
}

// The solution of M x = b, and its largest residual relative to the largest number.
struct LinearSolution {
  Eigen::VectorXd x{};
  double residual = std::numeric_limits<double>::infinity();
  bool isSound() const { return residual < 1e-8; }
};

LinearSolution solved(const SparseMatrix& M, const Eigen::VectorXd& b) {
  const Eigen::SparseLU<SparseMatrix> factors(M);
  if (factors.info() != Eigen::Success) return {};  // a pivot is zero: there is nothing to solve with
  LinearSolution result{factors.solve(b)};
  result.x += factors.solve(b - M * result.x);
  const double scale = std::max(result.x.cwiseAbs().maxCoeff(), b.cwiseAbs().maxCoeff());
  result.residual = scale > 0 ? (b - M * result.x).cwiseAbs().maxCoeff() / scale : 0;
  return result;
}

std::string endlessMessage(int state) {
  return fmt::format("without discount there is no value: from state {} no terminal state is reached", state);
}

constexpr const char* kSingular =
    "the linear system of the values is singular in double precision: the process hardly ever ends";

}  // namespace

void requireStart(const Mdp& mdp, const VectorArg& start) {
  requireSize("start distribution", start.size(), mdp.states());
  for (Eigen::Index s = 0; s < start.size(); ++s)
    if (!(start[s] >= 0) || !std::isfinite(start[s]))
      throw Error({.what = fmt::format("start in state {}", s),
                   .found = fmt::format("{:g}", start[s]),
                   .wanted = "a probability"});
  if (std::abs(start.sum() - 1) > 1e-9)
    throw Error({.what = "start distribution",
                 .found = fmt::format("probabilities that sum to {:.12g}", start.sum()),
                 .wanted = "a sum of 1"});
}

PolicyValues policyValues(const Mdp& mdp, const MatrixArg& policy) {
  requireMdp(mdp);
  requirePolicy(mdp, policy);
  const SparseMatrix P = transitionsUnder(mdp, policy);
  PolicyValues result;
  if (mdp.discount == 1)
    if (const auto state = endlessState(mdp, P)) {
      result.status = MdpStatus::kEndless;
      result.message = endlessMessage(*state);
      return result;
    }
  const Eigen::VectorXd rewards = mdp.rewards.cwiseProduct(policy).rowwise().sum();
  LinearSolution solution = solved(identityMinus(mdp.discount, P), rewards);
  result.residual = solution.residual;
  if (!solution.isSound()) {
    result.message = kSingular;
    return result;
  }
  result.V = std::move(solution.x);
  result.status = MdpStatus::kSolved;
  result.message = "solved";
  return result;
}

Eigen::VectorXd discountedVisits(const Mdp& mdp, const MatrixArg& policy, const VectorArg& start) {
  requireMdp(mdp);
  requirePolicy(mdp, policy);
  requireStart(mdp, start);
  const SparseMatrix P = transitionsUnder(mdp, policy);
  if (mdp.discount == 1)
    if (const auto state = endlessState(mdp, P)) throw Error({.what = endlessMessage(*state)});
  LinearSolution visits = solved(identityMinus(mdp.discount, P).transpose(), start);
  if (!visits.isSound()) throw Error({.what = kSingular});
  return std::move(visits.x);
}

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
    const PolicyValues values = policyValues(mdp, deterministicPolicy(mdp, solution.actions));
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
