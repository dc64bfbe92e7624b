#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "interface.h"
#include "mistakes.h"
#include "process_checks.h"

// Part 5: what trials record, and when they end.

/// A task for trials: what the step function was called with, and what it returned. It fails in one step.
struct TrialTask {
  Eigen::MatrixXd A;
  Eigen::VectorXd start;
  int failsAfter;
  std::vector<Eigen::VectorXd> states{};
  std::vector<double> actions{}, rewards{};

  Eigen::VectorXd after(const Eigen::VectorXd& state, double action) const {
    Eigen::VectorXd next = A * state;
    next[0] += .5 + .1 * std::tanh(action);
    return next;
  }
  Transition step(const Eigen::VectorXd& state, double action) {
    states.push_back(state);
    actions.push_back(action);
    rewards.push_back(.1 * action + static_cast<double>(states.size()));
    return {after(state, action), rewards.back(), static_cast<int>(states.size()) == failsAfter};
  }
};

/// Requires that the columns of two matrices agree, one for each step. `describe` is called with the first
/// that does not.
inline void columnsAgree(rex::grading::Check& check, const std::string& property, const Eigen::MatrixXd& got,
                         const Eigen::MatrixXd& wanted, const std::function<void(Eigen::Index)>& describe) {
  constexpr double kTolerance = 1e-9;
  check.shape(property, got, wanted.rows(), wanted.cols());
  std::vector<Eigen::VectorXd> columns, others;
  Eigen::Index first = -1;
  for (Eigen::Index t = 0; t < wanted.cols(); ++t) {
    columns.emplace_back(got.col(t));
    others.emplace_back(wanted.col(t));
    if (first < 0 && !(distance(columns.back(), others.back()) <= kTolerance)) first = t;
  }
  describe(std::max<Eigen::Index>(first, 0));
  const auto usual = check.suspectUsualMistake(got, wanted, kTolerance);
  check.nearAlong(property, rex::grading::overSteps(columns), others, kTolerance);
}

/// Where and when steps are taken, and the sizes of the trial.
inline void trialEnds(rex::grading::Check& check, const Rollout& trial, const TrialTask& task, int horizon) {
  const Eigen::Index T = std::min(horizon, task.failsAfter), k = task.start.size();
  const auto taken = static_cast<Eigen::Index>(task.states.size());
  {
    const auto on = check.ask("Does the trial go on after a failure? Failed steps are the last.",
                              T < horizon && taken > T);
    const auto none = check.ask("Is step() never called?", taken == 0);
    check.near("number of calls of step by runTrial", static_cast<double>(taken), static_cast<double>(T), 0);
  }
  struct Sized {
    const char* name;
    const Eigen::MatrixXd value;
    Eigen::Index rows, cols;
  };
  for (const auto& [name, value, rows, cols] : {Sized{"features of runTrial", trial.features, k, T},
                                                {"noise of runTrial", trial.noise, k, T},
                                                {"rewards of runTrial", trial.rewards, T, 1}}) {
    const Eigen::Index got = cols == 1 ? value.rows() : value.cols();
    const auto left = check.ask("Is the step that failed left out? It is the last of the trial.",
                                T < horizon && got == T - 1);
    const auto uncut =
        check.ask("Is the trial not cut to the steps that were taken?", T < horizon && got == horizon);
    const auto start = check.ask("Is there a column before the first step, or after the last?", got == T + 1);
    check.shape(name, value, rows, cols);
  }
}

inline std::vector<Mistake> mistakenNoise(const Policy& policy, const Eigen::MatrixXd& white) {
  const Eigen::MatrixXd turned = policy.L.transpose(), right = policy.L * white, wrong = turned * white;
  Eigen::MatrixXd shifted = right;
  for (Eigen::Index t = 0; t < white.cols(); ++t) shifted.col(t) += policy.beta;
  return {{"Is it L^T z? With a normal z, epsilon = L z.", wrong},
          {"Is it Sigma z? With a normal z, epsilon = L z.", policy.L * wrong},
          {"Is beta added to the noise?", shifted}};
}

inline Eigen::MatrixXd rowOf(const std::vector<double>& numbers) {
  Eigen::MatrixXd row(1, static_cast<Eigen::Index>(numbers.size()));
  std::copy(numbers.begin(), numbers.end(), row.data());
  return row;
}

/// Checks that steps lead on, and that the trial records what the step function saw; step t in words is
/// stepped(t). Returns the states as columns.
inline Eigen::MatrixXd statesFit(rex::grading::Check& check, const Rollout& trial, const TrialTask& task,
                                 const std::function<std::string(Eigen::Index)>& stepped) {
  const auto T = static_cast<Eigen::Index>(task.states.size());
  Eigen::MatrixXd seen(task.start.size(), T), next(task.start.size(), T + 1), still(task.start.size(), T);
  next.col(0) = task.start;
  for (Eigen::Index t = 0; t < T; ++t) {
    const auto at = static_cast<std::size_t>(t);
    check.shape("state that runTrial passes to step", task.states[at], task.start.size(), 1);
    seen.col(t) = task.states[at];
    still.col(t) = task.start;
    next.col(t + 1) = task.after(task.states[at], task.actions[at]);
  }
  {
    const auto mistake = check.ask(questionAbout(seen, 1e-9, {}));
    columnsAgree(check, "state that runTrial passes to step", seen, next.leftCols(T), [&](Eigen::Index t) {
      const Eigen::VectorXd wanted = next.col(t);
      check.input(stepped(t), {{t == 0 ? "start" : "state after the step before", wanted}});
    });
  }
  const auto late = check.ask(questionAbout(trial.features, 1e-9, {}));
  columnsAgree(check, "features of runTrial", trial.features, seen, [&](Eigen::Index t) {
    const Eigen::VectorXd state = seen.col(t);
    check.input(stepped(t), {{"state passed to step", state}});
  });
  return seen;
}

/// Noise and actions of a trial whose states are the columns of `seen`.
inline void actionsFit(rex::grading::Check& check, const Policy& policy, const Rollout& trial,
                       const TrialTask& task, const Eigen::MatrixXd& seen, rex::Rng rng,
                       const std::function<std::string(Eigen::Index)>& stepped) {
  const Eigen::Index k = seen.rows(), T = seen.cols();
  Eigen::MatrixXd white(k, T), noisy(1, T), plain(1, T), opposite(1, T);
  for (Eigen::Index t = 0; t < T; ++t) {
    white.col(t) = rng.normalVector(static_cast<int>(k));
    const Eigen::VectorXd phi = seen.col(t), epsilon = trial.noise.col(t);
    plain(t) = phi.dot(policy.beta);
    noisy(t) = plain(t) + phi.dot(epsilon);
    opposite(t) = 2 * plain(t) - noisy(t);
  }
  {
    const auto mistake = check.ask(questionAbout(trial.noise, 1e-9, mistakenNoise(policy, white)));
    columnsAgree(check, "noise of runTrial", trial.noise, policy.L * white, [&](Eigen::Index t) {
      const Eigen::VectorXd z = white.col(t);
      check.input(stepped(t), {{"z of rng.normalVector", z}, {"L", policy.L}});
    });
  }
  const Eigen::MatrixXd actions = rowOf(task.actions);
  const auto mistake =
      check.ask(questionAbout(actions, 1e-9,
                              {{"Is the noise subtracted? a = phi^T (beta + epsilon).", opposite},
                               {"Is beta left out of the action?", noisy - plain}}));
  columnsAgree(check, "action that runTrial passes to step", actions, noisy, [&](Eigen::Index t) {
    const Eigen::VectorXd phi = seen.col(t), epsilon = trial.noise.col(t);
    check.input(stepped(t), {{"phi", phi}, {"beta", policy.beta}, {"epsilon", epsilon}});
  });
}

inline void trialFits(rex::grading::Check& check, Student& student, int k, int horizon, int failsAfter) {
  rex::Rng& rng = check.rng();
  const Policy policy{someNumbers(rng, k), Eigen::MatrixXd::Identity(k, k) + .5 * someNumbers(rng, k, k)};
  TrialTask task{.3 * someNumbers(rng, k, k), someNumbers(rng, k), failsAfter};
  const std::string text = failsAfter <= horizon ? fmt::format("a trial that fails in step {}", failsAfter)
                                                 : "a trial without a failure";
  check.input(text, {{"horizon", horizon}, {"start", task.start}, {"beta", policy.beta}, {"L", policy.L}});
  const rex::remote::SplitRng given = check.split(7);
  const Rollout trial =
      student.runTrial([&](const Eigen::VectorXd& state, double action) { return task.step(state, action); },
                       task.start, policy, horizon, given);
  trialEnds(check, trial, task, horizon);
  const auto stepped = [&](Eigen::Index t) { return fmt::format("{}, step {}", text, t + 1); };
  const Eigen::MatrixXd seen = statesFit(check, trial, task, stepped), rewards = rowOf(task.rewards);
  columnsAgree(check, "rewards of runTrial", trial.rewards.transpose(), rewards, [&](Eigen::Index t) {
    check.input(stepped(t), {{"reward of step()", rewards(t)}});
  });
  actionsFit(check, policy, trial, task, seen, given, stepped);
}
