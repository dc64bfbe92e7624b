#pragma once

#include <optional>
#include <vector>

#include "base/rng.h"
#include "learning/mdp.h"

namespace rex {

/// What is believed of a decision process before anything is seen, of each pair (s, a) alike: its next state
/// is distributed as Dirichlet, its mean reward as normal.
struct ModelPrior {
  double visits = 1;  ///< weight of the prior, shared by all states as the next one
  double rewardMean = 0, rewardDeviation = 1;
  double rewardNoise = 1;  ///< standard deviation of rewards around their mean
};

/// What was seen of a decision process: how often each action led where, and what it paid (9:6 to 9:8).
class LearnedModel {
 public:
  /// Throws Error unless both are positive.
  LearnedModel(int states, int actions);

  /// Action a in s paid `reward` and led to `next`, or ended the process. Throws Error for unknown states and
  /// actions, and a reward that is not finite.
  void observe(int s, int a, double reward, std::optional<int> next);
  [[nodiscard]] int visits(int s, int a) const;

  /// The process that makes what was seen most likely: frequencies, and mean rewards. Pairs (s, a) that were
  /// never tried stay where they are and pay nothing.
  [[nodiscard]] Mdp mostLikely(double discount) const;
  /// The same, except that each pair tried less than `known` times pays `maxReward` for ever: the model of
  /// R-max, by which exploring is worth while until enough is known. Throws Error unless `known` is positive.
  [[nodiscard]] Mdp optimistic(double discount, int known, double maxReward) const;
  /// A process drawn from the posterior: Dirichlet for the next states, normal for the mean rewards. Where a
  /// process was seen to end, it ends. Throws Error unless all numbers of the prior but its mean are
  /// positive.
  [[nodiscard]] Mdp sampled(double discount, const ModelPrior& prior, Rng& rng) const;

 private:
  Mdp modelWith(double discount, int known, double unknownReward) const;

  std::vector<Eigen::MatrixXd> counts_;  // of each action: from, to
  Eigen::MatrixXd tried_, paid_;
  std::vector<bool> terminal_;
};

struct PosteriorSamplingOptions {
  ModelPrior prior{};
  int episodes = 200;
  int maxSteps = 200;
  Eigen::VectorXd start{};  ///< a distribution over states; empty: uniform
};

struct PosteriorSamplingResult {
  Eigen::MatrixXd Q{};            ///< of the last process drawn
  LearnedModel model;             ///< from all steps
  std::vector<double> returns{};  ///< discounted, of each episode
};

/// Posterior sampling, PSRL (Strens 2000; Osband, Russo and Van Roy 2013): draws a process from the posterior
/// before each episode, and acts best by it until the episode ends. What is not known well varies from draw
/// to draw, and so is explored: Thompson's rule for bandits, of whole processes. Throws Error like
/// valueIteration, and for options out of range.
[[nodiscard]] PosteriorSamplingResult posteriorSampling(const Mdp& mdp,
                                                        const PosteriorSamplingOptions& options, Rng& rng);

struct RMaxOptions {
  int known = 10;        ///< a pair (s, a) is believed after so many visits
  double maxReward = 1;  ///< no reward is larger
  int episodes = 200;
  int maxSteps = 200;
  Eigen::VectorXd start{};  ///< a distribution over states; empty: uniform
};

struct RMaxResult {
  Eigen::MatrixXd Q{};            ///< of the last optimistic model
  LearnedModel model;             ///< from all steps
  std::vector<double> returns{};  ///< discounted, of each episode
  int unknown = 0;                ///< pairs that are still not known
};

/// R-max (Brafman and Tennenholtz 2002): always acts best by the optimistic model. It explores with a plan,
/// and not by chance. Throws Error like valueIteration, and for options out of range.
[[nodiscard]] RMaxResult rMax(const Mdp& mdp, const RMaxOptions& options, Rng& rng);

}  // namespace rex
