#pragma once

#include <utility>
#include <vector>

#include "course/course.h"

// The functions you complete in main.cpp. Metres, seconds, radians; left turns are positive. The state of the
// car is x = (x, y, heading). A heading may be any angle: two that differ by whole turns are the same. Slides
// are cited as chapter:number.

/// What a filter assumes about a car and its sensor. Noises are standard deviations of Gaussian noise with
/// mean zero, all independent of each other.
struct CarWorld {
  double tau = 1;                 ///< seconds per step
  double wheelbase = 2;           ///< L
  double dynamicsNoise = 0.03;    ///< added to x, y and heading in each step, of whatever length; 09 differs
  double observationNoise = 0.5;  ///< of both coordinates of a landmark; in part 7 of its distance
  bool rangeBearing = false;      ///< part 7: see a distance and a bearing instead of a position
  double bearingNoise = 0.02;     ///< part 7
  Eigen::MatrixXd landmarks;      ///< (x, y) of each of m landmarks in a column, 2 x m
};

/// A distribution as weighted particles: 6:30.
struct Cloud {
  Eigen::MatrixXd states;   ///< one particle (x, y, heading) in each column, 3 x N
  Eigen::VectorXd weights;  ///< N, sum to one
};

// Part 1, a corridor in cells: what a filter does, exactly (7:13 to 7:15).

/// A corridor of n cells in a row, and how badly a robot moves and sees there.
struct Corridor {
  Eigen::VectorXd doors;  ///< n >= 3 numbers, from left to right: 1 for a cell with a door, 0 for wall only
  double misses = 0.2;    ///< the probability that the robot sees no door where there is one
  double alarms = 0.1;    ///< the probability that it sees a door where there is none
  double slips = 0.1;     ///< the probability that it stays in its cell when it should move to the next one
  double leaps = 0.1;     ///< the probability that it moves by two cells then
};

/// P(y | cell) for each of the n cells: y is a door that was seen, or, if `door` is false, that none was.
Eigen::VectorXd doorChances(bool door, const Corridor& corridor);

/// Step 2 of 7:15. The belief over the cells after a move to the right (way = 1) or to the left (way = -1).
/// The corridor has a wall at either end: a robot that would go further stays in the last cell before it.
Eigen::VectorXd movedCells(const Eigen::VectorXd& belief, int way, const Corridor& corridor);

/// Step 3 of 7:15. The belief given what the robot saw. If that is impossible in every cell where it may be,
/// the belief stays as it was.
Eigen::VectorXd seenCells(const Eigen::VectorXd& belief, bool door, const Corridor& corridor);

/// Bonus, 7:30: for each time 0..T the belief given all observations, earlier and later ones. The belief
/// before the first of them is `prior`. At time t the robot sees a door (seen[t] = 1) or none (seen[t] = 0),
/// then, unless t is T, it moves by ways[t] (T numbers). There is a way on which all of that is possible.
std::vector<Eigen::VectorXd> cellsInHindsight(const Eigen::VectorXd& prior, const std::vector<int>& ways,
                                              const std::vector<int>& seen, const Corridor& corridor);

// Part 2, dead reckoning (12.9.1 a).

/// The state after one Euler step from x with the control u = (speed, steering angle), without noise: 4:48.
/// All terms use the heading before the step.
Eigen::Vector3d carStep(const Eigen::Vector3d& x, const Eigen::Vector2d& u, const CarWorld& world);

/// Line 3 of 7:22. Each column of `states` (3 x N) one step later, each with its own noise.
Eigen::MatrixXd moved(const Eigen::MatrixXd& states, const Eigen::Vector2d& u, const CarWorld& world,
                      rex::Rng& rng);
/// Given: what two calls make of the same states, one after the other, with one generator.
inline std::pair<Eigen::MatrixXd, Eigen::MatrixXd> movesOfTwo(const Eigen::MatrixXd& states,
                                                              const Eigen::Vector2d& u, const CarWorld& world,
                                                              rex::Rng& rng) {
  const Eigen::MatrixXd first = moved(states, u, world, rng);
  return {first, moved(states, u, world, rng)};
}

// Part 3, how well the particles explain an observation (12.9.1 b).

/// What the car sees from x, without noise: for one landmark after the other, how far it is ahead of the car
/// and how far to the left. 2 m numbers. With rangeBearing (part 7) instead its distance and its bearing: the
/// angle from the heading of the car to the landmark, in [-pi, pi].
Eigen::VectorXd viewFrom(const Eigen::Vector3d& x, const CarWorld& world);

/// log p(y | x) of each column of `states`, up to the same constant for all; y has the numbers of viewFrom(),
/// with noise. Bearings in y may be any angles. N numbers.
Eigen::VectorXd logLikelihoods(const Eigen::MatrixXd& states, const Eigen::VectorXd& y,
                               const CarWorld& world);

/// Weights proportional to exp of those N numbers, with sum one, even if each exp by itself would be zero or
/// infinite. A logarithm of -infinity means a weight of zero; if all are -infinity, all weights are equal.
Eigen::VectorXd weightsOf(const Eigen::VectorXd& logarithms);

// Part 4, resampling (7:23).

/// The parents of `count` particles, numbered from 0, in any order. Parent i occurs count * weights[i] times
/// on average, and never less often than the integer part of that. The weights sum to one.
std::vector<int> resampledParents(const Eigen::VectorXd& weights, int count, rex::Rng& rng);

/// One over the sum of the squared weights: the number of particles of equal weight that would be worth as
/// much. The weights sum to one.
double effectiveSize(const Eigen::VectorXd& weights);

// Part 5, the filter (12.9.1 c).

/// Lines 2 to 4 of 7:22, all three in each step: from the particles before a step with the control u to as
/// many particles after it, weighted by what the car sees then. If no particle explains the observation (all
/// weights are zero), the weights become equal.
Cloud filterStep(const Cloud& before, const Eigen::Vector2d& u, const Eigen::VectorXd& y,
                 const CarWorld& world, rex::Rng& rng);

/// The mean of x and of y, and the direction of the mean of (cos heading, sin heading).
Eigen::Vector3d meanPose(const Cloud& cloud);

// Part 6, the wrong noise (12.9.1 c).

/// A recorded drive. The car stood at `start`; then, for t = 0, 1, ..., it moved by one step with controls[t]
/// and saw observations[t].
struct DriveLog {
  Eigen::Vector3d start = Eigen::Vector3d::Zero();
  std::vector<Eigen::Vector2d> controls;
  std::vector<Eigen::VectorXd> observations;
};

/// The observationNoise that the drive was made with, within 15 %. The value in `world` may be ten times too
/// large or too small; everything else in `world` is right. There are at least 8 landmarks and 100 steps, and
/// rangeBearing is false.
double likelyNoise(const DriveLog& log, const CarWorld& world, rex::Rng& rng);

// Part 7, distances and bearings: viewFrom() and logLikelihoods() with rangeBearing.
