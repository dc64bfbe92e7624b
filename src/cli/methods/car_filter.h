#pragma once

#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "base/rng.h"
#include "course/car_simulator.h"
#include "course/car_view.h"
#include "estimation/gaussian.h"
#include "estimation/gaussian_model.h"

namespace rex::cli {

enum class CarFilterKind {
  kExtended,
  kUnscented,
  kInformation,
  kRoot,
  kSmoother,  ///< the extended filter, corrected by what is seen later
  kParticles,
  kEkfSlam,
  kFastSlam,
  kFastSlam2,
  kDeadReckoning
};

/// What a name means. Throws UsageError for another one, telling why where the filter does not fit the car.
[[nodiscard]] CarFilterKind carFilterOf(const std::string& name);
/// Whether the filter finds the landmarks itself.
[[nodiscard]] bool makesMap(CarFilterKind kind);
[[nodiscard]] bool hasParticles(CarFilterKind kind);

/// What the car sees in one step: y.segment<2>(2 i) of landmark landmarks[i].
struct CarSightings {
  std::vector<int> landmarks{};
  Eigen::VectorXd y{};
};

/// What a step did.
struct CarUpdate {
  double nis = 0;  ///< squared innovations of so many numbers; 0 of 0 for filters without any
  int degrees = 0;
  double effectiveParticles = std::numeric_limits<double>::infinity();  ///< 0: none explains what was seen
};

/// A landmark that a filter found.
struct FoundLandmark {
  int landmark = 0;
  Gaussian belief{};
};

/// A filter at work on the car.
class CarFilter {
 public:
  virtual ~CarFilter() = default;
  /// Drives with u and looks. Throws Error as the filters of estimation do.
  virtual CarUpdate step(const Eigen::Vector2d& u, const CarSightings& seen) = 0;
  [[nodiscard]] virtual Gaussian pose() const = 0;
  [[nodiscard]] virtual std::vector<FoundLandmark> map() const { return {}; }
  /// Adds particles.
  virtual void addTo(CarView&) const {}
};

/// A filter that knows the car's start to a millimetre and believes in the constants of `car`; it knows its
/// landmarks unless it makes a map. Throws Error as the filters do.
[[nodiscard]] std::unique_ptr<CarFilter> makeCarFilter(CarFilterKind kind, const CarSimulator& car,
                                                       int particles, const Rng& rng);

/// How the car moves with u, as its constants tell; asks `car` as long as it lives.
[[nodiscard]] NonlinearModel motionModel(const CarSimulator& car, const Eigen::Vector2d& u);
/// What it sees of landmarks.
[[nodiscard]] NonlinearModel sightingModel(const CarSimulator& car, const std::vector<int>& landmarks);

}  // namespace rex::cli
