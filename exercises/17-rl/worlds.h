#pragma once

#include <optional>
#include <vector>

#include "interface.h"
#include "learning/dynamic_programming.h"
#include "learning/mazes.h"
#include "learning/mdp.h"
#include "learning/q_learning.h"

// The grader's experience, models and maps.

inline rex::TabularStep tabular(const Experience& step) {
  return {step.state, step.action, step.reward, step.ended ? std::nullopt : std::optional(step.next)};
}

/// One row per step, as numbers.
inline Eigen::MatrixXd rowsOf(const std::vector<Experience>& steps) {
  Eigen::MatrixXd rows(steps.size(), 5);
  for (std::size_t t = 0; t < steps.size(); ++t) {
    const Experience& e = steps[t];
    rows.row(static_cast<Eigen::Index>(t)) << e.state, e.action, e.reward, e.next, e.ended ? 1 : 0;
  }
  return rows;
}

inline Eigen::MatrixXd roundedTable(int rows, int cols, rex::Rng& rng) {
  Eigen::MatrixXd table(rows, cols);
  for (int s = 0; s < rows; ++s)
    for (int a = 0; a < cols; ++a) table(s, a) = .01 * (rng.index(600) - 300);
  return table;
}

/// Each step begins where the one before led.
inline std::vector<Experience> randomEpisode(int states, int actions, int length, bool ends, rex::Rng& rng) {
  std::vector<Experience> steps;
  int s = rng.index(states);
  for (int t = 0; t < length; ++t) {
    steps.push_back({s, rng.index(actions), .01 * (rng.index(400) - 150), rng.index(states), false});
    s = steps.back().next;
  }
  if (ends && !steps.empty()) steps.back().ended = true;
  return steps;
}

/// Steps from anywhere to anywhere. Every fifth repeats the pair before, and ends. The last pair is never
/// tried.
inline std::vector<Experience> randomSteps(int states, int actions, int count, rex::Rng& rng) {
  std::vector<Experience> steps;
  while (static_cast<int>(steps.size()) < count) {
    const bool ends = steps.size() % 5 == 3;
    const int s = ends ? steps.back().state : rng.index(states),
              a = ends ? steps.back().action : rng.index(actions);
    if (s == states - 1 && a == actions - 1) continue;
    steps.push_back({s, a, .01 * (rng.index(400) - 200), rng.index(states), ends});
  }
  return steps;
}

inline LearnedWorld modelOf(const std::vector<Experience>& steps, int states, int actions) {
  LearnedWorld m{{}, Eigen::MatrixXd::Zero(states, actions), Eigen::MatrixXd::Zero(states, actions)};
  m.P.assign(static_cast<std::size_t>(actions), Eigen::MatrixXd::Zero(states, states));
  // Running means.
  for (const Experience& e : steps) {
    const double share = 1 / ++m.visits(e.state, e.action);
    m.R(e.state, e.action) += share * (e.reward - m.R(e.state, e.action));
    auto row = m.P[static_cast<std::size_t>(e.action)].row(e.state);
    row *= 1 - share;
    if (!e.ended) row[e.next] += share;
  }
  return m;
}

inline Eigen::MatrixXd stackedOf(const LearnedWorld& model) {
  const Eigen::Index n = model.R.rows();
  Eigen::MatrixXd stacked(n * model.R.cols(), n);
  for (Eigen::Index a = 0; a < model.R.cols(); ++a)
    stacked.middleRows(a * n, n) = model.P[static_cast<std::size_t>(a)];
  return stacked;
}

/// Q in the model; ends lead to a state of their own, where nothing is paid.
inline Eigen::MatrixXd exactValues(const LearnedWorld& model, double discount) {
  const Eigen::Index n = model.R.rows(), m = model.R.cols();
  rex::Mdp mdp{.rewards = Eigen::MatrixXd::Zero(n + 1, m), .discount = discount};
  mdp.rewards.topRows(n) = model.R;
  mdp.terminal.assign(static_cast<std::size_t>(n), false);
  mdp.terminal.push_back(true);
  for (const Eigen::MatrixXd& P : model.P) {
    Eigen::MatrixXd all = Eigen::MatrixXd::Zero(n + 1, n + 1);
    all.topLeftCorner(n, n) = P;
    all.col(n).head(n) = (1 - P.rowwise().sum().array()).max(0);
    mdp.transitions.emplace_back(all.sparseView());
  }
  return rex::policyIteration(mdp).Q.topRows(n);
}

/// The model in which pairs that are not known are worth that much.
inline LearnedWorld hopeful(LearnedWorld model, int known, double worth) {
  for (std::size_t a = 0; a < model.P.size(); ++a)
    for (Eigen::Index s = 0; s < model.visits.rows(); ++s) {
      const auto column = static_cast<Eigen::Index>(a);
      if (!(model.visits(s, column) < known)) continue;
      model.P[a].row(s) *= 0;
      model.R(s, column) = worth;
    }
  return model;
}

inline rex::GridWorld hiddenMap() {
  return rex::gridWorld("....#.G\n.##...#\n.P..#..\n...##..",
                        {.discount = .95, .stepReward = -.02, .slip = .2, .marks = {{'G', 1}, {'P', -1}}});
}

/// Steps at random from everywhere; acting in a terminal state ends.
inline std::vector<Experience> wander(const rex::GridWorld& world, int count, rex::Rng& rng) {
  std::vector<Experience> steps;
  for (int i = 0; i < count; ++i) {
    const int s = rng.index(world.mdp.states()), a = rng.index(4);
    const bool ends = world.mdp.isTerminal(s);
    steps.push_back({s, a, world.mdp.rewards(s, a), ends ? s : rex::sampledNext(world.mdp, s, a, rng), ends});
  }
  return steps;
}
