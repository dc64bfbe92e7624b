#pragma once

#include <functional>
#include <limits>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "base/require.h"

namespace rex {

/// Imitates demonstrated actions (slides 9:9, 9:10) by regression on features of the states.
struct LinearClone {
  Eigen::MatrixXd weights{};                                  ///< k x m: action = weights^T phi
  double residual = std::numeric_limits<double>::infinity();  ///< root mean square error of the actions
  int rank = 0;  ///< if less than k without ridge, `weights` is the minimum-norm solution
};
/// Ridge regression: minimises the sum of squared errors + ridge |weights|^2. Features are n x k, actions n
/// x m, one demonstration per row. Throws Error without demonstrations, for sizes that do not fit, numbers
/// that are not finite, and a negative ridge.
[[nodiscard]] LinearClone cloneLinear(const MatrixArg& features, const MatrixArg& actions, double ridge = 0);

/// P(a | s) proportional to exp(weights_a^T phi).
struct SoftmaxPolicy {
  Eigen::MatrixXd weights{};  ///< k x actions
  /// One for each action. Throws Error for features of the wrong size.
  [[nodiscard]] Eigen::VectorXd probabilities(const VectorArg& phi) const;
};

enum class CloneStatus { kConverged, kNotConverged };

struct SoftmaxClone {
  CloneStatus status = CloneStatus::kNotConverged;
  SoftmaxPolicy policy{};
  double loss = std::numeric_limits<double>::infinity();
  double residual = std::numeric_limits<double>::infinity();  ///< largest entry of the gradient of the loss
  int iterations = 0;
  std::string message{};
};
/// Logistic regression for finitely many actions: minimises the mean of -log P(a | s) + ridge / 2
/// |weights|^2, by Newton's method with step halving. Throws like cloneLinear, for a ridge that is not
/// positive (separable demonstrations would have no optimum), and for actions outside {0, ..., count - 1}.
[[nodiscard]] SoftmaxClone cloneSoftmax(const MatrixArg& features, const std::vector<int>& actions, int count,
                                        double ridge = 1e-3, int maxIterations = 100);

class Rng;

/// The action (m) that somebody takes where the features of the state are phi (k).
using ActionOf = std::function<Eigen::VectorXd(const VectorArg& phi)>;

/// What an imitator can practise on.
struct ImitationTask {
  ActionOf expert;
  /// Runs an episode in which `act` chooses all actions; the features of the states it visits, n x k.
  std::function<Eigen::MatrixXd(const ActionOf& act, Rng& rng)> episode;
};

struct AggregationOptions {
  int rounds = 10;
  int episodes = 1;          ///< of each round
  double expertShare = 0.5;  ///< to the power of the round: how often the expert acts in it, 0^0 = 1
  double ridge = 1e-6;       ///< see cloneLinear()
};

/// Imitation with dataset aggregation, DAgger (Ross, Gordon and Bagnell, 2011): in each round the last clone
/// acts, in the first one the expert; the expert says what to do in all states that were visited, and a clone
/// learns from those of all rounds. So it learns to recover from its own mistakes, which demonstrations alone
/// do not show (slides 9:9 to 9:11): the first clone is that of cloneLinear(). Returns the clone of each
/// round. Throws Error like cloneLinear(), for options out of range, and for an empty episode.
[[nodiscard]] std::vector<LinearClone> aggregatedClones(const ImitationTask& task,
                                                        const AggregationOptions& options, Rng& rng);

}  // namespace rex
