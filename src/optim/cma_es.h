#pragma once

#include <limits>
#include <optional>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Eigenvalues>

#include "base/require.h"
#include "base/rng.h"
#include "optim/search_result.h"

namespace rex {

struct CmaOptions {
  int lambda = 0;      ///< samples per generation, at least 2; 0: 4 + floor(3 ln n)
  int mu = 0;          ///< parents, at most lambda; 0: half of lambda
  bool active = true;  ///< bad samples decrease the variance along their directions
  /// Generations between eigendecompositions of C; 0: few enough that C barely changes,
  /// 1 / (10 n (c_1 + c_mu)).
  int decompositionGap = 0;
};

/// The evolution strategy with covariance matrix adaptation of slides 9:29-9:31, with all constants of
/// Hansen, The CMA Evolution Strategy: A Tutorial, 2016: samples are N(mean, sigma^2 C). The caller
/// evaluates:
///   while (...) { es.sample(X, rng); evaluate X; es.update(X, values); }
/// The loop allocates nothing except one vector to decompose C. Only the order of values matters. Values
/// that are not finite rank last and are counted in result().
class CmaEs {
 public:
  /// Starts with N(mean, diag(deviations)^2). Throws Error for no coordinates, sizes that differ, numbers
  /// that are not finite, deviations that are not positive, outside 1e+-100 or more than a factor of 1e7
  /// apart, and options out of range.
  CmaEs(const VectorArg& mean, const VectorArg& deviations, const CmaOptions& options = {});

  int dimension() const { return static_cast<int>(mean_.size()); }
  int lambda() const { return static_cast<int>(weights_.size()); }
  int mu() const { return mu_; }
  int generation() const { return static_cast<int>(result_.iterations); }
  const Eigen::VectorXd& mean() const { return mean_; }
  double sigma() const { return sigma_; }
  const Eigen::MatrixXd& covariance() const { return C_; }  ///< C; the covariance of samples is sigma^2 C
  /// The last eigendecomposition of C: columns of `axes`, and the square roots of the eigenvalues, ascending.
  const Eigen::MatrixXd& axes() const { return B_; }
  const Eigen::VectorXd& axisLengths() const { return D_; }
  const Eigen::VectorXd& path() const { return covariancePath_; }  ///< p_c
  /// The best sample so far, with counts.
  const SearchResult& result() const { return result_; }

  /// Fills X, n x lambda, with samples. Throws Error for another shape.
  void sample(Eigen::Ref<Eigen::MatrixXd> X, Rng& rng);

  /// Updates the distribution from the values of lambda points, which may differ from the samples. Without
  /// any finite value, nothing is learnt. Throws Error for sizes that do not fit, and points that are not
  /// finite.
  void update(const MatrixArg& X, const VectorArg& values);

  /// Both at once, for loops like that of the course. The first call, without values, resizes both and
  /// samples. Later calls do update() and sample().
  void step(Eigen::MatrixXd& samples, Eigen::VectorXd& values, Rng& rng);

 private:
  void setConstants(const CmaOptions& options);
  void rank(const MatrixArg& X, const VectorArg& values);
  void moveMean();
  void adaptStepSize();
  void adaptCovariance();
  void decompose();

  // Constants of the strategy, named as in the tutorial.
  int mu_ = 0, gap_ = 0;
  Eigen::VectorXd weights_;  // w_i by rank; the positive ones sum to 1
  double mueff_ = 0, cSigma_ = 0, dSigma_ = 0, cc_ = 0, c1_ = 0, cmu_ = 0, chiN_ = 0;

  // What it has learnt.
  Eigen::VectorXd mean_;
  double sigma_ = 0;
  Eigen::MatrixXd C_, B_;
  Eigen::VectorXd D_, sigmaPath_, covariancePath_;
  int decomposedAt_ = 0;
  SearchResult result_;

  // Of the update under way.
  Eigen::MatrixXd Z_, Y_;  // n x lambda; Y: (x - mean) / sigma, best first
  Eigen::VectorXd step_, rotated_, whitened_;
  std::vector<int> order_;
  Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver_;
};

/// When CMA-ES ends: at a target, or by the criteria of section B.3 of the tutorial.
struct CmaLimits {
  double target = -std::numeric_limits<double>::infinity();
  long maxEvaluations = 10'000'000;
  double smallestStep = 1e-12;        ///< relative to the first deviation
  double smallestDifference = 1e-12;  ///< difference of values over 10 + 30 n / lambda generations
  double largestCondition = 1e14;     ///< condition number of C
  double largestGrowth = 1e4;         ///< growth of the longest axis
};

/// Monitors one run.
class CmaTermination {
 public:
  /// `es` must not have begun. Throws Error for an infinite target, and limits that are not numbers or not
  /// positive.
  CmaTermination(const CmaEs& es, const CmaLimits& limits);

  /// Call it after each update with the same values. Returns why the run should end, or nothing.
  [[nodiscard]] std::optional<SearchStatus> check(const CmaEs& es, const VectorArg& values);

 private:
  void remember(const VectorArg& values);
  [[nodiscard]] bool hasNoEffect(const CmaEs& es);
  [[nodiscard]] bool isFlat(const VectorArg& values) const;
  [[nodiscard]] bool isStagnating(int generation);
  [[nodiscard]] double windowMedian(const std::vector<double>& history, std::size_t from, std::size_t count);

  CmaLimits limits_;
  double firstSigma_, firstAxis_;
  std::size_t flatSpan_, stagnationSpan_;
  std::vector<double> bests_, medians_, sorted_;  // of the generations, so far; room for a median
  Eigen::VectorXd moved_;
};

}  // namespace rex
