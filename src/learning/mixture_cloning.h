#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "base/require.h"
#include "base/rng.h"
#include "learning/behavioural_cloning.h"

namespace rex {

/// One expert of a mixture: where it is used, and what it does there. With x ~ N(meanState,
/// stateCovariance), actions are a ~ N(meanAction + gain (x - meanState), actionCovariance).
struct MixtureExpert {
  double weight = 1;                   ///< the share of demonstrations that are its own
  Eigen::VectorXd meanState{};         ///< d
  Eigen::MatrixXd stateCovariance{};   ///< d x d
  Eigen::VectorXd meanAction{};        ///< m
  Eigen::MatrixXd gain{};              ///< m x d
  Eigen::MatrixXd actionCovariance{};  ///< m x m

  /// The mean of its actions in a state.
  [[nodiscard]] Eigen::VectorXd action(const VectorArg& state) const;
};

/// A policy with several answers to one state; their mean need not be an answer.
struct MixturePolicy {
  std::vector<MixtureExpert> experts{};

  /// P(expert | state), one for each. Throws Error for a state of the wrong size.
  [[nodiscard]] Eigen::VectorXd probabilities(const VectorArg& state) const;
  /// The previous expert while it is likely, with P(previous | state) >= .1, so that what was begun is
  /// carried through; otherwise one drawn from probabilities(). Throws Error for an expert that is not there.
  [[nodiscard]] int expertFor(const VectorArg& state, std::optional<int> previous, Rng& rng) const;
};

struct MixtureCloneOptions {
  int experts = 2;
  int starts = 5;  ///< the best of so many runs from random centres
  int maxIterations = 500;
  double tolerance = 1e-8;  ///< of the rise of the likelihood per demonstration at which a run has converged
  double regularisation = 1e-6;  ///< of covariances, in variances of the demonstrations
};

struct MixtureClone {
  CloneStatus status = CloneStatus::kNotConverged;
  MixturePolicy policy{};
  double logLikelihood = -std::numeric_limits<double>::infinity();  ///< of all states and actions
  /// What each iteration raises: logLikelihood less the penalty by which covariances stay regular.
  std::vector<double> history{};
  std::string message{};
};

/// Imitates demonstrations of several kinds that go through the same states, such as left and right around
/// an obstacle (slides 9:9 to 9:11): a mixture of normal distributions over states and actions together, by
/// expectation maximisation, then each conditioned on the state (Ghahramani and Jordan 1994). States are n x
/// d, actions n x m, one demonstration per row. Throws Error for sizes that do not fit, numbers that are not
/// finite, fewer demonstrations than experts, a coordinate that never changes, and options out of range.
[[nodiscard]] MixtureClone cloneMixture(const MatrixArg& states, const MatrixArg& actions, Rng& rng,
                                        const MixtureCloneOptions& options = {});

}  // namespace rex
