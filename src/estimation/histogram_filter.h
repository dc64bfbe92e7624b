#pragma once

#include <span>
#include <vector>

#include <Eigen/SparseCore>

#include "base/vector_arg.h"

namespace rex {

/// How likely each cell leads to which: entry (i, j) is P(next = i | now = j); columns sum to one.
using CellTransition = Eigen::SparseMatrix<double>;

/// A belief on the cells of a grid, or any finite set, after a transition: slide 7:15, step 2. Throws Error
/// for sizes that do not fit, probabilities that are negative or not finite, a belief that does not sum to
/// one within 1e-9, and the column of a transition that does not.
[[nodiscard]] Eigen::VectorXd predictCells(const VectorArg& belief, const CellTransition& transition);

struct CellUpdate {
  Eigen::VectorXd belief{};
  double evidence = 0;  ///< P(y | observations before), up to the factor of the likelihoods
  bool lost = false;    ///< no cell explains the observation: the belief stays as it was
};
/// The belief given an observation of that likelihood in each cell: slide 7:15, step 3. Throws Error for a
/// belief as predictCells, and likelihoods that are negative or not finite.
[[nodiscard]] CellUpdate updateCells(const VectorArg& predicted, const VectorArg& likelihood);

/// The beliefs at times 0..T given all observations: the forward filter times the backward one, slide 7:30.
/// likelihoods[t] belongs to time t, transitions[t] leads from t to t + 1, `prior` is the belief before the
/// first observation. Throws as above; Error naming the time where no cell explains an observation.
[[nodiscard]] std::vector<Eigen::VectorXd> smoothedCells(const VectorArg& prior,
                                                         std::span<const CellTransition> transitions,
                                                         std::span<const Eigen::VectorXd> likelihoods);

}  // namespace rex
