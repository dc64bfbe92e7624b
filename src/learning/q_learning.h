#pragma once

#include <vector>

#include "base/rng.h"
#include "learning/mdp.h"

namespace rex {

/// Episodes start in any state with equal probability, so that all are seen, unless `start` says where.
struct TabularOptions {
  int episodes = 2000;
  int maxSteps = 200;   ///< an episode is cut after so many, which is not an end
  double epsilon = .1;  ///< how often any action is tried
  double stepExponent =
      .7;  ///< the n-th visit of (s, a) changes Q by n^-stepExponent of its error; in (.5, 1]
  Eigen::VectorXd start{};  ///< a distribution over states; empty: uniform
};

/// What sampling teaches is never certain: `visits` says how much of it was seen.
struct TabularResult {
  Eigen::MatrixXd Q{};            ///< states x actions, 0 where never tried
  Eigen::MatrixXi visits{};       ///< how often each was tried
  std::vector<double> returns{};  ///< discounted, of each episode
  int untried = 0;                ///< pairs (s, a) that were never visited
};

/// Watkins (1989): Q(s, a) moves towards r + discount max Q(s', .), whatever is done next. Acts
/// epsilon-greedily. Throws Error as requireMdp, and for options out of range.
[[nodiscard]] TabularResult qLearning(const Mdp& mdp, const TabularOptions& options, Rng& rng);

/// Towards r + discount Q(s', a') with the a' that is taken (SARSA): learns the values of acting
/// epsilon-greedily. Throws as qLearning.
[[nodiscard]] TabularResult sarsa(const Mdp& mdp, const TabularOptions& options, Rng& rng);

}  // namespace rex
