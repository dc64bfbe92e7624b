#pragma once

#include <limits>
#include <optional>

#include <Eigen/Core>

#include "base/rng.h"
#include "optim/gaussian_process.h"
#include "optim/search_result.h"

namespace rex {

/// What a search hopes for at a point where f is normally distributed.
enum class Acquisition {
  kExpectedImprovement,  ///< E max(best - f, 0): Mockus, 1975; Jones, Schonlau and Welch, 1998
  kConfidenceBound       ///< -(mean - confidence deviation): UCB of Srinivas and others, 2010, upside down
};

struct BayesianOptions {
  GaussianKernel kernel = GaussianKernel::kMatern52;
  Acquisition acquisition = Acquisition::kExpectedImprovement;
  double confidence = 2;
  bool isNoisy = false;  ///< values of f are noisy, by how much is estimated; otherwise they are exact
  int firstSamples = 0;  ///< before the model is used; 0: 2 n + 2
  long maxEvaluations = 100;
  double target = -std::numeric_limits<double>::infinity();
};

/// The logarithm of E max(best - f, 0) for f ~ N(mean, deviation^2), also where the expectation underflows.
[[nodiscard]] double logExpectedImprovement(double mean, double deviation, double best);

/// Bayesian optimisation: a Gaussian process says what is known of f, and f is evaluated next where the
/// acquisition is largest. For functions that are so expensive that only some hundred evaluations are
/// possible. Ask where with next(), and tell what f is there with add().
class BayesianSearch {
 public:
  /// f is searched for low <= x <= high (n). Throws Error unless low < high, for numbers that are not finite,
  /// and for options out of range.
  BayesianSearch(const VectorArg& low, const VectorArg& high, const BayesianOptions& options = {});

  /// Where to evaluate f next: at first on a Latin hypercube, then where the acquisition is largest.
  [[nodiscard]] Eigen::VectorXd next(Rng& rng);
  /// f was evaluated. A value that is not finite counts as the worst one so far. Throws Error for an x of the
  /// wrong size, or outside of the box.
  void add(const VectorArg& x, double value);

  /// What is known of f; empty before the first samples. Its parameters are fitted again from time to time.
  [[nodiscard]] const std::optional<GaussianProcess>& process() const { return process_; }
  /// What the search hopes for at x, the logarithm of the expected improvement if that is it. Throws Error
  /// before the first samples.
  [[nodiscard]] double acquisition(const VectorArg& x) const;
  /// The best point evaluated so far: that of the least value, or mean of f if values are noisy.
  [[nodiscard]] const Eigen::VectorXd& best() const { return best_; }
  [[nodiscard]] double bestValue() const { return bestValue_; }

 private:
  void learn();
  double acquisition(const VectorArg& x, Eigen::VectorXd* gradient) const;

  Eigen::VectorXd low_, high_;
  BayesianOptions options_;
  Eigen::MatrixXd X_{}, first_{};  // evaluated; first samples
  Eigen::VectorXd y_{};
  std::optional<GaussianProcess> process_{};
  Eigen::Index lastFit_ = 0;  // points of the last fit
  Eigen::VectorXd best_{};
  double bestValue_ = std::numeric_limits<double>::infinity();
};

/// Minimises f within a box by a BayesianSearch. If values are noisy, the result has the point of least mean,
/// and that mean, which also counts for the target. Throws Error as the search does, for a target that is not
/// below infinity, and for no evaluations.
[[nodiscard]] SearchResult minimizeByBayes(const Objective& f, const VectorArg& low, const VectorArg& high,
                                           Rng& rng, const BayesianOptions& options = {});

}  // namespace rex
