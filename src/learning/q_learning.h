#pragma once

#include <vector>

#include "base/rng.h"
#include "learning/mdp.h"

namespace rex {

/// Episodes start in each state with equal probability, so that all are seen, unless `start` is given.
struct TabularOptions {
  int episodes = 2000;
  int maxSteps = 200;   ///< an episode is truncated after so many, which is not a terminal state
  double epsilon = .1;  ///< how often a random action is tried
  double stepExponent =
      .7;  ///< the n-th visit of (s, a) changes Q by n^-stepExponent of its error; in (.5, 1]
  Eigen::VectorXd start{};  ///< a distribution over states; empty: uniform
};

/// Estimates from samples; `visits` says how often each was updated.
struct TabularResult {
  Eigen::MatrixXd Q{};            ///< states x actions, 0 if never tried
  Eigen::MatrixXi visits{};       ///< how often each was tried
  std::vector<double> returns{};  ///< discounted, of each episode
  int untried = 0;                ///< pairs (s, a) that were never visited
};

/// Q-learning (Watkins 1989): Q(s, a) moves towards r + discount max Q(s', .), whatever is done next. Acts
/// epsilon-greedily. Throws Error like requireMdp, and for options out of range.
[[nodiscard]] TabularResult qLearning(const Mdp& mdp, const TabularOptions& options, Rng& rng);

/// SARSA: Q(s, a) moves towards r + discount Q(s', a') for the action a' that is taken. Learns the values
/// of acting epsilon-greedily. Throws like qLearning.
[[nodiscard]] TabularResult sarsa(const Mdp& mdp, const TabularOptions& options, Rng& rng);

}  // namespace rex
