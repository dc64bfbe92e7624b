#pragma once

#include <optional>
#include <vector>

#include "base/rng.h"
#include "learning/mdp.h"

namespace rex {

/// A step that was taken: what it paid, and where it led. Nothing follows a terminal state: no `next`.
struct TabularStep {
  int s = 0, a = 0;
  double reward = 0;
  std::optional<int> next{};
};
/// Moves Q(s, a) by `size` of its error: towards reward + discount max Q(next, .), or Q(next, nextAction) if
/// that is given. The indices must be those of Q.
void learnFrom(Eigen::MatrixXd& Q, const TabularStep& step, std::optional<int> nextAction, double size,
               double discount);

/// Episodes start in each state with equal probability, so that all are seen, unless `start` is given.
struct TabularOptions {
  int episodes = 2000;
  int maxSteps = 200;   ///< an episode is truncated after so many, which is not a terminal state
  double epsilon = .1;  ///< how often a random action is tried
  double stepExponent =
      .7;                 ///< the n-th visit of (s, a) changes Q by n^-stepExponent of its error; in (.5, 1]
  double stepSize = 0;    ///< of every visit, in (0, 1]; 0: by stepExponent
  int planningSteps = 0;  ///< of Dyna: updates from remembered steps after each real one, of qLearning only
  Eigen::VectorXd start{};  ///< a distribution over states; empty: uniform
};

/// Estimates from samples; `visits` says how often each was updated.
struct TabularResult {
  Eigen::MatrixXd Q{};            ///< states x actions, 0 if never tried
  Eigen::MatrixXi visits{};       ///< how often each was tried
  std::vector<double> returns{};  ///< discounted, of each episode
  std::vector<int> steps{};       ///< of each episode, until it entered its terminal state or was cut
  int untried = 0;                ///< pairs (s, a) that were never visited
};

/// Q-learning (Watkins 1989): Q(s, a) moves towards r + discount max Q(s', .), whatever is done next. Acts
/// epsilon-greedily, and draws among actions that are equally good. With planning steps it is Dyna-Q (Sutton
/// 1990): each repeats a remembered step of a pair (s, a), drawn from all pairs tried. Throws Error like
/// requireMdp, and for options out of range.
[[nodiscard]] TabularResult qLearning(const Mdp& mdp, const TabularOptions& options, Rng& rng);

/// SARSA: Q(s, a) moves towards r + discount Q(s', a') for the action a' that is taken. Learns the values
/// of acting epsilon-greedily. Throws like qLearning,
/// and if planning steps are asked for.
[[nodiscard]] TabularResult sarsa(const Mdp& mdp, const TabularOptions& options, Rng& rng);

}  // namespace rex
