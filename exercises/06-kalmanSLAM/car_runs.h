#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include "course/car_simulator.h"
#include "estimation/consistency.h"
#include "geometry/rotation.h"
#include "grading/check.h"
#include "grading/evidence_parts.h"
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

// Checks shapes, finite numbers, exact symmetry, and variance in every direction.
inline void requireBelief(rex::grading::Check& check, const Belief& belief, Eigen::Index n) {
  check.shape("mean", belief.mean, n, 1);
  check.shape("covariance", belief.covariance, n, n);
  check.that("the covariance is exactly symmetric", belief.covariance == belief.covariance.transpose());
  check.that("the covariance is positive definite",
             Eigen::LLT<Eigen::MatrixXd>(belief.covariance).info() == Eigen::Success);
}

// got - wanted for states that begin with x, y and a heading; the headings may differ by whole turns.
inline Eigen::VectorXd gapOf(const Eigen::VectorXd& got, const Eigen::VectorXd& wanted) {
  Eigen::VectorXd gap = got - wanted;
  if (gap.size() > 2) gap[2] = rex::wrapAngle(gap[2]);  // landmarks have two
  return gap;
}

/// Two beliefs of the same size, drawn for the two entries in which they differ most.
inline rex::grading::Evidence beliefSeen(const Belief& got, const Belief& wanted) {
  const Eigen::VectorXd apart = gapOf(got.mean, wanted.mean).cwiseAbs() +
                                (got.covariance - wanted.covariance).cwiseAbs().rowwise().sum();
  Eigen::Index one = 0, other = 0;
  apart.maxCoeff(&one);
  for (Eigen::Index i = 0; i < apart.size(); ++i)
    if (i != one && (other == one || apart[i] > apart[other])) other = i;
  const std::array<Eigen::Index, 2> both{std::min(one, other), std::max(one, other)};
  rex::Figure figure{.title = "The two entries in which the beliefs differ most",
                     .xLabel = "entry " + std::to_string(both[0]) + " of the belief",
                     .yLabel = "entry " + std::to_string(both[1]) + " of the belief",
                     .equalAxes = true};
  const auto add = [&](const std::string& label, const Belief& belief, const rex::Color& color) {
    figure.ellipses.push_back({.label = label + ", 2 sigma",
                               .mean = belief.mean(both),
                               .covariance = belief.covariance(both, both),
                               .color = color});
    figure.series.push_back({.label = label + ", mean",
                             .x = {belief.mean[both[0]]},
                             .y = {belief.mean[both[1]]},
                             .style = rex::SeriesStyle::kPoints,
                             .marker = rex::Marker::kDot,
                             .size = 2,
                             .color = color});
  };
  add("got", got, rex::grading::kGotColor);
  add("wanted", wanted, rex::grading::kWantedColor);
  return {.figures = {figure}};
}

inline void sameBelief(rex::grading::Check& check, const Belief& got, const Belief& wanted,
                       double tolerance) {
  requireBelief(check, got, wanted.mean.size());
  const auto shown = check.show([&] { return beliefSeen(got, wanted); });
  check.near("mean", wanted.mean + gapOf(got.mean, wanted.mean), wanted.mean, tolerance);
  check.near("covariance", got.covariance, wanted.covariance, tolerance);
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
inline CarRun randomRun(rex::Rng& rng, const CarSetup& car, int landmarks, int steps,
                        const Eigen::Vector2d& u) {
  while (true) {
    rex::CarSimulator simulator(rng.next(), landmarks, optionsOf(car));
    CarRun run;
    run.car = car;
    run.landmarks = ring(rng, landmarks, curvatureOf(car, u));
    run.states = {Eigen::Vector3d::Zero()};
    simulator.setLandmarks(run.landmarks);
    double nearest = 2;
    for (int t = 0; t < steps; ++t) {
      simulator.step(u);
      run.controls.push_back(u);
      run.states.push_back(simulator.getState());
      run.sightings.push_back(simulator.getRealNoisyObservation());
      const Eigen::Vector2d place = run.states.back().head<2>();
      nearest = std::min(nearest, (run.landmarks.colwise() - place).colwise().norm().minCoeff());
    }
    if (nearest >= 2) return run;
  }
}
