#pragma once

#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "interface.h"
#include "learning/policy_search.h"
#include "mistakes.h"
#include "process_checks.h"

// Parts 6 and 7: what is learned from trials.

inline std::vector<rex::Episode> episodesOf(const std::vector<Rollout>& trials) {
  std::vector<rex::Episode> episodes;
  for (const Rollout& trial : trials) episodes.push_back({trial.features, trial.noise, trial.rewards});
  return episodes;
}

inline rex::LinearGaussianPolicy asLibrary(const Policy& policy) {
  return {policy.beta, policy.L * policy.L.transpose()};
}

/// A policy and trials of random numbers with two digits, of different lengths; rewards are positive.
struct Practice {
  Policy policy;
  std::vector<Rollout> trials;
  double discount;
};

inline Practice randomPractice(rex::Rng& rng, int k, int count) {
  Practice made{{someNumbers(rng, k), .3 * someNumbers(rng, k, k)}, {}, twoDigits(rng.uniform(.7, .95))};
  for (int i = 0; i < k; ++i) {
    made.policy.L(i, i) = twoDigits(rng.uniform(.3, .8));
    for (int j = i + 1; j < k; ++j) made.policy.L(i, j) = 0;
  }
  for (int i = 0; i < count; ++i) {
    const int T = k + 1 + i % 3;
    Rollout trial{someNumbers(rng, k, T), .5 * someNumbers(rng, k, T), Eigen::VectorXd(T)};
    for (int t = 0; t < T; ++t) {
      auto phi = trial.features.col(t);
      phi[t % k] += 2;  // so that they are well apart
      while (phi.norm() < .1) phi = someNumbers(rng, k);
      trial.rewards[t] = twoDigits(rng.uniform(.1, 2));
    }
    made.trials.push_back(trial);
  }
  return made;
}

inline void describe(rex::grading::Check& check, const Practice& given) {
  const Rollout& trial = given.trials.front();
  const std::string text = given.trials.size() == 1
                               ? "one trial"
                               : fmt::format("{} trials, the first of which has", given.trials.size());
  check.input(text, {{"features", trial.features},
                     {"noise", trial.noise},
                     {"rewards", trial.rewards},
                     {"discount", given.discount},
                     {"beta", given.policy.beta},
                     {"L", given.policy.L}});
}

inline std::vector<Mistake> mistakenReturns(const Eigen::VectorXd& rewards, double discount) {
  const Eigen::VectorXd wanted = rex::returnsToGo(rewards, discount);
  const Eigen::Index T = rewards.size();
  Eigen::VectorXd faded = wanted, later = Eigen::VectorXd::Zero(T), past = rewards, sums = rewards;
  for (Eigen::Index t = 0; t < T; ++t) faded[t] *= std::pow(discount, t);
  for (Eigen::Index t = 0; t + 1 < T; ++t) later[t] = wanted[t + 1];
  for (Eigen::Index t = 1; t < T; ++t) {
    past[t] += discount * past[t - 1];
    sums[t] = sums[t - 1] + std::pow(discount, t) * rewards[t];
  }
  const char* const own = "Is the reward of the step itself left out?";
  const char* const before = "Are the rewards before the step summed up? The return counts those from it on.";
  return {{own, later},
          {own, discount * later},
          {"Is the reward of the step itself discounted, too?", discount * wanted},
          {before, past},
          {before, sums}};
}

inline void returnsFit(rex::grading::Check& check, Student& student, int T) {
  rex::Rng& rng = check.rng();
  const Eigen::VectorXd rewards = someNumbers(rng, T);
  const double discount = twoDigits(rng.uniform(.3, .95));
  check.input(fmt::format("{} steps", T), {{"rewards", rewards}, {"discount", discount}});
  const Eigen::VectorXd got = student.returnsToGo(rewards, discount),
                        wanted = rex::returnsToGo(rewards, discount);
  const auto shown =
      check.show([&] { return barsSeen("Returns to go of returnsToGo", "step", got, wanted); });
  check.near("returns to go of returnsToGo", got, wanted, 1e-9, mistakenReturns(rewards, discount));
}

/// What counts in a step.
struct StepOfTrial {
  double Q, Q0, reward;  ///< return to go, return of the trial, reward
  double faded;          ///< discount^t
  double moved, mean;    ///< phi^T epsilon, phi^T beta
  double variance;       ///< phi^T Sigma phi
  double mistaken;       ///< |L phi|^2
  Eigen::VectorXd phi, noise;
};
using WeightOfStep = double (*)(const StepOfTrial&);

inline std::vector<StepOfTrial> stepsOf(const Practice& given) {
  std::vector<StepOfTrial> steps;
  const Eigen::MatrixXd turned = given.policy.L.transpose();
  for (const Rollout& trial : given.trials) {
    const Eigen::VectorXd Q = rex::returnsToGo(trial.rewards, given.discount);
    for (Eigen::Index t = 0; t < trial.rewards.size(); ++t) {
      const Eigen::VectorXd phi = trial.features.col(t), noise = trial.noise.col(t), right = turned * phi,
                            wrong = given.policy.L * phi;
      steps.push_back({.Q = Q[t],
                       .Q0 = Q[0],
                       .reward = trial.rewards[t],
                       .faded = std::pow(given.discount, t),
                       .moved = phi.dot(noise),
                       .mean = phi.dot(given.policy.beta),
                       .variance = right.dot(right),
                       .mistaken = wrong.dot(wrong),
                       .phi = phi,
                       .noise = noise});
    }
  }
  return steps;
}

/// The mean over trials of the sum of weighted features.
inline Eigen::VectorXd gradientBy(const Practice& given, WeightOfStep weight) {
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(given.policy.beta.size());
  for (const StepOfTrial& step : stepsOf(given)) sum += weight(step) * step.phi;
  return sum / static_cast<double>(given.trials.size());
}

inline std::vector<Mistake> mistakenGradients(const Practice& given, const Eigen::VectorXd& wanted) {
  using S = StepOfTrial;
  const std::vector<S> steps = stepsOf(given);
  const double trials = static_cast<double>(given.trials.size()),
               perStep = trials / static_cast<double>(steps.size());
  Eigen::VectorXd noise = Eigen::VectorXd::Zero(wanted.size());
  for (const S& step : steps) noise += step.faded * step.Q / trials * step.noise;
  const char* const whole = "Does the return of the whole trial count in each step? It is that from t on.";
  return {{"Is it divided by the standard deviation? The density has the variance, phi^T Sigma phi.",
           gradientBy(given, [](const S& s) { return s.faded * s.Q * s.moved / std::sqrt(s.variance); })},
          {whole, gradientBy(given, [](const S& s) { return s.faded * s.Q0 * s.moved / s.variance; })},
          {whole, gradientBy(given, [](const S& s) { return s.Q0 * s.moved / s.variance; })},
          {"Is it the action itself? It is its distance from the mean, phi^T epsilon.",
           gradientBy(given, [](const S& s) { return s.faded * s.Q * (s.mean + s.moved) / s.variance; })},
          {"Is it the mean over the steps? It is that over the trials.", perStep * wanted}};
}

/// An arrow in the plane, from `from`, or bars if there are not two numbers.
inline rex::grading::Evidence arrowsSeen(const std::string& title, const Eigen::VectorXd& from,
                                         const Eigen::VectorXd& got, const Eigen::VectorXd& wanted) {
  if (got.size() != 2 || wanted.size() != 2) return barsSeen(title, "entry of beta", got, wanted);
  const auto arrow = [&](const Eigen::VectorXd& to, rex::Series look) {
    look.style = rex::SeriesStyle::kLinesPoints;
    return rex::through(std::vector<Eigen::VectorXd>{from, to}, look);
  };
  const Eigen::VectorXd low = from.cwiseMin(got).cwiseMin(wanted), high = from.cwiseMax(got).cwiseMax(wanted);
  const double reach = .55 * (high - low).maxCoeff() + 1e-9;
  const auto range = [&](Eigen::Index i) {
    const double middle = (low[i] + high[i]) / 2;
    return rex::AxisRange(middle - reach, middle + reach);
  };
  return {.figures = {{.title = title,
                       .xLabel = "beta_1",
                       .yLabel = "beta_2",
                       .equalAxes = true,
                       .xRange = range(0),
                       .yRange = range(1),
                       .legend = rex::Legend::kOutside,
                       .series = {arrow(got, rex::grading::gotCurve("got")),
                                  arrow(wanted, rex::grading::wantedCurve("wanted"))}}}};
}

inline void gradientFits(rex::grading::Check& check, Student& student, int k, int count) {
  const Practice given = randomPractice(check.rng(), k, count);
  describe(check, given);
  const Eigen::VectorXd wanted = rex::reinforceGradient(asLibrary(given.policy), episodesOf(given.trials),
                                                        given.discount, rex::Baseline::kNone)
                                     .gradient;
  const Eigen::VectorXd got = student.reinforce(given.policy, given.trials, given.discount);
  const auto shown =
      check.show([&] { return arrowsSeen("Gradient of reinforce", Eigen::VectorXd::Zero(2), got, wanted); });
  const double tolerance = 1e-9 * (1 + wanted.norm());
  check.near("gradient of reinforce", got, wanted, tolerance, mistakenGradients(given, wanted));
}

/// beta plus the quotient of both sums of PoWER, whose terms have these weights. Without W, the identity is
/// in its place.
inline Eigen::VectorXd powerBy(const Practice& given, WeightOfStep weight, bool withW = true) {
  const Eigen::Index k = given.policy.beta.size();
  Eigen::MatrixXd left = Eigen::MatrixXd::Zero(k, k), W = Eigen::MatrixXd::Identity(k, k);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(k);
  for (const StepOfTrial& step : stepsOf(given)) {
    if (withW) W = step.phi * step.phi.transpose();
    const Eigen::VectorXd move = W * step.noise;
    left += weight(step) * W;
    right += weight(step) * move;
  }
  return given.policy.beta + rex::solveMatrix(left, right);
}

inline std::vector<Mistake> mistakenPowers(const Practice& given, const Eigen::VectorXd& wanted) {
  using S = StepOfTrial;
  return {
      {"Is the change subtracted from the old beta?", 2 * given.policy.beta - wanted},
      {"Is the variance in W |L phi|^2? It is phi^T Sigma phi = |L^T phi|^2.",
       powerBy(given, [](const S& s) { return s.Q / s.mistaken; })},
      {"Is W divided by the standard deviation? It is divided by the variance, phi^T Sigma phi.",
       powerBy(given, [](const S& s) { return s.Q / std::sqrt(s.variance); })},
      {"Are the returns left out of the sums?", powerBy(given, [](const S& s) { return 1 / s.variance; })},
      {"Is Q_t multiplied by discount^t, as in REINFORCE? PoWER does without.",
       powerBy(given, [](const S& s) { return s.faded * s.Q / s.variance; })}};
}

inline void powerFits(rex::grading::Check& check, Student& student, int k, int count) {
  const Practice given = randomPractice(check.rng(), k, count);
  describe(check, given);
  const Eigen::VectorXd got = student.power(given.policy, given.trials, given.discount),
                        wanted =
                            rex::powerStep(asLibrary(given.policy), episodesOf(given.trials), given.discount)
                                .beta;
  const auto shown = check.show([&] {
    return arrowsSeen("From the old beta to the new one of power", given.policy.beta, got, wanted);
  });
  check.near("new beta of power", got, wanted, 1e-8, mistakenPowers(given, wanted));
}
