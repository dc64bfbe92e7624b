#pragma once

#include <span>
#include <vector>

#include <Eigen/SparseCore>

#include "base/require.h"

namespace rex {

/// Transition probabilities between cells: entry (i, j) is P(next = i | now = j); columns sum to one.
using CellTransition = Eigen::SparseMatrix<double>;

/// The belief over the cells of a grid, or any finite set, after a transition: slide 7:15, step 2. Throws
/// Error for sizes that do not fit, probabilities that are negative or not finite, and if the belief or a
/// column of the transition does not sum to one within 1e-9.
[[nodiscard]] Eigen::VectorXd predictCells(const VectorArg& belief, const CellTransition& transition);

struct CellUpdate {
  Eigen::VectorXd belief{};
  double evidence = 0;  ///< P(y | earlier observations), up to the factor of the likelihoods
  bool lost = false;    ///< no cell explains the observation: the belief stays as it was
};
/// The belief given the likelihood of an observation in each cell: slide 7:15, step 3. Throws Error for a
/// belief like predictCells, and for likelihoods that are negative or not finite.
[[nodiscard]] CellUpdate updateCells(const VectorArg& predicted, const VectorArg& likelihood);

/// The beliefs at times 0..T given all observations: the forward filter times the backward one, slide 7:30.
/// likelihoods[t] belongs to time t, transitions[t] leads from t to t + 1, `prior` is the belief before the
/// first observation. Throws as above, and Error naming the time if no cell explains an observation.
[[nodiscard]] std::vector<Eigen::VectorXd> smoothedCells(const VectorArg& prior,
                                                         std::span<const CellTransition> transitions,
                                                         std::span<const Eigen::VectorXd> likelihoods);

}  // namespace rex
