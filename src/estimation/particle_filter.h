#pragma once

#include <functional>
#include <vector>

#include <Eigen/Core>

#include "estimation/gaussian.h"
#include "estimation/resampling.h"

namespace rex {

/// A distribution represented by weighted samples: slide 6:30.
struct Particles {
  Eigen::MatrixXd states{};   ///< one particle per column
  Eigen::VectorXd weights{};  ///< sum to one
};

[[nodiscard]] Particles sampledParticles(const Gaussian& gaussian, int count, Rng& rng);
/// Mean and covariance of the particles.
[[nodiscard]] Gaussian sampleMoments(const Particles& particles);

/// Replaces each column of X, a state, by a draw of the next state. For a proposal other than the motion,
/// it adds log(p(next | state) / p_proposal(next)) to the log weights.
using MotionSampler =
    std::function<void(Eigen::Ref<Eigen::MatrixXd> X, Eigen::Ref<Eigen::VectorXd> logWeights, Rng& rng)>;
/// Adds log p(y | x) for each column x of X, up to the same constant for all.
using LogLikelihood = std::function<void(const MatrixArg& X, Eigen::Ref<Eigen::VectorXd> logWeights)>;

/// Draws from the motion.
[[nodiscard]] MotionSampler motionProposal(NonlinearModel transition);
[[nodiscard]] LogLikelihood observationWeights(NonlinearModel observation, const VectorArg& y);
/// Draws from p(next | state, y), with the observation linearised at the mean of the motion: particles go
/// where the observation is likely (slide 7:25; Doucet, Godsill and Andrieu 2000). Weigh them with
/// observationWeights as usual. Both noise covariances must be definite.
[[nodiscard]] MotionSampler observedProposal(NonlinearModel transition, NonlinearModel observation,
                                             const VectorArg& y);

struct ParticleFilterOptions {
  Resampling resampling = Resampling::kResidual;  ///< with cellSize multinomial, at every step
  /// Resample if the effective sample size falls below this fraction of the particles; 1: at every step, as
  /// on slide 7:22.
  double threshold = 1;
  /// Cell sizes, one per entry of a state, for choosing the number of particles from the number of occupied
  /// cells (Fox 2003, see adaptiveSampleSize); 0: ignore this entry. Empty: a constant number of particles.
  Eigen::VectorXd cellSize{};
  double error = 0.05;
  int fewest = 50, most = 100000;
};

/// The outcome of a step.
struct ParticleStep {
  double logEvidence = 0;    ///< log p(y | earlier observations), up to the constant of LogLikelihood
  double effectiveSize = 0;  ///< after weighing
  bool resampled = false;
  bool lost = false;  ///< no particle explains the observation: it was ignored, but particles moved
};

/// Monte Carlo localisation: resample, propose, weigh. Slide 7:22.
class ParticleFilter {
 public:
  /// Throws Error for options out of range, no particles, and like resampled for weights.
  explicit ParticleFilter(Particles particles, ParticleFilterOptions options = {});

  const Particles& particles() const { return particles_; }
  /// Throws Error naming the particle for states or weights that are not a number; the particles are
  /// unchanged then.
  [[nodiscard]] ParticleStep step(const MotionSampler& propose, const LogLikelihood& weigh, Rng& rng);

 private:
  void gather(const std::vector<int>& parents);
  void proposeAdaptively(const MotionSampler& propose, Rng& rng);
  [[nodiscard]] bool shouldResample() const;

  Particles particles_;
  ParticleFilterOptions options_;
  std::vector<int> parents_;
  // Of the step that is under way.
  Eigen::MatrixXd next_, chunk_;
  Eigen::VectorXd logWeights_, proposed_;
};

}  // namespace rex
