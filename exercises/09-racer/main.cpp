#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "course/search_cma.h"
#include "exercise.h"
#include "show.h"

using namespace rex;

Eigen::Matrix2d massMatrix(const Eigen::Vector2d& q, const RacerModel& racer) {
  // TODO: kinetic energy is q'^T M q' / 2. How much do the wheel and the pendulum contribute?
  return Eigen::Matrix2d::Identity();
}

Eigen::Vector2d forceTerm(const Eigen::Vector2d& q, const Eigen::Vector2d& v, const RacerModel& racer) {
  // TODO: all terms of d/dt dT/dq' - dT/dq + dU/dq but M q''.
  return Eigen::Vector2d::Zero();
}

Eigen::Vector2d controlDirection(const RacerModel& racer) {
  // TODO: the work of the motor is u times the angle between wheel and pendulum.
  return Eigen::Vector2d::Zero();
}

double energyOf(const Eigen::Vector4d& x, const RacerModel& racer) {
  // TODO: T + U.
  return 0;
}

Eigen::Vector4d rateOf(const Eigen::Vector4d& x, double u, const RacerModel& racer) {
  // TODO: the velocities, and the accelerations that solve M q'' + F = B u.
  return 0 * x;
}

Eigen::Vector4d stepped(const Eigen::Vector4d& x, double u, double tau, const RacerModel& racer) {
  // TODO: four rates and their weighted mean.
  return x;
}

Eigen::MatrixXd kicks(int steps, double tau, double noise, Rng& rng) {
  // TODO: normally distributed numbers with the right deviation, from `rng`.
  return Eigen::MatrixXd::Zero(2, steps);
}

Linear linearNearRest(const RacerModel& racer) {
  // TODO: the derivatives of rateOf() by the state and by u, at rest upright.
  return {Eigen::Matrix4d::Zero(), Eigen::Vector4d::Zero()};
}

Eigen::Vector4d lqrGain(const Linear& system, const Eigen::Matrix4d& Q, double R) {
  // TODO: solve 0 = A^T P + P A - P B B^T P / R + Q for P, which gives K. inverse(), solve() may help.
  return Eigen::Vector4d::Zero();
}

Eigen::VectorXd featuresAt(const Eigen::Vector4d& y, const Eigen::VectorXd& before, double u, double tau) {
  // TODO: 27 numbers; the first reading is a special case.
  return Eigen::VectorXd::Zero(kFeatures);
}

Ride rideOf(const Eigen::VectorXd& w, const Eigen::Vector4d& start, const Eigen::MatrixXd& noise,
            const RacerModel& racer, const RacerSensors& sensors) {
  // TODO: step by step, until the time is over or the racer has failed.
  return {start, Eigen::VectorXd(0), 0};
}

Species nextSpecies(const Species& species, const Eigen::MatrixXd& X, const Eigen::VectorXd& costs, int mu) {
  // TODO: which samples are the best, and where is their mean? Then path and deviation.
  return species;
}

Species evolved(const Costs& costs, const Species& start, int mu, int lambda, int generations, Rng& rng) {
  // TODO: sample, ask for the costs, select.
  return start;
}

Eigen::VectorXd searchedPolicy(const Rides& rides, int budget, Rng& rng) {
  // TODO: SearchCma or evolved() proposes, rides() judges. Which features, how many steps, how often?
  return Eigen::VectorXd::Zero(kFeatures);
}

double sensedCost(const Eigen::MatrixXd& Y, int steps) {
  // TODO: the cost of the readings, and that of the steps without one.
  return 0;
}

Eigen::Vector2d sensedPose(const Eigen::Vector4d& y, const RacerModel& racer, const RacerSensors& sensors) {
  // TODO: solve the formulas of y for theta', theta and x, in this order.
  return Eigen::Vector2d::Zero();
}

// What follows is given, and never graded: change it as you like. show.h says what each line draws.

int main() {
  const RacerModel racer;

  // Part 1: the equation of motion, where the racer moves and tilts (x, theta, x', theta').
  showEquation(racer, {.3, .7, -1.1, 2.3});

  // Part 2: a racer falls from a tilt of 0.01 rad, without control.
  showEnergy(racer, .01);

  // Part 3: the prices of x, theta, x' and theta', and that of u.
  const Eigen::Matrix4d Q = Eigen::Vector4d(1, 10, 0, 0).asDiagonal();
  const double R = 1;
  showLqr(linearNearRest(racer), Q, R);

  // Part 4: a gyroscope that reads 0, and then 1 rad/s.
  showFeatures();

  // Part 5: rides of a policy on 1 and the four readings, found by a long search.
  Eigen::VectorXd direct = Eigen::VectorXd::Zero(kFeatures);
  direct.head(5) << -.1087, -4.83, 30.02, .295, .4098;
  showRides(direct);

  // Part 6: your strategy and CMA-ES.
  showEvolution();

  // Part 7: a policy on all features, found by your search.
  const Eigen::VectorXd policy = showSearch(direct);

  // Part 8, the bonus: the same search by the costs of sensors.
  showSensed(policy);
}
