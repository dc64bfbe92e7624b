#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <fmt/format.h>

#include "course/car_simulator.h"
#include "estimation/consistency.h"
#include "estimation/landmark_sensor.h"
#include "geometry/rotation.h"
#include "grading/check.h"
#include "interface.h"

// Random cars, their runs, beliefs, and second opinions on how beliefs change.

inline constexpr double kPi = std::numbers::pi;

inline rex::CarOptions optionsOf(const CarSetup& car) {
  rex::CarOptions options;
  options.tau = car.tau;
  options.wheelbase = car.wheelbase;
  options.dynamicsNoise = car.dynamicsNoise;
  options.observationNoise = car.observationNoise;
  options.rangeBearing = car.rangeBearing;
  options.bearingNoise = car.bearingNoise;
  return options;
}

inline CarSetup randomCar(rex::Rng& rng, bool rangeBearing) {
  CarSetup car;
  car.tau = rng.uniform(0.3, 1.2);
  car.wheelbase = rng.uniform(1.5, 4);
  car.dynamicsNoise = rng.uniform(0.02, 0.05);
  car.observationNoise = rng.uniform(0.2, 0.7);
  car.bearingNoise = rng.uniform(0.01, 0.05);
  car.rangeBearing = rangeBearing;
  return car;
}

inline std::string described(const CarSetup& car) {
  return fmt::format("tau = {:.6g}, L = {:.6g}, dynamicsNoise = {:.6g}, observationNoise = {:.6g}", car.tau,
                     car.wheelbase, car.dynamicsNoise, car.observationNoise) +
         (car.rangeBearing ? fmt::format(", bearingNoise = {:.6g}, distance and bearing", car.bearingNoise)
                           : ", metres ahead and left");
}

inline Eigen::Vector3d randomState(rex::Rng& rng) {
  return {rng.uniform(-5, 5), rng.uniform(-5, 5), rng.uniform(-7, 7)};
}

inline Eigen::Vector2d randomControl(rex::Rng& rng) {
  return {rng.uniform(0.5, 3) * (rng.index(2) == 0 ? -1 : 1), rng.uniform(-0.7, 0.7)};
}

// 3 m to 9 m away from x.
inline Eigen::Vector2d randomLandmark(rex::Rng& rng, const Eigen::Vector3d& x) {
  const double angle = rng.uniform(-kPi, kPi), distance = rng.uniform(3, 9);
  return {x[0] + distance * std::cos(angle), x[1] + distance * std::sin(angle)};
}

// Behind x, a milliradian to the left.
inline Eigen::Vector2d placeBehind(rex::Rng& rng, const Eigen::Vector3d& x) {
  const double angle = x[2] + kPi - 1e-3, distance = rng.uniform(3, 9);
  return {x[0] + distance * std::cos(angle), x[1] + distance * std::sin(angle)};
}

// Sums and products of whole matrices: each other expression would take its own time to compile.

inline Eigen::MatrixXd sum(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b, double factor = 1) {
  return a + factor * b;
}

inline Eigen::MatrixXd product(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) { return a * b; }

// A S A^T.
inline Eigen::MatrixXd carried(const Eigen::MatrixXd& A, const Eigen::MatrixXd& S) {
  return A * S * A.transpose();
}

inline Eigen::MatrixXd transposed(const Eigen::MatrixXd& a) { return a.transpose(); }

inline Eigen::MatrixXd unitMatrix(int n) { return Eigen::MatrixXd::Identity(n, n); }

// The standard deviation in every direction is about 0.05 to 0.4.
inline Eigen::MatrixXd randomCovariance(rex::Rng& rng, int n) {
  const Eigen::MatrixXd R = 0.1 * rng.normalVector(n * n).reshaped(n, n) / std::sqrt(0.2 * n);
  const Eigen::MatrixXd S = R * R.transpose() + 0.0025 * Eigen::MatrixXd::Identity(n, n);
  return 0.5 * (S + S.transpose());
}

// A joint belief: landmarks around a car.
inline Belief randomJoint(rex::Rng& rng, int landmarks) {
  const int n = 3 + 2 * landmarks;
  Belief joint{Eigen::VectorXd(n), randomCovariance(rng, n)};
  const Eigen::Vector3d x = randomState(rng);
  joint.mean.head(3) = x;
  for (int i = 0; i < landmarks; ++i) joint.mean.segment(3 + 2 * i, 2) = randomLandmark(rng, x);
  return joint;
}

// got - wanted for states that begin with x, y and a heading; the headings may differ by whole turns.
inline Eigen::VectorXd gapOf(const Eigen::VectorXd& got, const Eigen::VectorXd& wanted) {
  Eigen::VectorXd gap = got - wanted;
  if (gap.size() > 2) gap[2] = rex::wrapAngle(gap[2]);  // landmarks have two
  return gap;
}

// By central differences; accurate to 1e-8 for numbers of this size.
inline Eigen::MatrixXd derivative(const std::function<Eigen::VectorXd(const Eigen::VectorXd&)>& f,
                                  const Eigen::VectorXd& x) {
  constexpr double h = 1e-5;
  Eigen::MatrixXd J(f(x).size(), x.size());
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    const Eigen::VectorXd step = h * Eigen::VectorXd::Unit(x.size(), i);
    J.col(i) = (f(x + step) - f(x - step)) / (2 * h);
  }
  return J;
}

// What a car sees of landmarks (2 N numbers) from x, stacked.
inline Eigen::VectorXd seenFrom(const CarSetup& car, const Eigen::VectorXd& x,
                                const Eigen::VectorXd& landmarks) {
  const auto model = rex::CarSimulator::withoutPlaces(static_cast<int>(landmarks.size() / 2), optionsOf(car));
  return model.getMeanObservationAtStateAndLandmarks(x, landmarks);
}

// W for sightings of that many landmarks.
inline Eigen::MatrixXd noiseOf(const CarSetup& car, Eigen::Index landmarks) {
  const Eigen::Vector2d deviations(car.observationNoise,
                                   car.rangeBearing ? car.bearingNoise : car.observationNoise);
  return deviations.cwiseAbs2().replicate(landmarks, 1).asDiagonal();
}

// y - expected for stacked sightings.
inline Eigen::VectorXd gapsOf(const CarSetup& car, const Eigen::VectorXd& y,
                              const Eigen::VectorXd& expected) {
  Eigen::VectorXd gap = y - expected;
  if (car.rangeBearing)
    for (Eigen::Index i = 1; i < gap.size(); i += 2) gap[i] = rex::wrapAngle(gap[i]);
  return gap;
}

inline rex::LandmarkSensor sensorOf(const CarSetup& car) {
  using Kind = rex::LandmarkSensor::Kind;
  return {car.rangeBearing ? Kind::kRangeBearing : Kind::kCartesian, noiseOf(car, 1)};
}

// The correction in canonical form, where precisions add (7:27, the line before the Woodbury identity).
inline Belief informed(const Belief& belief, const Eigen::VectorXd& gap, const Eigen::MatrixXd& C,
                       const Eigen::MatrixXd& W) {
  const Eigen::MatrixXd CW = C.transpose() * W.inverse();
  const Eigen::MatrixXd S = (belief.covariance.inverse() + CW * C).inverse();
  return {belief.mean + S * (CW * gap), S};
}

inline double squaredError(const Eigen::VectorXd& error, const Eigen::MatrixXd& covariance) {
  return error.dot(covariance.ldlt().solve(error));
}

// A run of a car: controls[t] leads from states[t] to states[t + 1], where sightings[t] is seen, 2 N numbers.
struct CarRun {
  CarSetup car;
  Eigen::Matrix2Xd landmarks;
  std::vector<Eigen::Vector2d> controls;
  std::vector<Eigen::Vector3d> states;
  std::vector<Eigen::VectorXd> sightings;
};

// Landmarks in a ring around the circle on which a car drives that starts at 0 with this curvature: at least
// 8 m from each other, and 3 m to 8 m beside the circle.
inline Eigen::Matrix2Xd ring(rex::Rng& rng, int landmarks, double curvature) {
  Eigen::Matrix2Xd places(2, landmarks);
  for (int i = 0; i < landmarks;) {
    const double side = rng.index(2) == 0 ? -1 : 1, angle = rng.uniform(-kPi, kPi);
    const double distance = 1 / std::abs(curvature) + side * rng.uniform(3, 8);
    places.col(i) << distance * std::cos(angle), 1 / curvature + distance * std::sin(angle);
    bool isApart = true;
    for (int k = 0; k < i; ++k) isApart = isApart && (places.col(i) - places.col(k)).norm() > 8;
    if (isApart) ++i;
  }
  return places;
}

inline double curvatureOf(const CarSetup& car, const Eigen::Vector2d& u) {
  return std::tan(u[1]) / car.wheelbase;
}

// A run from 0 that comes no nearer than 2 m to a landmark: closer, a bearing is anything but linear, and no
// extended Kalman filter is consistent.
// Speed and steering vary by `sway`.
inline CarRun randomRun(rex::Rng& rng, const CarSetup& car, int landmarks, int steps,
                        const Eigen::Vector2d& u, double sway = 0) {
  while (true) {
    rex::CarSimulator simulator(rng.next(), landmarks, optionsOf(car));
    CarRun run;
    run.car = car;
    run.landmarks = ring(rng, landmarks, curvatureOf(car, u));
    run.states = {Eigen::Vector3d::Zero()};
    simulator.setLandmarks(run.landmarks);
    double nearest = 2;
    for (int t = 0; t < steps; ++t) {
      const double more = sway > 0 ? 1 + rng.uniform(-sway, sway) : 1;
      run.controls.emplace_back(more * u);
      simulator.step(run.controls.back());
      run.states.push_back(simulator.getState());
      run.sightings.push_back(simulator.getRealNoisyObservation());
      const Eigen::Vector2d place = run.states.back().head<2>();
      nearest = std::min(nearest, (run.landmarks.colwise() - place).colwise().norm().minCoeff());
    }
    if (nearest >= 2) return run;
  }
}
