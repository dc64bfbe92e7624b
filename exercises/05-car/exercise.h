#pragma once

#include <vector>

#include "course/course.h"

// The functions you complete in main.cpp. Metres, seconds, radians; left turns count positive. The state of
// the car is x = (x, y, heading), a heading any angle: two that differ by whole turns are the same. Slides
// are named as chapter:number.

/// What a filter assumes of a car and its sensor. Noises are standard deviations of normal numbers around
/// zero, each independent of all others.
struct CarWorld {
  double tau = 1;                 ///< seconds per step
  double wheelbase = 2;           ///< L
  double dynamicsNoise = 0.03;    ///< added to x, to y and to the heading in each step
  double observationNoise = 0.5;  ///< of both numbers seen of a landmark; in part 6 of its distance
  bool rangeBearing = false;      ///< part 6: see a distance and a bearing, instead of a place
  double bearingNoise = 0.02;     ///< part 6
  Eigen::MatrixXd landmarks;      ///< (x, y) of each of m landmarks in a column, 2 x m
};

/// A distribution as weighted particles: 6:30.
struct Cloud {
  Eigen::MatrixXd states;   ///< one particle (x, y, heading) in each column, 3 x N
  Eigen::VectorXd weights;  ///< N, sum to one
};

// Part 1, dead reckoning (12.9.1 a).

/// Where one step of Euler with the control u = (speed, steering angle) leads from x, without noise: 4:48.
/// All of it uses the heading before the step.
Eigen::Vector3d carStep(const Eigen::Vector3d& x, const Eigen::Vector2d& u, const CarWorld& world);

/// Line 3 of 7:22. Each column of `states` (3 x N), one step later, each with noise of its own.
Eigen::MatrixXd moved(const Eigen::MatrixXd& states, const Eigen::Vector2d& u, const CarWorld& world,
                      rex::Rng& rng);

// Part 2, what the particles say to an observation (12.9.1 b).

/// What the car sees from x, without noise: for one landmark after the other, how far it is ahead of the car
/// and how far to the left. 2 m numbers. With rangeBearing (part 6) its distance, and its bearing: the angle
/// from the heading of the car to the landmark, in [-pi, pi].
Eigen::VectorXd viewFrom(const Eigen::Vector3d& x, const CarWorld& world);

/// log p(y | x) of each column of `states`, up to the same constant for all; y has the numbers of viewFrom(),
/// with noise. Bearings in it are any angles. N numbers.
Eigen::VectorXd logLikelihoods(const Eigen::MatrixXd& states, const Eigen::VectorXd& y,
                               const CarWorld& world);

/// Weights in proportion to exp of those N numbers, with the sum one, also where each exp by itself would be
/// zero or infinite. A logarithm of -infinity is a weight of zero; if all are, all weights are equal.
Eigen::VectorXd weightsOf(const Eigen::VectorXd& logarithms);

// Part 3, resampling (7:23).

/// The parents of `count` particles, numbers from 0, in any order. Parent i occurs count * weights[i] times
/// on average, and never less often than the whole part of that. The weights sum to one.
std::vector<int> resampledParents(const Eigen::VectorXd& weights, int count, rex::Rng& rng);

/// One over the sum of the squared weights: how many particles of equal weight would be worth as much. The
/// weights sum to one.
double effectiveSize(const Eigen::VectorXd& weights);

// Part 4, the filter (12.9.1 c).

/// Lines 2 to 4 of 7:22, in each step all three: from the particles before a step with the control u to as
/// many after it, weighted by what the car sees then. An observation that no particle explains (all weights
/// zero) leaves equal weights.
Cloud filterStep(const Cloud& before, const Eigen::Vector2d& u, const Eigen::VectorXd& y,
                 const CarWorld& world, rex::Rng& rng);

/// The mean of x and of y, and the direction of the mean of (cos heading, sin heading).
Eigen::Vector3d meanPose(const Cloud& cloud);

// Part 5, the wrong noise (12.9.1 c).

/// A drive as it was written down. The car stood at `start`; then, for t = 0, 1, ..., it moved by one step
/// with controls[t] and saw observations[t].
struct DriveLog {
  Eigen::Vector3d start = Eigen::Vector3d::Zero();
  std::vector<Eigen::Vector2d> controls;
  std::vector<Eigen::VectorXd> observations;
};

/// The observationNoise that the drive was made with, within 15 % of it. What `world` says of it may be ten
/// times too much or too little; all else that it says is right. There are 8 landmarks or more, 100 steps or
/// more, and no rangeBearing.
double likelyNoise(const DriveLog& log, const CarWorld& world, rex::Rng& rng);

// Part 6, distances and bearings: viewFrom() and logLikelihoods() with rangeBearing.
