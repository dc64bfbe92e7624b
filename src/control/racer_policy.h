#pragma once

#include <Eigen/Core>

#include "base/require.h"

namespace rex {

/// The features of a racer's measurements y that a policy uses (exercise 12.12), in this order: 1 and y,
/// always; the rates y'; averages of y and of the rates over the past with factors .5 and .9; and the last
/// two controls.
struct RacerFeatures {
  bool rates = false;          ///< (y - last y) / tau; zero at first
  bool averages = false;       ///< a <- factor a + (1 - factor) y, for both factors; y at first
  bool averagedRates = false;  ///< the same for the rates
  bool controls = false;       ///< zero at first

  [[nodiscard]] int count() const { return 5 + 4 * rates + 8 * averages + 8 * averagedRates + 2 * controls; }
};

/// The policy u = w . features of exercise 12.12, clipped to +-limit, for a racer that measures every tau
/// seconds.
class RacerPolicy {
 public:
  static constexpr int kMostFeatures = 27;

  /// Throws Error if the number of weights is not that of the features, for weights that are not finite,
  /// and for a tau or limit that is not positive.
  RacerPolicy(const RacerFeatures& features, const VectorArg& w, double tau = 0.01, double limit = 5);

  /// The control (N m) for the current measurement. Throws Error for numbers that are not finite.
  [[nodiscard]] double control(const Eigen::Vector4d& y);
  /// Forgets the past.
  void reset() { hasPast_ = false; }

 private:
  double w_[kMostFeatures]{}, features_[kMostFeatures]{};  // of all features; weights of absent ones are zero
  double tau_, limit_;
  bool hasPast_ = false;
};

}  // namespace rex
