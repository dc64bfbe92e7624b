#include "learning/policy_values.h"

#include <cmath>
#include <deque>
#include <optional>

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

Eigen::VectorXd solved(const SparseMatrix& M, const Eigen::VectorXd& b) {
  Eigen::SparseLU<SparseMatrix> factors(M);
  Eigen::VectorXd x = factors.solve(b);
  x += factors.solve(b - M * x);
  return x;
}

std::string endlessMessage(int state) {
  return fmt::format("without discount there is no value: from state {} no terminal state is reached", state);
}

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
  const SparseMatrix M = identityMinus(mdp.discount, P);
  const Eigen::VectorXd V = solved(M, rewards);
  const double scale = std::max(V.cwiseAbs().maxCoeff(), rewards.cwiseAbs().maxCoeff());
  result.residual = scale > 0 ? (rewards - M * V).cwiseAbs().maxCoeff() / scale : 0;
  if (!(result.residual < 1e-8)) {
    result.message = "the linear system of the values is singular to the digits of a double";
    return result;
  }
  result.V = V;
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
  return solved(identityMinus(mdp.discount, P).transpose(), start);
}

}  // namespace rex
