#pragma once

#include <optional>
#include <vector>

#include "interface.h"
#include "learning/dynamic_programming.h"
#include "learning/inverse_rl.h"
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

/// The process of a world; ends lead to a state of their own, where nothing is paid.
inline rex::Mdp endingMdp(const std::vector<Eigen::MatrixXd>& P, const Eigen::MatrixXd& R, double discount) {
  const Eigen::Index n = R.rows();
  rex::Mdp mdp{.rewards = Eigen::MatrixXd::Zero(n + 1, R.cols()), .discount = discount};
  mdp.rewards.topRows(n) = R;
  mdp.terminal.assign(static_cast<std::size_t>(n), false);
  mdp.terminal.push_back(true);
  for (const Eigen::MatrixXd& rows : P) {
    Eigen::MatrixXd all = Eigen::MatrixXd::Zero(n + 1, n + 1);
    all.topLeftCorner(n, n) = rows;
    all.col(n).head(n) = (1 - rows.rowwise().sum().array()).max(0);
    mdp.transitions.emplace_back(all.sparseView());
  }
  return mdp;
}

/// Q in the model.
inline Eigen::MatrixXd exactValues(const LearnedWorld& model, double discount) {
  return rex::policyIteration(endingMdp(model.P, model.R, discount)).Q.topRows(model.R.rows());
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

inline Eigen::MatrixXd uniformChoice(Eigen::Index states, Eigen::Index actions) {
  return Eigen::MatrixXd::Constant(states, actions, 1. / static_cast<double>(actions));
}

/// Frequencies as running means.
inline Eigen::MatrixXd cloneOf(const std::vector<Lesson>& lessons, int states, int actions) {
  Eigen::MatrixXd policy = uniformChoice(states, actions);
  std::vector<int> seen(static_cast<std::size_t>(states), 0);
  for (const Lesson& l : lessons) {
    policy.row(l.state) *= 1 - 1. / ++seen[static_cast<std::size_t>(l.state)];
    policy(l.state, l.action) += 1. / seen[static_cast<std::size_t>(l.state)];
  }
  return policy;
}

/// One lesson per row.
inline Eigen::MatrixXd rowsOf(const std::vector<Lesson>& lessons) {
  Eigen::MatrixXd rows(lessons.size(), 2);
  for (std::size_t i = 0; i < lessons.size(); ++i)
    rows.row(static_cast<Eigen::Index>(i)) << lessons[i].state, lessons[i].action;
  return rows;
}

/// Lessons in all states but the last; the last one in state 0 differs from most of the others there.
inline std::vector<Lesson> randomLessons(int states, int actions, int count, rex::Rng& rng) {
  std::vector<Lesson> lessons{{0, 1}, {0, 1}, {0, 1}};
  while (static_cast<int>(lessons.size()) + 1 < count)
    lessons.push_back({rng.index(states - 1), rng.index(actions)});
  lessons.push_back({0, 0});
  return lessons;
}

inline std::vector<int> randomTeacher(int states, int actions, rex::Rng& rng) {
  std::vector<int> teacher;
  for (int i = 0; i < states; ++i) teacher.push_back(rng.index(actions));
  return teacher;
}

inline Eigen::VectorXd numbersOf(const std::vector<int>& list) {
  return Eigen::Map<const Eigen::VectorXi>(list.data(), static_cast<Eigen::Index>(list.size()))
      .cast<double>();
}

/// Each pair leads to one state or another, and each step ends with a probability of at least .05.
inline FeatureWorld randomWorld(int states, int actions, int features, double discount, rex::Rng& rng) {
  FeatureWorld world{{}, Eigen::VectorXd::Zero(states), Eigen::MatrixXd(features, states), discount};
  for (int action = 0; action < actions; ++action) {
    world.P.emplace_back(Eigen::MatrixXd::Zero(states, states));
    for (Eigen::Index s = 0; s < states; ++s) {
      const int nearby = rng.index(8);
      world.P.back()(s, rng.index(states)) += .05 * (11 + nearby);
      world.P.back()(s, rng.index(states)) += .05 * static_cast<double>(8 - nearby - s % 2);
    }
  }
  world.start[0] = .75;
  world.start[1 + rng.index(states - 1)] = .25;
  for (double& number : world.features.reshaped()) number = .1 * (rng.index(21) - 10);
  return world;
}

/// Probabilities of actions, in steps of .1.
inline Eigen::MatrixXd randomPolicy(int states, int actions, rex::Rng& rng) {
  Eigen::MatrixXd chosen = Eigen::MatrixXd::Zero(states, actions);
  for (int i = 0; i < 10 * states; ++i) chosen(i / 10, rng.index(actions)) += .1;
  return chosen;
}

/// Rewards (n x m) if each step from s pays w^T phi(s).
inline Eigen::MatrixXd paidBy(const FeatureWorld& world, const Eigen::VectorXd& w) {
  return (world.features.transpose() * w).replicate(1, static_cast<Eigen::Index>(world.P.size()));
}

/// With zeros for the state in which all ends.
inline Eigen::MatrixXd extended(const Eigen::MatrixXd& part, int moreRows, int moreColumns) {
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(part.rows() + moreRows, part.cols() + moreColumns);
  all.topLeftCorner(part.rows(), part.cols()) = part;
  return all;
}

inline Eigen::MatrixXd untilEnd(const Eigen::MatrixXd& policy) {
  Eigen::MatrixXd acts = extended(policy, 1, 0);
  acts(policy.rows(), 0) = 1;
  return acts;
}

/// The second opinions on a policy: its expected features, and its values if being in s pays w^T phi(s).
inline Eigen::VectorXd featuresOf(const FeatureWorld& world, const Eigen::MatrixXd& policy) {
  const rex::Mdp mdp = endingMdp(world.P, policy, world.discount);
  return rex::featureExpectations(mdp, untilEnd(policy), extended(world.features, 0, 1),
                                  extended(world.start, 1, 0).col(0));
}
inline Eigen::VectorXd worthOf(const FeatureWorld& world, const Eigen::VectorXd& w,
                               const Eigen::MatrixXd& policy) {
  const rex::Mdp mdp = endingMdp(world.P, paidBy(world, w), world.discount);
  return rex::policyValues(mdp, untilEnd(policy)).V.head(policy.rows());
}
inline Eigen::VectorXd bestWorth(const FeatureWorld& world, const Eigen::VectorXd& w) {
  return exactValues({world.P, paidBy(world, w), {}}, world.discount).rowwise().maxCoeff();
}
