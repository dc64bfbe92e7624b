#pragma once

#include <memory>

#include "cli/methods/car_filter.h"
#include "estimation/landmark_sensor.h"

namespace rex::cli {

/// The eyes of the car, with their noise.
[[nodiscard]] LandmarkSensor sensorOf(const CarOptions& options);

/// Filters of a car that finds its landmarks itself; which of them it sees, it can tell, but for the last
/// one.
[[nodiscard]] std::unique_ptr<CarFilter> makeEkfSlam(const CarOptions& options, const Gaussian& start);
[[nodiscard]] std::unique_ptr<CarFilter> makeFastSlam(const CarOptions& options, const Eigen::Vector3d& start,
                                                      int particles, bool observedProposal, const Rng& rng);
[[nodiscard]] std::unique_ptr<CarFilter> makeUnnamedFastSlam(const CarOptions& options,
                                                             const Eigen::Vector3d& start, int particles,
                                                             const Rng& rng);

}  // namespace rex::cli
