#include "learning/policy_values.h"

#include <cmath>
#include <deque>
#include <optional>
#include <utility>

#include <Eigen/SparseLU>
#include <fmt/format.h>

#include "base/error.h"

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

}  // namespace rex
