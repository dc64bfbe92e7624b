#pragma once

#include <string>
#include <vector>

#include "control/racer_rollouts.h"
#include "course/mdp_figures.h"
#include "exercise.h"

// What main() learns from, and how it draws what was learnt.

/// A start at rest for a ride.
inline Eigen::Vector4d tilted(double theta) { return {0, theta, 0, 0}; }

/// The library's rollouts of policies on all features: main() alone may call them.
using Library = std::function<rex::Rollouts(const Eigen::MatrixXd& W, const std::vector<rex::Trial>& trials,
                                            const rex::RacerRolloutOptions& options)>;

inline rex::RacerRolloutOptions withNoise(double noise, int steps) {
  return {.features = {.rates = true, .averages = true, .averagedRates = true, .controls = true},
          .steps = steps,
          .noise = noise};
}

/// Rides in the simulator of the library, which runs eight at once.
inline Rides ridesOf(const Library& library, rex::Rng& rng) {
  return [&](const Eigen::MatrixXd& W, int steps) {
    const std::vector<rex::Trial> trial{{tilted(rng.uniform(-.2, .2)), rng.next()}};
    return Eigen::VectorXd(library(W, trial, withNoise(kNoise, steps)).cost.row(0).transpose());
  };
}

/// Rides in your simulator.
inline Rides ridesOfYours(rex::Rng& rng) {
  return [&rng](const Eigen::MatrixXd& W, int steps) {
    const Eigen::Vector4d start = tilted(rng.uniform(-.2, .2));
    const Eigen::MatrixXd noise = kicks(steps, kTau, kNoise, rng);
    Eigen::VectorXd costs(W.cols());
    for (Eigen::Index i = 0; i < W.cols(); ++i) costs[i] = rideOf(W.col(i), start, noise, {}, {}).cost;
    return costs;
  };
}

/// What became of a search.
struct Lesson {
  Eigen::VectorXd policy;
  Eigen::VectorXd halfTaught;      ///< the best of one call after the first thousand rides
  std::vector<double> costs = {};  ///< per step, of each ride
};

inline Lesson learnt(const Rides& rides, std::uint64_t seed) {
  rex::Rng rng(seed);
  Lesson lesson{Eigen::VectorXd::Zero(kFeatures), Eigen::VectorXd::Zero(kFeatures)};
  const Rides recorded = [&](const Eigen::MatrixXd& W, int steps) {
    const Eigen::VectorXd costs = rides(W, steps);
    int cheapest = 0;
    costs.minCoeff(&cheapest);
    if (lesson.costs.size() < 1000) lesson.halfTaught = W.col(cheapest);
    for (const double cost : costs) lesson.costs.push_back(cost / steps);
    return costs;
  };
  lesson.policy = searchedPolicy(recorded, kBudget, rng);
  return lesson;
}

/// Means of 50 equal shares of the rides.
inline std::vector<double> curveOf(const Lesson& lesson) {
  constexpr std::size_t kShares = 50;
  const std::size_t count = lesson.costs.size();
  std::vector<double> curve(kShares, 0);
  for (std::size_t k = 0; k < kShares; ++k) {
    const std::size_t begin = k * count / kShares, end = (k + 1) * count / kShares;
    for (std::size_t i = begin; i < end; ++i) curve[k] += lesson.costs[i] / static_cast<double>(end - begin);
  }
  return curve;
}

/// Which of 200 rides with that noise last all of 500 steps, as a share: of a policy.
inline double shareThatLasts(const Library& library, const Eigen::VectorXd& w, double noise) {
  std::vector<rex::Trial> trials;
  for (std::uint64_t seed = 0; seed < 200; ++seed) trials.push_back({tilted(seed % 2 == 0 ? .2 : -.2), seed});
  const rex::Rollouts rollouts = library(w, trials, withNoise(noise, kLongestRide));
  return (rollouts.steps.array() == kLongestRide).cast<double>().mean();
}
