#pragma once

#include <functional>
#include <vector>

#include <Eigen/Core>

#include "base/require.h"
#include "base/rng.h"

namespace rex {

/// An action a = phi(s)^T (beta + epsilon) with epsilon ~ N(0, Sigma), drawn again in each step (slides 9:16
/// and 9:17). In other words a ~ N(phi^T beta, phi^T Sigma phi). If only a constant feature has noise, it
/// is added to the action.
struct LinearGaussianPolicy {
  Eigen::VectorXd beta{};   ///< k
  Eigen::MatrixXd Sigma{};  ///< k x k, a covariance
};

/// Throws Error for sizes that do not fit, numbers that are not finite, and a Sigma that is not a
/// covariance.
void requirePolicy(const LinearGaussianPolicy& policy);
/// A root L of Sigma: epsilon is L times standard normal numbers. Throws like requirePolicy.
[[nodiscard]] Eigen::MatrixXd noiseRoot(const LinearGaussianPolicy& policy);

/// phi^T Sigma phi, the variance of the action; zero if it is not more than rounding. phi has size k.
[[nodiscard]] double actionVariance(const LinearGaussianPolicy& policy, const VectorArg& phi);

/// The data of one episode of T steps. It may be shorter than others if it ended with a failure.
struct Episode {
  Eigen::MatrixXd features{};  ///< k x T: phi(s_t)
  Eigen::MatrixXd noise{};     ///< k x T: epsilon_t
  Eigen::VectorXd rewards{};   ///< T
};

/// Throws Error naming the episode for sizes that do not fit and numbers that are not finite, and if there
/// is no episode.
void requireEpisodes(const std::vector<Episode>& episodes, Eigen::Index features);
/// The same for all inputs of a policy search; the discount must be in [0, 1].
void requireTrials(const LinearGaussianPolicy& policy, const std::vector<Episode>& episodes, double discount);

/// Runs `count` episodes of a policy. This is the interface to all simulators, which may run them in
/// parallel.
using RolloutSource =
    std::function<std::vector<Episode>(const LinearGaussianPolicy& policy, int count, Rng& rng)>;

/// sum_{t' >= t} discount^(t' - t) r_t' for each t: Q(s_t, a_t, t) of slide 9:17, estimated from one
/// episode.
[[nodiscard]] Eigen::VectorXd returnsToGo(const VectorArg& rewards, double discount);

/// The mean discounted return of episodes. Throws like requireEpisodes.
[[nodiscard]] double meanReturn(const std::vector<Episode>& episodes, double discount);

/// A task with one scalar action per step, for simulators that run one episode at a time.
struct ControlTask {
  struct Outcome {
    Eigen::VectorXd next{};
    double reward = 0;
    bool failed = false;  ///< the episode ends here, and this is its last reward
  };
  std::function<Eigen::VectorXd(Rng& rng)> start{};
  std::function<Eigen::VectorXd(const Eigen::VectorXd& state)> features{};
  std::function<Outcome(const Eigen::VectorXd& state, double action, Rng& rng)> step{};
  int horizon = 100;
};
/// Rollouts of a task. Throws Error for missing functions and a horizon that is not positive; the rollouts
/// throw like requirePolicy, and for the wrong number of features.
[[nodiscard]] RolloutSource rolloutSource(ControlTask task);

}  // namespace rex
