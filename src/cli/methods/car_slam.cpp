#include <algorithm>
#include <cmath>

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

// Mean and covariance of the poses of particles.
template <typename Slam>
Gaussian poseOf(const Slam& slam) {
  const Eigen::Vector3d mean = slam.meanPose();
  Eigen::Matrix3Xd errors = slam.poses().colwise() - mean;
  for (double& heading : errors.row(2)) heading = wrapAngle(heading);
  return {mean, errors * slam.weights().asDiagonal() * errors.transpose()};
}

class FastSlamCar final : public CarFilter {
 public:
  FastSlamCar(const CarOptions& options, const Eigen::Vector3d& start, const FastSlamOptions& how,
              const Rng& rng)
      : car_(CarSimulator::withoutPlaces(0, options)), rng_(rng), slam_(start, sensorOf(options), how) {}

  CarUpdate step(const Eigen::Vector2d& u, const CarSightings& seen) override {
    std::vector<LandmarkSighting> sightings;
    for (std::size_t i = 0; i < seen.landmarks.size(); ++i)
      sightings.push_back(
          {seen_.numberOf(seen.landmarks[i]), seen.y.segment<2>(2 * static_cast<Eigen::Index>(i))});
    const FastSlamStep step = slam_.step(transitionOf(car_, u), sightings, rng_);
    return {.effectiveParticles = step.lost ? 0 : step.effectiveSize};
  }
  Gaussian pose() const override { return poseOf(slam_); }
  std::vector<FoundLandmark> map() const override {
    std::vector<FoundLandmark> found;
    for (int i = 0; i < slam_.landmarks(); ++i)
      found.push_back({seen_.names()[static_cast<std::size_t>(i)], slam_.landmark(i)});
    return found;
  }
  void addTo(CarView& view) const override {
    view.particles = slam_.poses();
    view.weights = slam_.weights();
  }

 private:
  CarSimulator car_;
  Rng rng_;
  FastSlam slam_;
  SeenLandmarks seen_;
};

bool isVisible(const CarOptions& options, const Eigen::Vector3d& x, const Eigen::Vector2d& landmark) {
  const Eigen::Vector2d d = landmark - x.head<2>();
  const double bearing = d.isZero(0) ? 0 : wrapAngle(std::atan2(d[1], d[0]) - x[2]);
  return d.norm() <= options.maxRange && 2 * std::abs(bearing) <= options.fieldOfView;
}

// It is not told which landmark is which.
class UnnamedFastSlamCar final : public CarFilter {
 public:
  UnnamedFastSlamCar(const CarOptions& options, const Eigen::Vector3d& start, int particles, const Rng& rng)
      : car_(CarSimulator::withoutPlaces(0, options)),
        rng_(rng),
        slam_(start, sensorOf(options),
              {.particles = particles,
               .isInView = [options](const Eigen::Vector3d& x, const Eigen::Vector2d& landmark) {
                 return isVisible(options, x, landmark);
               }}) {}

  CarUpdate step(const Eigen::Vector2d& u, const CarSightings& seen) override {
    std::vector<Eigen::Vector2d> ys;
    for (Eigen::Index i = 0; i < seen.y.size(); i += 2) ys.emplace_back(seen.y.segment<2>(i));
    return {.effectiveParticles = slam_.step(transitionOf(car_, u), ys, rng_).effectiveSize};
  }
  Gaussian pose() const override { return poseOf(slam_); }
  std::vector<FoundLandmark> map() const override {
    std::vector<FoundLandmark> found;
    for (const MappedLandmark& one : slam_.map()) found.push_back({.belief = one.position});
    return found;
  }
  void addTo(CarView& view) const override {
    view.particles = slam_.poses();
    view.weights = slam_.weights();
  }

 private:
  CarSimulator car_;
  Rng rng_;
  UnnamedFastSlam slam_;
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
  return std::make_unique<FastSlamCar>(
      options, start, FastSlamOptions{.particles = particles, .observedProposal = observedProposal}, rng);
}

std::unique_ptr<CarFilter> makeUnnamedFastSlam(const CarOptions& options, const Eigen::Vector3d& start,
                                               int particles, const Rng& rng) {
  return std::make_unique<UnnamedFastSlamCar>(options, start, particles, rng);
}

}  // namespace rex::cli
