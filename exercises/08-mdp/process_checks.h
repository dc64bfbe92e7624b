#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "grading/check.h"
#include "interface.h"
#include "learning/dynamic_programming.h"
#include "learning/mazes.h"
#include "mistakes.h"

// Part 2, and the grader's decision processes: what their states and actions are worth.

inline rex::Mdp mdpOf(const Process& process) {
  rex::Mdp mdp;
  mdp.rewards = process.R;
  mdp.discount = process.discount;
  for (const Eigen::MatrixXd& P : process.P) mdp.transitions.push_back(P.sparseView());
  for (Eigen::Index s = 0; s < process.R.rows(); ++s)
    mdp.terminal.push_back(process.P.front().row(s).isZero(0));
  return mdp;
}

inline Process processOf(const rex::Mdp& mdp) {
  return {rex::denseTransitions(mdp), mdp.rewards, mdp.discount};
}

inline double twoDigits(double x) { return std::round(100 * x) / 100; }

/// Normal numbers with two digits.
inline Eigen::MatrixXd someNumbers(rex::Rng& rng, Eigen::Index rows, Eigen::Index cols = 1) {
  Eigen::MatrixXd numbers(rows, cols);
  for (Eigen::Index i = 0; i < numbers.size(); ++i) numbers.data()[i] = twoDigits(rng.normal());
  return numbers;
}

/// Random rewards, and transitions in quarters, so that cases can be computed by hand; about a quarter of
/// the states are terminal.
inline Process randomProcess(rex::Rng& rng, int n, int m, double discount) {
  Process process{{}, someNumbers(rng, n, m), twoDigits(discount)};
  const int ends = (n + 2) / 4;
  for (int a = 0; a < m; ++a) {
    Eigen::MatrixXd P = Eigen::MatrixXd::Zero(n, n);
    for (int s = 0; s < n - ends; ++s)
      for (int i = 0; i < 4; ++i) P(s, rng.index(n)) += .25;
    process.P.push_back(P);
  }
  return process;
}

/// A policy in hundredths.
inline Eigen::MatrixXd randomPolicy(rex::Rng& rng, const Process& process) {
  const int m = static_cast<int>(process.R.cols());
  Eigen::MatrixXd policy = Eigen::MatrixXd::Constant(process.R.rows(), m, .01);
  for (Eigen::Index s = 0; s < policy.rows(); ++s)
    for (int percent = m; percent < 100; ++percent) policy(s, rng.index(m)) += .01;
  return policy;
}

inline std::string described(const Process& process) {
  if (process.R.rows() == 7 && process.R.cols() == 2 && process.R == rex::tMaze().rewards)
    return "the T-maze of the sheet";
  return fmt::format("a process of {} states and {} actions", process.R.rows(), process.R.cols());
}

/// P[0], P[1], ... one below the other.
inline Eigen::MatrixXd stacked(const Process& process) {
  const Eigen::Index n = process.R.rows(), m = process.R.cols();
  Eigen::MatrixXd all(n * m, n);
  for (Eigen::Index a = 0; a < m; ++a) all.middleRows(a * n, n) = process.P[static_cast<std::size_t>(a)];
  return all;
}

/// The scale of the compared values: tolerances are relative to it.
inline double scaleOf(const Process& process) {
  return process.R.cwiseAbs().maxCoeff() / (1 - process.discount);
}

/// Transitions and rewards under a policy, or whatever other weights of the actions.
struct Chain {
  Eigen::MatrixXd P;
  Eigen::VectorXd r;
};
inline Chain chainOf(const Process& process, const Eigen::MatrixXd& weights, bool isTurned = false) {
  const Eigen::Index n = process.R.rows(), m = process.R.cols();
  Chain chain{Eigen::MatrixXd::Zero(n, n), Eigen::VectorXd::Zero(n)};
  for (Eigen::Index a = 0; a < m; ++a) {
    const Eigen::MatrixXd& P = process.P[static_cast<std::size_t>(a)];
    for (Eigen::Index s = 0; s < n; ++s) {
      chain.r[s] += weights(s, a) * process.R(s, a);
      for (Eigen::Index t = 0; t < n; ++t) chain.P(s, t) += weights(s, a) * (isTurned ? P(t, s) : P(s, t));
    }
  }
  return chain;
}

/// V = r + discount P V; empty if there is none.
inline Eigen::VectorXd solved(const Chain& chain, double discount, double factorOfRewards = 1) {
  const Eigen::Index n = chain.r.size();
  const Eigen::MatrixXd M = Eigen::MatrixXd::Identity(n, n) - discount * chain.P;
  try {
    return factorOfRewards * rex::solveMatrix(M, chain.r);
  } catch (const rex::Error&) {
    return {};
  }
}

inline std::vector<Mistake> mistakenValues(const Process& process, const Eigen::MatrixXd& policy) {
  const double discount = process.discount;
  const Eigen::MatrixXd all = Eigen::MatrixXd::Ones(policy.rows(), policy.cols());
  const Chain right = chainOf(process, policy), sums = chainOf(process, all);
  const char* const columns = "Are columns of P taken for rows? P[a](s, t) leads from s to t.";
  return {
      {columns, solved(chainOf(process, policy, true), discount)},
      {columns, solved({right.P.transpose(), right.r}, discount)},
      {"Is it only the reward of the first step?", right.r},
      {"Is the reward in s discounted, too? Only what follows is.", solved(right, discount, discount)},
      {"Does what follows have the wrong sign? V - discount P V is the reward.", solved(right, -discount)},
      {"Are the rewards added up without the probabilities of the actions?",
       solved({right.P, sums.r}, discount)},
      {"Are the matrices P added up without the probabilities of the actions?",
       solved({sums.P, right.r}, discount)},
      {"Are these the optimal values? Wanted are those of the given policy.",
       rex::policyIteration(mdpOf(process)).V}};
}

inline void policyIsWorth(rex::grading::Check& check, Student& student, const Process& process) {
  const Eigen::MatrixXd policy = randomPolicy(check.rng(), process);
  check.input(described(process), {{"P, action by action", stacked(process)},
                                   {"R", process.R},
                                   {"discount", process.discount},
                                   {"policy", policy}});
  const Eigen::VectorXd got = student.valuesOf(process, policy),
                        wanted = rex::policyValues(mdpOf(process), policy).V;
  const double tolerance = 1e-9 * scaleOf(process);
  check.shape("V of valuesOf", got, wanted.size(), 1);
  const auto shown = check.show([&] { return barsSeen("V of valuesOf", "state", got, wanted); });
  const auto early = check.ask("Does an iteration end too early? Eq. (9) is a linear system for V.",
                               distance(got, wanted) < 1e-4 * scaleOf(process));
  check.near("V of valuesOf", got, wanted, tolerance, mistakenValues(process, policy));
}

/// R + discount times what follows if an action with transitions P is taken in s.
inline Eigen::MatrixXd worthWith(
    const Process& process, const std::function<double(const Eigen::MatrixXd&, Eigen::Index)>& following) {
  Eigen::MatrixXd worth = process.R;
  for (Eigen::Index s = 0; s < worth.rows(); ++s)
    for (Eigen::Index a = 0; a < worth.cols(); ++a)
      worth(s, a) += process.discount * following(process.P[static_cast<std::size_t>(a)], s);
  return worth;
}

inline std::vector<Mistake> mistakenWorths(const Process& process, const Eigen::VectorXd& V) {
  using Matrix = Eigen::MatrixXd;
  using Index = Eigen::Index;
  const double discount = process.discount;
  const Matrix &R = process.R, wanted = rex::actionValues(mdpOf(process), V), following = wanted - R;
  return {{"Does P[0] serve for all actions?",
           worthWith(process, [&](const Matrix&, Index s) { return following(s, 0) / discount; })},
          {"Is the reward discounted, too? Only what follows is.", wanted - (1 - discount) * R},
          {"Is the reward left out?", following}};
}

inline void actionsAreWorth(rex::grading::Check& check, Student& student, const Process& process) {
  const Eigen::VectorXd V = someNumbers(check.rng(), process.R.rows());
  check.input(described(process), {{"P, action by action", stacked(process)},
                                   {"R", process.R},
                                   {"discount", process.discount},
                                   {"V", V}});
  const Eigen::MatrixXd got = student.worthOfActions(process, V),
                        wanted = rex::actionValues(mdpOf(process), V);
  const auto shown = check.show([&] {
    return barsSeen("Worth of actions by worthOfActions, action by action", "states of action 0, 1, ...", got,
                    wanted);
  });
  check.near("worth of actions by worthOfActions (states x actions)", got, wanted, 1e-9,
             mistakenWorths(process, V));
}
