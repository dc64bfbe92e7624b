#pragma once

#include <functional>
#include <vector>

#include <Eigen/Core>

#include "estimation/particle_filter.h"

namespace rex {

/// A distribution of states that can be drawn from.
struct StateDensity {
  std::function<Eigen::VectorXd(Rng& rng)> draw{};
  std::function<double(const Eigen::VectorXd& x)> logDensity{};  ///< minus infinity where it is zero
};

/// A grid of boxes over states: cell (i0, i1, ...) spans lower + (i0, i1, ...) * size. Cells are numbered
/// with the first index running fastest.
struct StateGrid {
  Eigen::VectorXd lower{}, size{};  ///< one number per entry of a state
  Eigen::VectorXi counts{};
  std::vector<int> angles{};  ///< entries that are wrapped into the grid, modulo 2 pi
  [[nodiscard]] int cells() const { return counts.prod(); }
  [[nodiscard]] Eigen::VectorXd center(int cell) const;
  /// The cell that contains a state; -1 outside the grid.
  [[nodiscard]] int cellOf(const Eigen::VectorXd& x) const;
};

/// Constant in each cell, with a probability in proportion to its weight. Throws Error for a grid without
/// cells or of sizes that do not fit, and for weights like resampled.
[[nodiscard]] StateDensity gridDensity(const StateGrid& grid, const VectorArg& weights);

struct MixtureProposalOptions {
  double share = 0.1;         ///< of the particles that are drawn from the observation, 0 to 1, less than 1
  double kidnapping = 0;      ///< probability that the motion ends anywhere, 0 to 1
  StateDensity anywhere{};    ///< where, if that is possible
  std::vector<int> angles{};  ///< entries of a state that are angles: differences are wrapped
};

/// Draws a share of the particles from what the observation alone says about the state, such as
/// gridDensity(likelihoods), the others from the motion. Both get the weight p(x) / q(x), of the prediction
/// from `belief` (the particles before the step) and of the mixture that all are drawn from, so that the
/// posterior stays right. Weigh them as usual. Slide 7:25; Thrun, Fox, Burgard and Dellaert 2001, with the
/// weights of Klaas, de Freitas and Doucet 2005. The time grows with the square of the number of particles.
/// Throws Error for a noise that is not definite, options out of range, and missing functions.
[[nodiscard]] MotionSampler mixtureProposal(NonlinearModel transition, const Particles& belief,
                                            StateDensity observed, MixtureProposalOptions options = {});

}  // namespace rex
