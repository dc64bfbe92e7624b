#pragma once

#include <vector>

#include "course/course.h"

// The functions you complete in main.cpp. Metres, seconds, radians; left turns are positive. The state of the
// car is x = (x, y, heading), where the heading may be any number; its control is u = (speed, steering
// angle). Slides are cited as chapter:number.

/// What is known about a car and its sensor. Noises are standard deviations.
struct CarSetup {
  double tau = 1;                 ///< seconds per step
  double wheelbase = 2;           ///< L
  double dynamicsNoise = 0.03;    ///< of x, y and heading, added in each step
  double observationNoise = 0.5;  ///< of both numbers of a sighting; with rangeBearing, of the distance
  double bearingNoise = 0.02;     ///< with rangeBearing, of the bearing
  /// A landmark is seen as y = (metres ahead, metres to the left), or, with rangeBearing, as y = (distance,
  /// angle from the heading, within -pi and pi).
  bool rangeBearing = false;
};

/// A Gaussian belief N(mean, covariance) of n numbers.
struct Belief {
  Eigen::VectorXd mean;
  Eigen::MatrixXd covariance;  ///< n x n
};

// Part 1, models (12.9.2 a and b).

/// The state after one Euler step without noise, f(x, u): 4:48. The heading is not wrapped.
Eigen::Vector3d stepped(const CarSetup& car, const Eigen::Vector3d& x, const Eigen::Vector2d& u);
/// A = df/dx, 3 x 3.
Eigen::MatrixXd stepByState(const CarSetup& car, const Eigen::Vector3d& x, const Eigen::Vector2d& u);
/// B = df/du, 3 x 2: the question of 12.9.2 a.
Eigen::MatrixXd stepByControl(const CarSetup& car, const Eigen::Vector3d& x, const Eigen::Vector2d& u);
/// Q, the covariance of the noise added in a step, 3 x 3.
Eigen::MatrixXd stepNoise(const CarSetup& car);

/// How the landmark l is seen from x, without noise.
Eigen::Vector2d view(const CarSetup& car, const Eigen::Vector3d& x, const Eigen::Vector2d& l);
/// C = dy/dx, 2 x 3: 12.9.2 b, for one landmark.
Eigen::MatrixXd viewByState(const CarSetup& car, const Eigen::Vector3d& x, const Eigen::Vector2d& l);
/// D = dy/dl, 2 x 2: 12.13 a, for one landmark.
Eigen::MatrixXd viewByLandmark(const CarSetup& car, const Eigen::Vector3d& x, const Eigen::Vector2d& l);
/// W, the covariance of one sighting, 2 x 2.
Eigen::MatrixXd viewNoise(const CarSetup& car);
/// The difference of a sighting from the expected one: y - expected. Differences of bearings are wrapped to
/// [-pi, pi].
Eigen::Vector2d viewGap(const CarSetup& car, const Eigen::Vector2d& y, const Eigen::Vector2d& expected);

// Part 2, the extended Kalman filter (7:27, 7:28; 12.9.2 c).

/// The belief about the car (3 numbers) after a step, before anything is seen. Covariances that you return,
/// here and below, are exactly symmetric, entry by entry: because of rounding, this does not happen by
/// itself.
Belief predicted(const CarSetup& car, const Belief& belief, const Eigen::Vector2d& u);

/// The belief about n numbers after an observation of m numbers that differs from its expected value by `gap`
/// (m): y = C x + c + noise, C m x n, with noise of covariance W (m x m, positive definite). The covariance
/// is symmetric and positive definite if that of `belief` is, even if it shrinks to a millionth.
Belief corrected(const Belief& belief, const Eigen::VectorXd& gap, const Eigen::MatrixXd& C,
                 const Eigen::MatrixXd& W);

/// One step of the filter: the car moves, then it sees all N landmarks, whose positions are known (2 x N, one
/// per column). `y` stacks their sightings, 2 N numbers. Each model is linearised at the current mean: the
/// motion at the mean of `belief`, the view at the predicted mean.
Belief tracked(const CarSetup& car, const Belief& belief, const Eigen::Vector2d& u,
               const Eigen::MatrixXd& landmarks, const Eigen::VectorXd& y);

// Part 3, smoothing (7:29, 7:30).

/// The beliefs about all states of a run, given all its observations. filtered[t], T + 1 of them, are the
/// beliefs of a filter at each time; controls[t] leads from t to t + 1. The last belief stays as it is. A is
/// that of the filter: df/dx at filtered[t].
std::vector<Belief> hindsight(const CarSetup& car, const std::vector<Belief>& filtered,
                              const std::vector<Eigen::Vector2d>& controls);

// Part 4, Kalman SLAM (7:36 to 7:38; 12.13). A joint belief has 3 + 2 N numbers: the state of the car, then
// the positions of N landmarks, x and y of each. N may be zero.

/// The joint belief after a step. Landmarks do not move.
Belief jointPredicted(const CarSetup& car, const Belief& joint, const Eigen::Vector2d& u);

/// The joint belief after landmark i, from 0 on, was seen as y. Models are linearised at the mean.
Belief jointCorrected(const CarSetup& car, const Belief& joint, int i, const Eigen::Vector2d& y);

/// The joint belief with one more landmark at its end, about which nothing was known until it was seen as y.
/// Its position depends on the state of the car and on the noise of y, both linearised at the mean. Its
/// covariance, also with everything else, follows from that.
Belief withLandmark(const CarSetup& car, const Belief& joint, const Eigen::Vector2d& y);

// Part 5, the hard part: landmarks without names (7:38, 7:41), and FastSLAM (7:39 to 7:41).

inline constexpr int kNewLandmark = -1, kUnclear = -2;

/// Which landmarks of a joint belief were seen, one number for each y: that of a landmark, from 0 on;
/// kNewLandmark; or kUnclear, and that sighting is not used. No landmark is named twice. It is judged over
/// whole runs of some hundred sightings that start with an empty map: at the end, the map holds each landmark
/// that was seen five times or more, and none twice. Landmarks are at least 8 m apart, at least three are
/// always in view, and none is nearer than 3 m. It is also judged on single beliefs, with landmarks closer
/// together. There, a sighting is of a landmark if its gap to the expected view is at most 1.4 standard
/// deviations, and at least 7.7 for all other landmarks. It is of a new landmark if the gaps to all are at
/// least 22 standard deviations. The deviations are those of the covariance of the gap.
std::vector<int> assigned(const CarSetup& car, const Belief& joint, const std::vector<Eigen::Vector2d>& ys);

/// A sighting of a landmark, with the name of the landmark.
struct LandmarkObservation {
  int landmark = 0;
  Eigen::Vector2d y = Eigen::Vector2d::Zero();
};

/// A particle of FastSLAM: a state of the car, its weight, and the map given the path of this particle. Its
/// landmarks are Gaussians of two numbers each, independent of each other.
struct MapParticle {
  Eigen::Vector3d x = Eigen::Vector3d::Zero();
  double weight = 1;
  std::vector<Belief> map;
};

/// The particles, which have moved already, after these sightings: with updated maps and weights, in the same
/// order. All maps have the same number of landmarks. A landmark whose number is the size of the map is new:
/// it is appended to each map and changes no weight. The others change the weight by the likelihood of the
/// sighting. The weights sum to one, even if all likelihoods are as small as exp(-1000). No landmark is seen
/// twice.
std::vector<MapParticle> weighed(const CarSetup& car, const std::vector<MapParticle>& particles,
                                 const std::vector<LandmarkObservation>& sightings);
