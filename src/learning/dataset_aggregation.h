#pragma once

#include <functional>
#include <vector>

#include "learning/behavioural_cloning.h"

namespace rex {

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
