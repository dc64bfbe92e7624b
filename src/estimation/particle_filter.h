#pragma once

#include <functional>
#include <vector>

#include <Eigen/Core>

#include "estimation/gaussian.h"
#include "estimation/gaussian_model.h"
#include "estimation/resampling.h"

namespace rex {

/// A distribution as weighted points: slide 6:30.
struct Particles {
  Eigen::MatrixXd states{};   ///< one particle per column
  Eigen::VectorXd weights{};  ///< sum to one
};

[[nodiscard]] Particles sampledParticles(const Gaussian& gaussian, int count, Rng& rng);
/// Mean and covariance of the particles.
[[nodiscard]] Gaussian momentsOf(const Particles& particles);

/// Replaces each column of X, a state, by a draw of the next one. Draws need not follow the motion alone:
/// then log p(next | state) / p_proposal(next) is added to the weight of each.
using Propose =
    std::function<void(Eigen::Ref<Eigen::MatrixXd> X, Eigen::Ref<Eigen::VectorXd> logWeights, Rng& rng)>;
/// Adds log p(y | x) of each column of X, up to the same constant for all.
using Weigh = std::function<void(const MatrixArg& X, Eigen::Ref<Eigen::VectorXd> logWeights)>;

/// Draws from the motion.
[[nodiscard]] Propose motionProposal(NonlinearModel transition);
[[nodiscard]] Weigh observationWeights(NonlinearModel observation, const VectorArg& y);
/// Draws from p(next | state, y), as far as the observation is linear around the mean of the motion:
/// particles go where the observation is likely (slide 7:25; Doucet, Godsill and Andrieu 2000). Weigh them by
/// observationWeights as always. Both noises must be definite.
[[nodiscard]] Propose observedProposal(NonlinearModel transition, NonlinearModel observation,
                                       const VectorArg& y);

struct ParticleFilterOptions {
  Resampling resampling = Resampling::kResidual;  ///< with cellSize always multinomial, and at every step
  /// Resample when the effective sample size falls below this share of the particles; 1: at every step, as
  /// slide 7:22 does.
  double threshold = 1;
  /// Sizes of the cells, one per number of a state, whose count decides on the count of particles (Fox 2003,
  /// see adaptiveSampleSize); 0: this number does not count. Empty: as many particles as before.
  Eigen::VectorXd cellSize{};
  double error = 0.05;
  int fewest = 50, most = 100000;
};

/// What a step did.
struct ParticleStep {
  double logEvidence = 0;    ///< log p(y | observations before), up to the constant of Weigh
  double effectiveSize = 0;  ///< after weighing
  bool resampled = false;
  bool lost = false;  ///< no particle explains the observation: it was left out, particles moved on
};

/// Monte Carlo localisation: resample, propose, weigh. Slide 7:22.
class ParticleFilter {
 public:
  /// Throws Error for options out of range, no particles, and weights as resampled.
  explicit ParticleFilter(Particles particles, ParticleFilterOptions options = {});

  const Particles& particles() const { return particles_; }
  /// Throws Error naming the particle for states or weights that are not a number; the particles stay then.
  [[nodiscard]] ParticleStep step(const Propose& propose, const Weigh& weigh, Rng& rng);

 private:
  void gather(const std::vector<int>& parents);
  void proposeAdaptively(const Propose& propose, Rng& rng);
  [[nodiscard]] bool shouldResample() const;

  Particles particles_;
  ParticleFilterOptions options_;
  std::vector<int> parents_;
  // Of the step that is under way.
  Eigen::MatrixXd next_, chunk_;
  Eigen::VectorXd logWeights_, proposed_;
};

}  // namespace rex
