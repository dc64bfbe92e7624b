#pragma once

#include <cstdint>
#include <optional>

#include <Eigen/Core>

#include "base/rng.h"
#include "optim/cma_es.h"

namespace rex {

/// CMA-ES as in the course's exercises (slides 9:29-9:31), in a loop that you write:
///   SearchCma cma;  cma.init(5, -1, -1, -.1, .1);
///   for (...) { cma.step(samples, values);  values[i] = cost of samples.row(i), for all i; }
class SearchCma {
 public:
  explicit SearchCma(std::uint64_t seed = 0) : rng_(seed) {}

  /// Starts at a random point in [lo, hi]^D, with standard deviation hi - lo, mu parents and lambda
  /// samples. -1 stands for the usual values, lambda = 4 + floor(3 ln D) and mu = half of that. Throws
  /// Error for D < 1 and hi <= lo, and as CmaEs.
  void init(int D, int mu = -1, int lambda = -1, double lo = -1, double hi = 1);
  /// Starts at a point, with one standard deviation for all coordinates, or one for each. Throws Error as
  /// CmaEs.
  void init(const Eigen::VectorXd& start, int mu, int lambda, double deviation);
  void init(const Eigen::VectorXd& start, int mu, int lambda, const Eigen::VectorXd& deviations);

  /// The first call after init resizes both arguments, whatever they hold; samples has a point in each of
  /// its lambda rows. Every later call learns from the values, where lower ones are better, and draws
  /// new samples. Throws Error before init, and if the sizes have changed.
  void step(Eigen::MatrixXd& samples, Eigen::VectorXd& values);

  /// The best sample so far, or the start if there is none yet. Both throw Error before init.
  Eigen::VectorXd getBestSample() const;
  Eigen::VectorXd getMean() const;

 private:
  const CmaEs& strategy() const;

  Rng rng_;
  std::optional<CmaEs> strategy_;
  bool hasSampled_ = false;  // since init
  Eigen::MatrixXd columns_;  // the samples, one per column
};

}  // namespace rex
