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
         assumeObservation = 1;  ///< factors on the standard deviations that the filter assumes
  int particles = 1000;
};

/// The run with one seed; vectors and columns are indexed by step.
struct FilterRun {
  std::uint64_t seed = 0;
  Eigen::Matrix2Xd landmarks{};
  Eigen::Matrix3Xd truth{};
  Eigen::Matrix3Xd deadReckoning{};
  std::vector<Gaussian> poses{};
  std::vector<double> nees{};  ///< infinite if the covariance is (nearly) singular
  std::vector<CarUpdate> updates{};
  std::vector<std::vector<int>> seen{};
  std::vector<FoundLandmark> map{};  ///< at the end

  /// Estimate minus truth, with wrapped heading.
  [[nodiscard]] Eigen::Matrix3Xd errors() const;
  int steps() const { return static_cast<int>(truth.cols()); }
};

/// Called after step 1, 2, ...; `view` returns what the filter shows then: landmarks, sightings, particles
/// and map.
using OnStep = std::function<void(int step, const std::function<CarView()>& view)>;

/// Drives and filters; the same seed gives the same run. `watch` may be empty. Throws Error naming seed and
/// step if the filter cannot continue, and Interrupted for a signal of HeldSignals.
[[nodiscard]] FilterRun runFilter(const CarScenario& scenario, std::uint64_t seed, const OnStep& watch = {});

}  // namespace rex::cli
