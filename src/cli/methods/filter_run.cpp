#include "cli/methods/filter_run.h"

#include <limits>
#include <utility>

#include <fmt/format.h>

#include "base/error.h"
#include "base/interruption.h"
#include "cli/wrong_use_internal.h"
#include "estimation/consistency.h"
#include "estimation/covariance.h"
#include "estimation/smoother.h"
#include "geometry/rotation.h"

namespace rex::cli {
namespace {

const Eigen::Vector2d kControl(0.1, 0.2);   // speed and steering angle, in all exercises of the car
constexpr std::uint64_t kFilterStream = 7;  // the filter's random numbers are not those of the car

CarSimulator believed(const CarScenario& scenario, const Eigen::Matrix2Xd& landmarks) {
  CarOptions options = scenario.car;
  options.dynamicsNoise *= scenario.assumeDynamics;
  options.observationNoise *= scenario.assumeObservation;
  options.bearingNoise *= scenario.assumeObservation;
  return {landmarks, options};
}

CarSightings lookAround(CarSimulator& car) {
  CarSightings seen{.landmarks = car.getVisibleLandmarks()};
  const Eigen::VectorXd y = car.getRealNoisyObservation();
  seen.y.resize(2 * static_cast<Eigen::Index>(seen.landmarks.size()));
  for (std::size_t i = 0; i < seen.landmarks.size(); ++i)
    seen.y.segment<2>(2 * static_cast<Eigen::Index>(i)) = y.segment<2>(2 * seen.landmarks[i]);
  return seen;
}

CarView viewOf(const CarFilter& filter, const FilterRun& run, const std::vector<int>& seen) {
  CarView view{.landmarks = run.landmarks, .sightings = run.landmarks(Eigen::all, seen)};
  for (const FoundLandmark& one : filter.map())
    view.landmarkBeliefs.push_back({one.belief.mean, one.belief.covariance});
  filter.addTo(view);
  return view;
}

double squaredError(const Gaussian& pose, const CarUpdate& update, const Eigen::Vector3d& truth) {
  constexpr int kHeading[] = {2};
  constexpr double kFewest = 4;  // fewer points do not span three dimensions
  if (update.effectiveParticles < kFewest) return std::numeric_limits<double>::infinity();
  const Eigen::LLT<Eigen::MatrixXd> factor(pose.covariance);
  if (!isDefinite(factor, pose.covariance)) return std::numeric_limits<double>::infinity();
  return estimationErrorSquared(pose, truth, kHeading);
}

// Smooths with the linearizations of the extended filter.
void smooth(std::vector<Gaussian>& poses, const CarSimulator& car) {
  std::vector<LinearModel> transitions;
  for (std::size_t t = 0; t + 1 < poses.size(); ++t)
    transitions.push_back(linearized(motionModel(car, kControl), poses[t].mean));
  poses = smoothed(poses, transitions);
}

}  // namespace

Eigen::Matrix3Xd FilterRun::errors() const {
  Eigen::Matrix3Xd errors(3, steps());
  for (int t = 0; t < steps(); ++t) {
    errors.col(t) = poses[static_cast<std::size_t>(t)].mean - truth.col(t);
    errors(2, t) = wrapAngle(errors(2, t));
  }
  return errors;
}

FilterRun runFilter(const CarScenario& scenario, std::uint64_t seed, const OnStep& watch) {
  CarSimulator car(seed, scenario.landmarks, scenario.car);
  FilterRun run{.seed = seed, .landmarks = car.getLandmarks()};
  run.truth.resize(3, scenario.steps);
  run.deadReckoning.resize(3, scenario.steps);
  const CarSimulator model = believed(scenario, run.landmarks);
  std::unique_ptr<CarFilter> filter;
  Eigen::Vector3d reckoned = Eigen::Vector3d::Zero();
  for (int t = 0; t < scenario.steps; ++t) {
    throwIfInterrupted();
    car.step(kControl);
    const CarSightings seen = lookAround(car);
    run.truth.col(t) = car.getState();
    run.deadReckoning.col(t) = reckoned = model.getMeanStateAfterStep(reckoned, kControl);
    asWrongUse(
        [&] {
          if (!filter)
            filter =
                makeCarFilter(scenario.filter, model, scenario.particles, Rng(seed).split(kFilterStream));
          run.updates.push_back(filter->step(kControl, seen));
          run.poses.push_back(filter->pose());
          return 0;
        },
        fmt::format("seed {}, step {}: ", seed, t + 1));
    run.seen.push_back(seen.landmarks);
    if (watch) watch(t + 1, [&] { return viewOf(*filter, run, seen.landmarks); });
  }
  run.map = filter->map();
  if (scenario.filter == CarFilterKind::kSmoother) asWrongUse([&] { return smooth(run.poses, model), 0; });
  for (std::size_t t = 0; t < run.poses.size(); ++t)
    run.nees.push_back(
        squaredError(run.poses[t], run.updates[t], run.truth.col(static_cast<Eigen::Index>(t))));
  return run;
}

}  // namespace rex::cli
