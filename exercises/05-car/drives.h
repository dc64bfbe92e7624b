#pragma once

#include <cmath>
#include <vector>

#include "course/car_simulator.h"
#include "estimation/gaussian.h"
#include "exercise.h"
#include "geometry/rotation.h"

// The cars of the checks, and what follows from a world without calling the student's functions.

inline rex::CarOptions optionsOf(const CarWorld& world) {
  return {.tau = world.tau,
          .wheelbase = world.wheelbase,
          .dynamicsNoise = world.dynamicsNoise,
          .observationNoise = world.observationNoise,
          .rangeBearing = world.rangeBearing,
          .bearingNoise = world.bearingNoise};
}

inline rex::CarSimulator mapOf(const CarWorld& world) { return {world.landmarks, optionsOf(world)}; }

inline rex::CarSimulator carIn(const CarWorld& world, rex::Rng& rng) {
  rex::CarSimulator car(rng.next(), static_cast<int>(world.landmarks.cols()), optionsOf(world));
  car.setLandmarks(world.landmarks);
  return car;
}

// Landmarks 4 to 16 m from the origin in all directions, so that no car sees them in one line.
inline CarWorld worldWith(int landmarks, rex::Rng& rng) {
  CarWorld world;
  world.landmarks.resize(2, landmarks);
  const double first = rng.uniform(-4, 4);
  for (int i = 0; i < landmarks; ++i) {
    const double angle = first + 6.283185307179586 / landmarks * (i + rng.uniform(-0.2, 0.2));
    world.landmarks.col(i) = rng.uniform(4, 16) * Eigen::Vector2d(std::cos(angle), std::sin(angle));
  }
  return world;
}

inline Eigen::Vector3d randomPose(rex::Rng& rng) {
  return {rng.uniform(-8, 8), rng.uniform(-8, 8), rng.uniform(-9, 9)};
}

// log p(y | x). Bearings count modulo whole turns.
inline double logDensityAt(const CarWorld& world, const rex::CarSimulator& map, const Eigen::VectorXd& x,
                           const Eigen::VectorXd& y) {
  const Eigen::VectorXd seen = map.getMeanObservationAtState(x);
  Eigen::VectorXd difference = y - seen, variances(y.size());
  for (Eigen::Index i = 0; i < y.size(); ++i) {
    const bool angle = world.rangeBearing && i % 2 == 1;
    if (angle) difference[i] = rex::wrapAngle(difference[i]);
    variances[i] = std::pow(angle ? world.bearingNoise : world.observationNoise, 2);
  }
  return rex::logDensity({Eigen::VectorXd::Zero(y.size()), variances.asDiagonal()}, difference);
}

// For each column of states.
inline Eigen::VectorXd logDensities(const CarWorld& world, const Eigen::MatrixXd& states,
                                    const Eigen::VectorXd& y) {
  const rex::CarSimulator map = mapOf(world);
  Eigen::VectorXd result(states.cols());
  for (Eigen::Index k = 0; k < states.cols(); ++k) result[k] = logDensityAt(world, map, states.col(k), y);
  return result;
}

inline Cloud cloudAt(const Eigen::Vector3d& x, int count) {
  return {x.replicate(1, count), Eigen::VectorXd::Constant(count, 1. / count)};
}

// (x, y, heading) of a minus b, with the heading difference wrapped to [-pi, pi].
inline Eigen::Vector3d poseError(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return {a[0] - b[0], a[1] - b[1], rex::wrapAngle(a[2] - b[2])};
}

// Covariance of the particles around `mean`.
inline Eigen::Matrix3d covarianceAround(const Cloud& cloud, const Eigen::Vector3d& mean) {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (Eigen::Index k = 0; k < cloud.weights.size(); ++k) {
    const Eigen::Vector3d d = poseError(cloud.states.col(k), mean);
    sum += cloud.weights[k] * d * d.transpose();
  }
  return sum;
}

// A drive from `start` with the same control all the time, and the state of the car after each step.
struct Driven {
  DriveLog log;
  std::vector<Eigen::Vector3d> truth;
};

inline Driven drive(const CarWorld& world, const Eigen::Vector3d& start, const Eigen::Vector2d& u, int steps,
                    rex::Rng& rng) {
  rex::CarSimulator car = carIn(world, rng);
  car.setState(start);
  Driven driven{.log = {.start = start, .controls = {}, .observations = {}}, .truth = {}};
  for (int t = 0; t < steps; ++t) {
    car.step(u);
    driven.log.controls.push_back(u);
    driven.log.observations.push_back(car.getRealNoisyObservation());
    driven.truth.push_back(car.getState());
  }
  return driven;
}
