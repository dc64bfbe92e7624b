#pragma once

#include <functional>
#include <utility>

#include "course/course.h"
#include "systems/racer_sensors.h"

// The functions you complete in main.cpp. SI units, angles in radians. q = (x, theta): the position of the
// wheel along the ground, and the angle of the pendulum from upright, towards x. A state is (x, theta, x',
// theta'); the control u is the torque of the motor, which turns the wheel forwards and the pendulum back.
// Slides are named as chapter:number.

/// An inverted pendulum B on the axis of a wheel A that rolls without slipping: 12.6.1.
struct RacerModel {
  double r = 0.05, l = 0.5;          ///< radius of the wheel; from its axis to the centre of mass of B, m
  double mA = 0.05, mB = 0.5;        ///< kg
  double IA = 3.125e-5, IB = 0.005;  ///< about the centres of mass, kg m^2
  double g = 9.8;                    ///< m/s^2
};

// Part 1, Euler and Lagrange (12.6.1, 3:21 to 3:24): M(q) q'' + F(q, q') = B u. F may be computed by central
// differences; M, B and the energy are exact up to rounding.

/// M(q).
Eigen::Matrix2d massMatrix(const Eigen::Vector2d& q, const RacerModel& racer);
/// F(q, q'), with gravity.
Eigen::Vector2d forceTerm(const Eigen::Vector2d& q, const Eigen::Vector2d& v, const RacerModel& racer);
/// B.
Eigen::Vector2d controlDirection(const RacerModel& racer);
/// Kinetic and potential energy [J]; the latter is zero on the ground, where z = 0.
double energyOf(const Eigen::Vector4d& x, const RacerModel& racer);

// Part 2, the simulation.

/// dx/dt under the control u.
Eigen::Vector4d rateOf(const Eigen::Vector4d& x, double u, const RacerModel& racer);
/// The state tau seconds later by one step of the classic Runge-Kutta method, with u held; no noise.
Eigen::Vector4d stepped(const Eigen::Vector4d& x, double u, double tau, const RacerModel& racer);
/// The noise of a run, which is added to (x', theta') after each step: one column per step (2 x steps).
/// Independent normal numbers with standard deviation sqrt(tau) `noise`: `noise` is that of a whole second,
/// not of a step as in exercise 05.
Eigen::MatrixXd kicks(int steps, double tau, double noise, rex::Rng& rng);
/// Given: the noise of two runs, one after the other, with one generator.
inline std::pair<Eigen::MatrixXd, Eigen::MatrixXd> kicksOfTwo(int steps, double tau, double noise,
                                                              rex::Rng& rng) {
  Eigen::MatrixXd first = kicks(steps, tau, noise, rng);
  return {first, kicks(steps, tau, noise, rng)};
}

// Part 3, LQR (8:16 to 8:19), for a racer whose state is known.

/// A and B of x' = A x + B u.
struct Linear {
  Eigen::Matrix4d A;
  Eigen::Vector4d B;
};
/// Linearised at rest, upright. Exact or by finite differences: within 1e-6 of the largest entry.
Linear linearNearRest(const RacerModel& racer);
/// The K (4) for which u = -K x minimises the integral of x^T Q x + R u^2 in continuous time: within 1e-6
/// of the largest entry. Q is diagonal with positive entries for x and theta, R is positive.
Eigen::Vector4d lqrGain(const Linear& system, const Eigen::Matrix4d& Q, double R);

// Part 4, features of the sensor readings (12.12.1).

inline constexpr int kFeatures = 27;  ///< of a policy u = w . features

/// The features at a reading y of the four sensors: in this order
///   0       1
///   1 - 4   y
///   5 - 8   its rate: (y - the reading tau seconds before) / tau; zero at the first reading
///   9 - 12  average of y with factor a = .5: a (the average before) + (1 - a) y; at the first reading y
///   13 - 16 average of the rate with a = .5; zero at the first reading
///   17 - 24 the same two averages with a = .9
///   25, 26  the last control, and the one before; zero if there was none.
/// `before` holds the features at the previous reading, which was followed by the control u; nothing else
/// is known of the past. At the first reading `before` is empty, and u has no meaning.
Eigen::VectorXd featuresAt(const Eigen::Vector4d& y, const Eigen::VectorXd& before, double u, double tau);

// Part 5, one ride and what it costs (12.12.1).

inline constexpr double kTau = 0.01;          ///< seconds per step
inline constexpr double kNoise = 0.1;         ///< of the racer of the sheet, see kicks()
inline constexpr double kLargestControl = 5;  ///< N m: the motor gives no more, either way
inline constexpr double kLargestAngle = 0.8;  ///< rad: beyond it, the racer has failed
inline constexpr double kCostOfMissing = 10;  ///< for each step that is missing after a failure

/// One ride of n steps.
struct Ride {
  Eigen::MatrixXd states;    ///< 4 x (n + 1), beginning with the start
  Eigen::VectorXd controls;  ///< n
  double cost = 0;
};

/// A ride from `start` under the policy with weights w (27). In each step, read the sensors; take w .
/// features as u, limited to +-kLargestControl (the features remember the limited control); call stepped()
/// with kTau; and add this step's column of `noise` (2 x T) to (x', theta'). The ride ends after T steps,
/// or with the first step after which |theta| > kLargestAngle. Cost: x^2 + 10 theta^2 in the state after
/// each step that did not fail, and kCostOfMissing for each of the T steps that failed or did not come.
Ride rideOf(const Eigen::VectorXd& w, const Eigen::Vector4d& start, const Eigen::MatrixXd& noise,
            const RacerModel& racer, const rex::RacerSensors& sensors);

// Part 6, an evolution strategy (9:27 to 9:31).

/// A Gaussian N(mean, deviation^2 1) to sample from: the theta of slide 9:28.
struct Species {
  Eigen::VectorXd mean;  ///< n
  double deviation = 1;
  Eigen::VectorXd path;  ///< n, where the mean has moved lately: p_sigma of 9:31, zero at first
};

/// The species after it was sampled: at X (n x lambda, a sample in each column) the costs (lambda) were
/// found. The new mean is that of the `mu` samples with the lowest costs, and with c = 1 / sqrt(n)
///   new path      = (1 - c) path + sqrt(c (2 - c) mu) (new mean - mean) / deviation
///   new deviation = deviation exp(c / 2 (|new path|^2 / n - 1)).
Species nextSpecies(const Species& species, const Eigen::MatrixXd& X, const Eigen::VectorXd& costs, int mu);

/// The costs (m) of the columns of X (n x m).
using Costs = std::function<Eigen::VectorXd(const Eigen::MatrixXd& X)>;

/// The species that a (mu, lambda) evolution strategy ends with. In each of the generations, draw lambda
/// samples from the species, ask for their costs, once, and go on with nextSpecies().
Species evolved(const Costs& costs, const Species& start, int mu, int lambda, int generations, rex::Rng& rng);

// Part 7, policy search (9:30 to 9:34, 12.12.1).

/// The costs (m) of the policies in the columns of W (27 x m), from one ride each over `steps` steps, at
/// most kLongestRide. All rides of a call have the same start, at rest with a theta from -.2 to .2, and the
/// same noise; the next call has others.
using Rides = std::function<Eigen::VectorXd(const Eigen::MatrixXd& W, int steps)>;

inline constexpr int kLongestRide = 500;  ///< steps
inline constexpr int kBudget = 20000;     ///< rides

/// Weights (27) of a policy that keeps a racer upright on unseen noise: of 100 other rides from such starts,
/// at least 95 last 500 steps. The search uses at least 1000 and at most `budget` rides; a call with m
/// columns uses m. Lengths, masses, sensors and noise differ by up to a fifth from those of the sheet.
Eigen::VectorXd searchedPolicy(const Rides& rides, int budget, rex::Rng& rng);

// Part 8, a bonus: costs from sensors alone (12.12.1).

/// The cost of a ride of `steps` steps, from the readings Y (4 x n) after those n steps that did not fail, at
/// least one: y2^2 + y3^2 / 10 for each of them, with the gyroscope y2 and the encoder y3, and kCostOfMissing
/// for each of the other steps.
double sensedCost(const Eigen::MatrixXd& Y, int steps);

/// x and theta, from one reading of sensors with known constants; |theta| is below pi / 2.
/// systems/racer_sensors.h has the formulas of y.
Eigen::Vector2d sensedPose(const Eigen::Vector4d& y, const RacerModel& racer,
                           const rex::RacerSensors& sensors);
