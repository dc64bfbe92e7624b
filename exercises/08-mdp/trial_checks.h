#pragma once

#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "grading/check.h"
#include "interface.h"
#include "learning/policy_gradient.h"
#include "learning/power.h"
#include "value_evidence.h"

// Parts 5 to 7: a linear task with quadratic costs, whose gradient is known, and what must hold for trials
// and for what is learned from them.

struct LinearTask {
  Eigen::Matrix2d A, Q;
  Eigen::Vector2d B, start;
  double R = 0, discount = 1;
  int horizon = 12;
};

inline LinearTask randomTask(rex::Rng& rng) {
  LinearTask task;
  task.A << 1, .2, rng.uniform(-.2, .1), rng.uniform(.8, 1);
  task.B << .05, rng.uniform(.2, .4);
  task.Q = Eigen::Vector2d(rng.uniform(.5, 2), rng.uniform(.1, .5)).asDiagonal();
  task.R = rng.uniform(.05, .2);
  task.start = Eigen::Vector2d(1, rng.uniform(-.5, .5));
  task.discount = rng.uniform(.85, .95);
  return task;
}

inline Policy randomPolicy(rex::Rng& rng) {
  Policy policy{Eigen::Vector2d(rng.uniform(-1, 0), rng.uniform(-.8, 0)), Eigen::Matrix2d::Zero()};
  policy.L << rng.uniform(.3, .5), 0, rng.uniform(-.2, .2), rng.uniform(.3, .5);
  return policy;
}

inline std::vector<Rollout> trialsOf(const LinearTask& task, const Policy& policy, int count, rex::Rng& rng,
                                     double bonus = 0) {
  std::vector<Rollout> trials;
  for (int i = 0; i < count; ++i) {
    const int T = task.horizon - i % 2;  // some are shorter
    Rollout trial{Eigen::MatrixXd(2, T), Eigen::MatrixXd(2, T), Eigen::VectorXd(T)};
    Eigen::Vector2d x = task.start;
    for (int t = 0; t < T; ++t) {
      trial.features.col(t) = x;
      trial.noise.col(t) = policy.L * rng.normalVector(2);
      const double a = x.dot(policy.beta + trial.noise.col(t));
      trial.rewards[t] = bonus - x.dot(task.Q * x) - task.R * a * a;
      x = task.A * x + task.B * a;
    }
    trials.push_back(trial);
  }
  return trials;
}

/// The gradient of the expected return of `horizon` steps, by the adjoint of the second moments of the state.
inline Eigen::Vector2d exactGradient(const LinearTask& task, const Policy& policy, int horizon) {
  const Eigen::Matrix2d closed = task.A + task.B * policy.beta.transpose();
  const Eigen::Matrix2d Sigma = policy.L * policy.L.transpose();
  std::vector<Eigen::Matrix2d> X{task.start * task.start.transpose()};
  for (int t = 1; t < horizon; ++t)
    X.push_back(closed * X.back() * closed.transpose() +
                task.B * task.B.transpose() * (Sigma * X.back()).trace());
  Eigen::Matrix2d P = Eigen::Matrix2d::Zero();
  Eigen::Vector2d gradient = Eigen::Vector2d::Zero();
  for (int t = horizon - 1; t >= 0; --t) {
    const Eigen::Matrix2d& now = X[static_cast<std::size_t>(t)];
    gradient -= 2 * std::pow(task.discount, t) * now *
                (task.R * policy.beta + task.discount * closed.transpose() * P * task.B);
    P = task.Q + task.R * (policy.beta * policy.beta.transpose() + Sigma) +
        task.discount * (closed.transpose() * P * closed + Sigma * task.B.dot(P * task.B));
  }
  return gradient;
}

inline std::vector<rex::Episode> episodesOf(const std::vector<Rollout>& trials) {
  std::vector<rex::Episode> episodes;
  for (const Rollout& trial : trials) episodes.push_back({trial.features, trial.noise, trial.rewards});
  return episodes;
}

inline rex::LinearGaussianPolicy asLibrary(const Policy& policy) {
  return {policy.beta, policy.L * policy.L.transpose()};
}

/// Checks that the trial records what the step function saw, and stops when it should.
inline void trialFits(rex::grading::Check& check, Student& student, int k, int horizon, int failsAfter) {
  rex::Rng& rng = check.rng();
  const Policy policy{rng.normalVector(k),
                      Eigen::MatrixXd::Identity(k, k) + .3 * rng.normalVector(k * k).reshaped(k, k)};
  check.input(fmt::format("{} features, horizon {}, failure in step {}", k, horizon, failsAfter));
  const Eigen::MatrixXd A = rng.normalVector(k * k).reshaped(k, k) / (2 * std::sqrt(k));
  std::vector<Eigen::VectorXd> states;
  std::vector<double> actions, rewards;
  const StepFunction step = [&](const Eigen::VectorXd& state, double action) {
    states.push_back(state);
    actions.push_back(action);
    rewards.push_back(.1 * action + static_cast<double>(states.size()));
    Eigen::VectorXd next = A * state;
    next[0] += .5 + .1 * std::tanh(action);
    return Transition{next, rewards.back(), static_cast<int>(states.size()) == failsAfter};
  };
  const Eigen::VectorXd start = rng.normalVector(k);
  rex::Rng given = rng.split(7);
  const Rollout trial = student.runTrial(step, start, policy, horizon, given);
  const int T = std::min(horizon, failsAfter);
  check.near("number of steps taken", static_cast<double>(states.size()), T, 0);
  check.shape("features of the trial", trial.features, k, T);
  check.shape("noise of the trial", trial.noise, k, T);
  check.shape("rewards of the trial", trial.rewards, T, 1);
  Eigen::VectorXd expected = start;
  Eigen::MatrixXd white(k, T);
  for (int t = 0; t < T; ++t) {
    const auto at = static_cast<std::size_t>(t);
    check.near("state in which the step was taken", states[at], expected, 1e-9);
    check.near("features of a step", trial.features.col(t), states[at], 1e-12);
    check.near("action of a step", actions[at], states[at].dot(policy.beta + trial.noise.col(t)), 1e-9);
    check.near("reward of a step", trial.rewards[t], rewards[at], 1e-12);
    expected = A * states[at];
    expected[0] += .5 + .1 * std::tanh(actions[at]);
  }
  rex::Rng same = rng.split(7);
  for (int t = 0; t < T; ++t) white.col(t) = same.normalVector(k);
  const Eigen::MatrixXd wanted = policy.L * white;
  const auto shown = check.show([&] {
    return rex::grading::Evidence{
        .figures = {rex::grading::comparison("Noise of the steps", trial.noise, wanted)}};
  });
  for (int t = 0; t < T; ++t) check.near("noise of a step", trial.noise.col(t), wanted.col(t), 1e-9);
}

inline void returnsFit(rex::grading::Check& check, Student& student, int T) {
  rex::Rng& rng = check.rng();
  const Eigen::VectorXd rewards = rng.normalVector(T);
  const double discount = rng.uniform(.3, 1);
  check.input(fmt::format("{} rewards, discount {:.3f}", T, discount));
  const Eigen::VectorXd got = student.returnsToGo(rewards, discount),
                        wanted = rex::returnsToGo(rewards, discount);
  const auto shown = check.show([&] { return barsSeen("Returns to go", "step", got, wanted); });
  check.near("returns to go", got, wanted, 1e-9);
}

inline void gradientFits(rex::grading::Check& check, Student& student, int count) {
  const LinearTask task = randomTask(check.rng());
  const Policy policy = randomPolicy(check.rng());
  check.input(fmt::format("{} trials, discount {:.3f}", count, task.discount));
  const std::vector<Rollout> trials = trialsOf(task, policy, count, check.rng());
  const Eigen::VectorXd exact =
      rex::reinforceGradient(asLibrary(policy), episodesOf(trials), task.discount, rex::Baseline::kNone)
          .gradient;
  const Eigen::VectorXd got = student.reinforce(policy, trials, task.discount);
  const auto shown = check.show([&] { return arrowsSeen("Gradient from these trials", {0, 0}, got, exact); });
  check.near("gradient from these trials", got, exact, 1e-9 * (1 + exact.norm()));
}

/// A task, a policy and trials of equal length that determine the gradient well: the standard error of
/// REINFORCE is below a 40th of the gradient's length, so that it exceeds the error that the cosine below
/// allows (a seventh) less than once in 10^7 times. The mean reward of each step is subtracted, which only
/// reduces the noise.
struct Lesson {
  LinearTask task;
  Policy policy;
  std::vector<Rollout> trials;
  Eigen::Vector2d exact;
};

inline Lesson tellingLesson(rex::Rng& rng) {
  for (;;) {
    Lesson lesson{randomTask(rng), randomPolicy(rng), {}, {}};
    lesson.task.horizon = 8;
    Eigen::VectorXd mean = Eigen::VectorXd::Zero(8);
    for (const Rollout& trial : trialsOf(lesson.task, lesson.policy, 20000, rng)) {
      if (trial.rewards.size() != 8) continue;
      lesson.trials.push_back(trial);
      mean += trial.rewards / 10000;
    }
    for (Rollout& trial : lesson.trials) trial.rewards -= mean;
    lesson.exact = exactGradient(lesson.task, lesson.policy, 8);
    const rex::PolicyGradient found = rex::reinforceGradient(
        asLibrary(lesson.policy), episodesOf(lesson.trials), lesson.task.discount, rex::Baseline::kNone);
    if (found.standardError.norm() < lesson.exact.norm() / 40) return lesson;
  }
}

inline void gradientIsTheTrueOne(rex::grading::Check& check, Student& student) {
  const Lesson lesson = tellingLesson(check.rng());
  check.input(fmt::format("{} trials of a linear task with quadratic costs", lesson.trials.size()));
  const Eigen::VectorXd found = student.reinforce(lesson.policy, lesson.trials, lesson.task.discount);
  check.shape("gradient", found, 2, 1);
  check.atLeast("cosine of the angle to the exact gradient",
                found.dot(lesson.exact) / found.norm() / lesson.exact.norm(), .99);
}

inline void powerFits(rex::grading::Check& check, Student& student, int count) {
  const LinearTask task = randomTask(check.rng());
  const Policy policy = randomPolicy(check.rng());
  check.input(fmt::format("{} trials, discount {:.3f}", count, task.discount));
  std::vector<Rollout> trials = trialsOf(task, policy, count, check.rng());
  // Positive rewards that differ between trials.
  for (Rollout& trial : trials) trial.rewards = (.2 * trial.rewards).array().exp();
  const Eigen::VectorXd got = student.power(policy, trials, task.discount),
                        wanted = rex::powerStep(asLibrary(policy), episodesOf(trials), task.discount).beta;
  const auto shown = check.show([&] {
    if (got.size() != 2) return rex::grading::Evidence{};
    return arrowsSeen("From the old parameters to the new ones", policy.beta, got - policy.beta,
                      wanted - policy.beta);
  });
  check.near("new parameters", got, wanted, 1e-8);
}
