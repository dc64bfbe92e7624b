#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "cli/methods/car_filter.h"

namespace rex::cli {

/// A car that drives a circle among landmarks with u = (0.1, 0.2), and a filter that follows it.
struct CarScenario {
  CarFilterKind filter = CarFilterKind::kExtended;
  int landmarks = 2;
  int steps = 300;
  CarOptions car{};
  double assumeDynamics = 1,
         assumeObservation = 1;  ///< factors of the deviations that the filter believes in
  int particles = 1000;
};

/// What happened with one seed; vectors and columns count the steps.
struct FilterRun {
  std::uint64_t seed = 0;
  Eigen::Matrix2Xd landmarks{};
  Eigen::Matrix3Xd truth{};
  Eigen::Matrix3Xd deadReckoning{};
  std::vector<Gaussian> poses{};
  std::vector<double> nees{};  ///< infinite where the covariance is singular, or nearly so
  std::vector<CarUpdate> updates{};
  std::vector<std::vector<int>> seen{};
  std::vector<FoundLandmark> map{};  ///< in the end

  /// Estimate minus truth, the heading the shorter way round.
  [[nodiscard]] Eigen::Matrix3Xd errors() const;
  int steps() const { return static_cast<int>(truth.cols()); }
};

/// Called after step 1, 2, ...; `view` is what the filter shows then: landmarks, sightings, particles and
/// map.
using OnStep = std::function<void(int step, const std::function<CarView()>& view)>;

/// Drives and filters; the same seed gives the same. `watch` may be empty. Throws Error naming seed and step
/// where the filter cannot go on, Interrupted for a signal of HeldSignals.
[[nodiscard]] FilterRun runFilter(const CarScenario& scenario, std::uint64_t seed, const OnStep& watch = {});

}  // namespace rex::cli
