#include <algorithm>

#include "cli/methods/car_slam_internal.h"
#include "estimation/ekf_slam.h"
#include "estimation/fast_slam.h"
#include "estimation/unnamed_fast_slam.h"
#include "geometry/rotation.h"

namespace rex::cli {
namespace {

// Landmarks in the order in which they were first seen, which is how the filters number them.
class SeenLandmarks {
 public:
  int numberOf(int landmark) {
    const auto at = std::ranges::find(names_, landmark);
    const auto number = static_cast<int>(at - names_.begin());
    if (at == names_.end()) names_.push_back(landmark);
    return number;
  }
  const std::vector<int>& names() const { return names_; }

 private:
  std::vector<int> names_;
};

PoseTransition transitionOf(const CarSimulator& car, const Eigen::Vector2d& u) {
  const double noise = car.options().dynamicsNoise;
  return {.mean = [&car, u](const Eigen::Vector3d& x) -> Eigen::Vector3d {
            return car.getMeanStateAfterStep(x, u);
          },
          .jacobian = [&car, u](const Eigen::Vector3d& x) -> Eigen::Matrix3d {
            return car.getStateJacobian(x, u);
          },
          .noise = noise* noise* Eigen::Matrix3d::Identity()};
}

class EkfSlamCar final : public CarFilter {
 public:
  EkfSlamCar(const CarOptions& options, const Gaussian& start)
      : car_(CarSimulator::withoutPlaces(0, options)), slam_(start, sensorOf(options)) {}

  CarUpdate step(const Eigen::Vector2d& u, const CarSightings& seen) override {
    slam_.predict(transitionOf(car_, u));
    CarUpdate result;
    for (std::size_t i = 0; i < seen.landmarks.size(); ++i) {
      const Eigen::Vector2d y = seen.y.segment<2>(2 * static_cast<Eigen::Index>(i));
      const LandmarkUpdate update = slam_.observe(seen_.numberOf(seen.landmarks[i]), y);
      if (update.isNew) continue;
      result.nis += update.squaredInnovation;
      result.degrees += 2;
    }
    return result;
  }
  Gaussian pose() const override { return slam_.pose(); }
  std::vector<FoundLandmark> map() const override {
    std::vector<FoundLandmark> found;
    for (int i = 0; i < slam_.landmarks(); ++i)
      found.push_back({seen_.names()[static_cast<std::size_t>(i)], slam_.landmark(i)});
    return found;
  }

 private:
  CarSimulator car_;
  EkfSlam slam_;
  SeenLandmarks seen_;
};

// Filters whose particles carry maps.
template <typename Slam>
class ParticleSlamCar : public CarFilter {
 public:
  ParticleSlamCar(const CarOptions& options, const Slam& slam, const Rng& rng)
      : car_(CarSimulator::withoutPlaces(0, options)), rng_(rng), slam_(slam) {}

  Gaussian pose() const override {
    const Eigen::Vector3d mean = slam_.meanPose();
    Eigen::Matrix3Xd errors = slam_.poses().colwise() - mean;
    for (double& heading : errors.row(2)) heading = wrapAngle(heading);
    return {mean, errors * slam_.weights().asDiagonal() * errors.transpose()};
  }
  void addTo(CarView& view) const override {
    view.particles = slam_.poses();
    view.weights = slam_.weights();
  }

 protected:
  CarSimulator car_;
  Rng rng_;
  Slam slam_;
};

class FastSlamCar final : public ParticleSlamCar<FastSlam> {
 public:
  using ParticleSlamCar::ParticleSlamCar;

  CarUpdate step(const Eigen::Vector2d& u, const CarSightings& seen) override {
    std::vector<LandmarkSighting> sightings;
    for (std::size_t i = 0; i < seen.landmarks.size(); ++i)
      sightings.push_back(
          {seen_.numberOf(seen.landmarks[i]), seen.y.segment<2>(2 * static_cast<Eigen::Index>(i))});
    const FastSlamStep step = slam_.step(transitionOf(car_, u), sightings, rng_);
    return {.effectiveParticles = step.lost ? 0 : step.effectiveSize};
  }
  std::vector<FoundLandmark> map() const override {
    std::vector<FoundLandmark> found;
    for (int i = 0; i < slam_.landmarks(); ++i)
      found.push_back({seen_.names()[static_cast<std::size_t>(i)], slam_.landmark(i)});
    return found;
  }

 private:
  SeenLandmarks seen_;
};

// It is not told which landmark is which.
class UnnamedFastSlamCar final : public ParticleSlamCar<UnnamedFastSlam> {
 public:
  using ParticleSlamCar::ParticleSlamCar;

  CarUpdate step(const Eigen::Vector2d& u, const CarSightings& seen) override {
    std::vector<Eigen::Vector2d> ys;
    for (Eigen::Index i = 0; i < seen.y.size(); i += 2) ys.emplace_back(seen.y.segment<2>(i));
    return {.effectiveParticles = slam_.step(transitionOf(car_, u), ys, rng_).effectiveSize};
  }
  std::vector<FoundLandmark> map() const override {
    std::vector<FoundLandmark> found;
    for (const MappedLandmark& one : slam_.map()) found.push_back({.belief = one.position});
    return found;
  }
};

}  // namespace

LandmarkSensor sensorOf(const CarOptions& options) {
  const double second = options.rangeBearing ? options.bearingNoise : options.observationNoise;
  return {
      .kind = options.rangeBearing ? LandmarkSensor::Kind::kRangeBearing : LandmarkSensor::Kind::kCartesian,
      .W =
          Eigen::Vector2d(options.observationNoise * options.observationNoise, second * second).asDiagonal()};
}

std::unique_ptr<CarFilter> makeEkfSlam(const CarOptions& options, const Gaussian& start) {
  return std::make_unique<EkfSlamCar>(options, start);
}

std::unique_ptr<CarFilter> makeFastSlam(const CarOptions& options, const Eigen::Vector3d& start,
                                        int particles, bool observedProposal, const Rng& rng) {
  const FastSlamOptions how{.particles = particles, .observedProposal = observedProposal};
  return std::make_unique<FastSlamCar>(options, FastSlam(start, sensorOf(options), how), rng);
}

std::unique_ptr<CarFilter> makeUnnamedFastSlam(const CarOptions& options, const Eigen::Vector3d& start,
                                               int particles, const Rng& rng) {
  const auto isInView = [options](const Eigen::Vector3d& x, const Eigen::Vector2d& landmark) {
    return rex::isInView(options, x, landmark);
  };
  return std::make_unique<UnnamedFastSlamCar>(
      options, UnnamedFastSlam(start, sensorOf(options), {.particles = particles, .isInView = isInView}),
      rng);
}

}  // namespace rex::cli
