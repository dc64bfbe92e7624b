#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "grading/check.h"
#include "interface.h"
#include "learning/dynamic_programming.h"
#include "learning/mazes.h"
#include "learning/policy_values.h"
#include "value_evidence.h"

// Parts 1 to 4: the grader's decision processes, and what must hold for their values and policies.

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

/// Random rewards and transitions; if there are more than three states, some are terminal.
inline Process randomProcess(rex::Rng& rng, int n, int m, double discount) {
  Process process{{}, rng.normalVector(n * m).reshaped(n, m), discount};
  const int ends = n > 3 ? n / 4 : 0;
  for (int a = 0; a < m; ++a) {
    Eigen::MatrixXd P = Eigen::MatrixXd::Zero(n, n);
    for (int s = 0; s < n - ends; ++s) {
      for (int i = 0; i < 3; ++i) P(s, rng.index(n)) += rng.uniform(.1, 1);
      P.row(s) /= P.row(s).sum();
    }
    process.P.push_back(P);
  }
  return process;
}

inline Eigen::MatrixXd randomPolicy(rex::Rng& rng, const Process& process) {
  const Eigen::Index n = process.R.rows(), m = process.R.cols();
  Eigen::MatrixXd policy = rng.uniformVector(static_cast<int>(n * m), .01, 1).reshaped(n, m);
  policy.array().colwise() /= policy.rowwise().sum().array().eval();
  return policy;
}

inline std::string described(const Process& process) {
  return fmt::format("a process of {} states and {} actions, discount {:.2f}", process.R.rows(),
                     process.R.cols(), process.discount);
}

/// The scale of the compared values: tolerances are relative to it.
inline double scaleOf(const Process& process) {
  return process.R.cwiseAbs().maxCoeff() / (1 - process.discount);
}

inline void mazeFits(rex::grading::Check& check, Student& student, const Eigen::Vector4d& leaves,
                     double discount) {
  check.input(fmt::format("leaves {:g}, {:g}, {:g}, {:g}, discount {:g}", leaves[0], leaves[1], leaves[2],
                          leaves[3], discount));
  rex::Mdp maze = rex::tMaze();
  maze.discount = discount;
  maze.rewards.bottomRows(4).colwise() = leaves;
  const MazeValues values = student.mazeValues(leaves, discount);
  const Eigen::VectorXd random = rex::policyValues(maze, rex::uniformPolicy(maze)).V,
                        optimal = rex::policyIteration(maze).V;
  {
    const auto shown = check.show([&] { return mazeSeen("The random policy", values.random, random); });
    check.near("values of the random policy", values.random, random, 1e-9);
  }
  const auto shown = check.show([&] { return mazeSeen("The best policy", values.optimal, optimal); });
  check.near("optimal values", values.optimal, optimal, 1e-9);
}

inline void policyIsWorth(rex::grading::Check& check, Student& student, const Process& process) {
  check.input(described(process));
  const Eigen::MatrixXd policy = randomPolicy(check.rng(), process);
  const Eigen::VectorXd got = student.valuesOf(process, policy),
                        wanted = rex::policyValues(mdpOf(process), policy).V;
  const auto shown =
      check.show([&] { return barsSeen("Values of a policy", "index of the state", got, wanted); });
  check.near("values of a policy", got, wanted, 1e-9 * scaleOf(process));
}

inline void actionsAreWorth(rex::grading::Check& check, Student& student, const Process& process) {
  check.input(described(process));
  const Eigen::VectorXd V = check.rng().normalVector(static_cast<int>(process.R.rows()));
  const Eigen::MatrixXd got = student.worthOfActions(process, V),
                        wanted = rex::actionValues(mdpOf(process), V);
  const auto shown = check.show(
      [&] { return barsSeen("Worth of the actions, action by action", "index of the entry", got, wanted); });
  check.near("worth of the actions", got, wanted, 1e-9);
}

// The bound on the error of the second of two successive values.
inline double boundOf(const Process& process, const Eigen::VectorXd& before, const Eigen::VectorXd& after) {
  return process.discount / (1 - process.discount) * (after - before).cwiseAbs().maxCoeff();
}

inline void valuesSettle(rex::grading::Check& check, Student& student, const Process& process,
                         double tolerance) {
  check.input(described(process) + fmt::format(", tolerance {:g}", tolerance));
  const std::vector<Eigen::VectorXd> V = student.iterateValues(process, tolerance);
  const rex::Mdp mdp = mdpOf(process);
  const auto shown = check.show([&] { return settlingSeen(mdp, V, tolerance); });
  check.atLeast("number of values V_0, V_1, ...", static_cast<double>(V.size()), 2);
  check.near("V_0", V.front(), Eigen::VectorXd::Zero(process.R.rows()), 0);
  for (std::size_t i = 1; i < V.size(); ++i)
    check.near("V_k from V_(k-1)", V[i], rex::actionValues(mdp, V[i - 1]).rowwise().maxCoeff(),
               1e-11 * scaleOf(process));
  check.near("the last V", V.back(), rex::policyIteration(mdp).V, tolerance + 1e-10 * scaleOf(process));
  check.atMost("bound on the error of the last V", boundOf(process, V[V.size() - 2], V.back()),
               tolerance * (1 + 1e-6));
  if (V.size() < 3) return;
  check.atLeast("bound on the error of the V before the last",
                boundOf(process, V[V.size() - 3], V[V.size() - 2]), tolerance * (1 - 1e-6));
}

inline void policiesImprove(rex::grading::Check& check, Student& student, const Process& process) {
  check.input(described(process));
  const std::vector<std::vector<int>> policies = student.iteratePolicies(process);
  const auto states = static_cast<std::size_t>(process.R.rows());
  const int m = static_cast<int>(process.R.cols());
  const rex::Mdp mdp = mdpOf(process);
  check.atLeast("number of policies", static_cast<double>(policies.size()), 1);
  for (const std::vector<int>& actions : policies) {
    check.near("number of states of a policy", static_cast<double>(actions.size()),
               static_cast<double>(states), 0);
    check.that("actions are 0 to m - 1",
               std::all_of(actions.begin(), actions.end(), [&](int a) { return a >= 0 && a < m; }));
  }
  check.that("the first policy takes action 0", policies.front() == std::vector<int>(states, 0));
  const auto shown = check.show([&] { return policiesSeen(mdp, policies); });
  Eigen::VectorXd V;
  for (std::size_t i = 0; i < policies.size(); ++i) {
    if (i > 0) {
      check.that("each policy differs from the one before", policies[i] != policies[i - 1]);
      const Eigen::MatrixXd Q = rex::actionValues(mdp, V);
      for (std::size_t s = 0; s < states; ++s) {
        check.atMost("how much less the new action is worth than the best one, by the values before",
                     Q.row(static_cast<int>(s)).maxCoeff() - Q(static_cast<int>(s), policies[i][s]),
                     1e-8 * scaleOf(process));
      }
    }
    V = rex::policyValues(mdp, rex::policyOf(mdp, policies[i])).V;
  }
  check.near("values of the last policy", V, rex::policyIteration(mdp).V, 1e-7 * scaleOf(process));
}

/// From state 0, actions 1 and 2 lead to states 1 and 2, from which every action leads to state 3. At first
/// action 2 is better; in the end both are equally good, and the action taken before must stay.
inline void tieStays(rex::grading::Check& check, Student& student) {
  Process process{std::vector<Eigen::MatrixXd>(3, Eigen::MatrixXd::Zero(4, 4)), Eigen::MatrixXd(4, 3), .5};
  for (Eigen::Index a = 0; a < 3; ++a) {
    Eigen::MatrixXd& P = process.P[static_cast<std::size_t>(a)];
    P(0, a == 0 ? 3 : a) = P(1, 3) = P(2, 3) = 1;
  }
  process.R << -1, 0, 0, 0, 1, -1, .5, 1, -1, 0, 0, 0;
  policiesImprove(check, student, process);
  const std::vector<std::vector<int>> expected{{0, 0, 0, 0}, {2, 1, 1, 0}};
  check.that("an action is kept if another one is only as good",
             student.iteratePolicies(process) == expected);
}
