#pragma once

#include <Eigen/Core>

#include "base/vector_arg.h"

namespace rex {

/// Which features of what a racer measured a policy takes, exercise 12.12, in this order: 1 and y always;
/// then the rates y' of y; averages of y and rates over the past with factor .5, and with .9; and the two
/// last controls.
struct RacerFeatures {
  bool rates = false;          ///< (y - last y) / tau; zero at first
  bool averages = false;       ///< a <- factor a + (1 - factor) y, of both factors; y at first
  bool averagedRates = false;  ///< the same of the rates
  bool controls = false;       ///< zero at first

  [[nodiscard]] int count() const { return 5 + 4 * rates + 8 * averages + 8 * averagedRates + 2 * controls; }
};

/// The policy u = w . features of exercise 12.12, within +-limit, of a racer that measures once in tau
/// seconds.
class RacerPolicy {
 public:
  static constexpr int kMostFeatures = 27;

  /// Throws Error for another number of weights than features, weights that are not finite, and a tau or
  /// limit that is not positive.
  RacerPolicy(const RacerFeatures& features, const VectorArg& w, double tau = 0.01, double limit = 5);

  /// The control (N m) for what is measured now. Throws Error for numbers that are not finite.
  [[nodiscard]] double control(const Eigen::Vector4d& y);
  /// Forgets the past.
  void reset() { hasPast_ = false; }

 private:
  double w_[kMostFeatures]{}, features_[kMostFeatures]{};  // of all features; weights of absent ones are zero
  double tau_, limit_;
  bool hasPast_ = false;
};

}  // namespace rex
