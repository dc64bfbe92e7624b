#pragma once

#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "gradient_checks.h"
#include "grading/check.h"

// A linear task with quadratic costs, whose gradient is known.

// All are MatrixXd, whose products are compiled once.
struct LinearTask {
  Eigen::MatrixXd A, B, Q, start;
  double R = 0, discount = 1;
  int horizon = 8;
};

inline LinearTask randomTask(rex::Rng& rng) {
  LinearTask task{Eigen::MatrixXd(2, 2), Eigen::MatrixXd(2, 1), Eigen::MatrixXd::Zero(2, 2),
                  Eigen::MatrixXd(2, 1)};
  task.A << 1, .2, rng.uniform(-.2, .1), rng.uniform(.8, 1);
  task.B << .05, rng.uniform(.2, .4);
  task.Q(0, 0) = rng.uniform(.5, 2);
  task.Q(1, 1) = rng.uniform(.1, .5);
  task.R = rng.uniform(.05, .2);
  task.start << 1, rng.uniform(-.5, .5);
  task.discount = rng.uniform(.85, .95);
  return task;
}

inline Policy randomPolicy(rex::Rng& rng) {
  Policy policy{Eigen::VectorXd(2), Eigen::MatrixXd(2, 2)};
  policy.beta << rng.uniform(-1, 0), rng.uniform(-.8, 0);
  policy.L << rng.uniform(.3, .5), 0, rng.uniform(-.2, .2), rng.uniform(.3, .5);
  return policy;
}

inline std::vector<Rollout> trialsOf(const LinearTask& task, const Policy& policy, int count, rex::Rng& rng) {
  std::vector<Rollout> trials;
  for (int i = 0; i < count; ++i) {
    Rollout trial{Eigen::MatrixXd(2, task.horizon), Eigen::MatrixXd(2, task.horizon),
                  Eigen::VectorXd(task.horizon)};
    Eigen::VectorXd x = task.start.col(0);
    for (int t = 0; t < task.horizon; ++t) {
      const Eigen::VectorXd epsilon = policy.L * rng.normalVector(2), cost = task.Q * x, still = task.A * x;
      trial.features.col(t) = x;
      trial.noise.col(t) = epsilon;
      const double a = x.dot(policy.beta) + x.dot(epsilon);
      trial.rewards[t] = -x.dot(cost) - task.R * a * a;
      x = still + a * task.B.col(0);
    }
    trials.push_back(trial);
  }
  return trials;
}

/// The gradient of the expected return, by the adjoint of the second moments of the state.
inline Eigen::VectorXd exactGradient(const LinearTask& task, const Policy& policy) {
  const auto product = [](const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) -> Eigen::MatrixXd {
    return a * b;
  };
  const auto turned = [](const Eigen::MatrixXd& a) -> Eigen::MatrixXd { return a.transpose(); };
  const Eigen::MatrixXd beta = policy.beta, Sigma = asLibrary(policy).Sigma,
                        ofBeta = product(beta, turned(beta)), ofB = product(task.B, turned(task.B));
  Eigen::MatrixXd closed = product(task.B, turned(beta));
  closed += task.A;
  std::vector<Eigen::MatrixXd> X{product(task.start, turned(task.start))};
  for (int t = 1; t < task.horizon; ++t) {
    const double noise = product(Sigma, X.back()).trace();
    X.push_back(product(product(closed, X.back()), turned(closed)));
    X.back() += noise * ofB;
  }
  Eigen::MatrixXd P = Eigen::MatrixXd::Zero(2, 2), gradient = Eigen::MatrixXd::Zero(2, 1);
  for (int t = task.horizon - 1; t >= 0; --t) {
    const Eigen::MatrixXd slope = product(turned(closed), product(P, task.B)),
                          now = X[static_cast<std::size_t>(t)],
                          ofAction = product(now, task.R * beta + task.discount * slope),
                          later = product(product(turned(closed), P), closed);
    const double noise = task.R + task.discount * product(turned(task.B), product(P, task.B))(0, 0);
    gradient -= 2 * std::pow(task.discount, t) * ofAction;
    P = task.Q + task.R * ofBeta + noise * Sigma + task.discount * later;
  }
  return gradient.col(0);
}

/// A task, a policy and trials of equal length that determine the gradient well: the standard error of
/// REINFORCE is below a 40th of the gradient's length, so that it exceeds the error that the cosine below
/// allows (a seventh) less than once in 10^7 times. The mean reward of each step is subtracted, which only
/// reduces the noise.
struct Lesson {
  LinearTask task;
  Policy policy;
  std::vector<Rollout> trials;
  Eigen::VectorXd exact;
};

inline Lesson tellingLesson(rex::Rng& rng) {
  for (;;) {
    Lesson lesson{randomTask(rng), randomPolicy(rng), {}, {}};
    Eigen::VectorXd mean = Eigen::VectorXd::Zero(8);
    for (const Rollout& trial : trialsOf(lesson.task, lesson.policy, 10000, rng)) {
      lesson.trials.push_back(trial);
      mean += trial.rewards / 10000;
    }
    for (Rollout& trial : lesson.trials) trial.rewards -= mean;
    lesson.exact = exactGradient(lesson.task, lesson.policy);
    const rex::PolicyGradient found = rex::reinforceGradient(
        asLibrary(lesson.policy), episodesOf(lesson.trials), lesson.task.discount, rex::Baseline::kNone);
    if (found.standardError.norm() < lesson.exact.norm() / 40) return lesson;
  }
}

inline void gradientIsTheTrueOne(rex::grading::Check& check, Student& student) {
  const Lesson lesson = tellingLesson(check.rng());
  check.input(fmt::format("{} trials of a linear task with quadratic costs", lesson.trials.size()));
  const Eigen::VectorXd found = student.reinforce(lesson.policy, lesson.trials, lesson.task.discount);
  check.shape("gradient of reinforce", found, 2, 1);
  check.atLeast("cosine of the angle from the gradient of reinforce, from 10000 trials, to the exact one",
                found.dot(lesson.exact) / found.norm() / lesson.exact.norm(), .99);
}
