#pragma once

#include <limits>
#include <memory>
#include <optional>
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
  kSmoother,  ///< the extended filter, corrected by later observations
  kParticles,
  kEkfSlam,
  kFastSlam,
  kFastSlam2,
  kUnnamedFastSlam,  ///< decides itself which landmark it sees
  kDeadReckoning
};

/// The filter of that name. Throws UsageError for an unknown name, with the reason if a filter does not
/// suit the car.
[[nodiscard]] CarFilterKind carFilterOf(const std::string& name);
/// Whether the filter estimates the landmarks itself.
[[nodiscard]] bool makesMap(CarFilterKind kind);
[[nodiscard]] bool hasParticles(CarFilterKind kind);

/// The observations of the car in one step: y.segment<2>(2 i) of landmark landmarks[i].
struct CarSightings {
  std::vector<int> landmarks{};
  Eigen::VectorXd y{};
};

/// The result of a filter step.
struct CarUpdate {
  double nis = 0;  ///< squared innovation; 0, with 0 degrees of freedom, for filters without any
  int degrees = 0;
  double effectiveParticles = std::numeric_limits<double>::infinity();  ///< 0: none explains the observation
};

/// A landmark estimated by a filter.
struct FoundLandmark {
  std::optional<int> landmark{};  ///< empty: the filter does not know which of the true ones it is
  Gaussian belief{};
};

/// A filter that runs on the car.
class CarFilter {
 public:
  virtual ~CarFilter() = default;
  /// Predicts with u and updates with the observations. Throws Error like the filters of estimation.
  virtual CarUpdate step(const Eigen::Vector2d& u, const CarSightings& seen) = 0;
  [[nodiscard]] virtual Gaussian pose() const = 0;
  [[nodiscard]] virtual std::vector<FoundLandmark> map() const { return {}; }
  /// Adds the particles to a picture.
  virtual void addTo(CarView&) const {}
};

/// A filter that knows the car's initial pose to a millimetre and uses the constants of `car`; it knows the
/// landmarks unless it makes a map. Throws Error like the filters.
[[nodiscard]] std::unique_ptr<CarFilter> makeCarFilter(CarFilterKind kind, const CarSimulator& car,
                                                       int particles, const Rng& rng);

/// The car's motion model for control u, from its constants. Refers to `car`, which must outlive it.
[[nodiscard]] NonlinearModel motionModel(const CarSimulator& car, const Eigen::Vector2d& u);
/// The observation model of these landmarks.
[[nodiscard]] NonlinearModel sightingModel(const CarSimulator& car, const std::vector<int>& landmarks);

}  // namespace rex::cli
