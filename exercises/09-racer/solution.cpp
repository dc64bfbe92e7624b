#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "course/search_cma.h"
#include "exercise.h"
#include "show.h"
// <solution headers>
// What a mistake in wrong.cpp takes from the library.
// <todo>
// </solution>

using namespace rex;

Eigen::Matrix2d massMatrix(const Eigen::Vector2d& q, const RacerModel& racer) {
  // <solution massMatrix>
  const double mixed = racer.mB * racer.l * std::cos(q[1]);
  Eigen::Matrix2d M;
  M << racer.mA + racer.mB + racer.IA / (racer.r * racer.r), mixed, mixed,
      racer.mB * racer.l * racer.l + racer.IB;
  return M;
  // <todo>
  //| // TODO: kinetic energy is q'^T M q' / 2. How much do the wheel and the pendulum contribute?
  //| return Eigen::Matrix2d::Identity();
  // </solution>
}

Eigen::Vector2d forceTerm(const Eigen::Vector2d& q, const Eigen::Vector2d& v, const RacerModel& racer) {
  // <solution forceTerm>
  const double swing = racer.mB * racer.l * std::sin(q[1]);
  return {-swing * v[1] * v[1], -swing * racer.g};
  // <todo>
  //| // TODO: all terms of d/dt dT/dq' - dT/dq + dU/dq but M q''.
  //| return Eigen::Vector2d::Zero();
  // </solution>
}

Eigen::Vector2d controlDirection(const RacerModel& racer) {
  // <solution controlDirection>
  return {1 / racer.r, -1};
  // <todo>
  //| // TODO: the work of the motor is u times the angle between wheel and pendulum.
  //| return Eigen::Vector2d::Zero();
  // </solution>
}

double energyOf(const Eigen::Vector4d& x, const RacerModel& racer) {
  // <solution energyOf>
  const Eigen::Vector2d v = x.tail<2>();
  return v.dot(massMatrix(x.head<2>(), racer) * v) / 2 +
         racer.g * (racer.mA * racer.r + racer.mB * (racer.r + racer.l * std::cos(x[1])));
  // <todo>
  //| // TODO: T + U.
  //| return 0;
  // </solution>
}

Eigen::Vector4d rateOf(const Eigen::Vector4d& x, double u, const RacerModel& racer) {
  // <solution rateOf>
  const Eigen::Vector2d q = x.head<2>(), v = x.tail<2>();
  Eigen::Vector4d rate;
  rate << v, massMatrix(q, racer).inverse() * (controlDirection(racer) * u - forceTerm(q, v, racer));
  return rate;
  // <todo>
  //| // TODO: the velocities, and the accelerations that solve M q'' + F = B u.
  //| return 0 * x;
  // </solution>
}

Eigen::Vector4d stepped(const Eigen::Vector4d& x, double u, double tau, const RacerModel& racer) {
  // <solution stepped>
  const Eigen::Vector4d k1 = rateOf(x, u, racer), k2 = rateOf(x + tau / 2 * k1, u, racer),
                        k3 = rateOf(x + tau / 2 * k2, u, racer), k4 = rateOf(x + tau * k3, u, racer);
  return x + tau / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
  // <todo>
  //| // TODO: four rates and their weighted mean.
  //| return x;
  // </solution>
}

Eigen::MatrixXd kicks(int steps, double tau, double noise, Rng& rng) {
  // <solution kicks>
  return std::sqrt(tau) * noise * rng.normalVector(2 * steps).reshaped(2, steps);
  // <todo>
  //| // TODO: normally distributed numbers with the right deviation, from `rng`.
  //| return Eigen::MatrixXd::Zero(2, steps);
  // </solution>
}

Linear linearNearRest(const RacerModel& racer) {
  // <solution linearNearRest>
  constexpr double h = 2e-5;
  Linear linear;
  for (int row = 0; row < 4; ++row) {
    const Eigen::Vector4d dx = h * Eigen::Vector4d::Unit(row);
    linear.A.col(row) = (rateOf(dx, 0, racer) - rateOf(-dx, 0, racer)) / (2 * h);
  }
  linear.B =
      (rateOf(Eigen::Vector4d::Zero(), h, racer) - rateOf(Eigen::Vector4d::Zero(), -h, racer)) / (2 * h);
  return linear;
  // <todo>
  //| // TODO: the derivatives of rateOf() by the state and by u, at rest upright.
  //| return {Eigen::Matrix4d::Zero(), Eigen::Vector4d::Zero()};
  // </solution>
}

Eigen::Vector4d lqrGain(const Linear& system, const Eigen::Matrix4d& Q, double R) {
  // <solution lqrGain>
  // The sign of the Hamiltonian matrix is -1 on its stable half, which is spanned by (1; P).
  Eigen::MatrixXd Z(8, 8);
  Z << system.A, -system.B * system.B.transpose() / R, -Q, -system.A.transpose();
  for (int i = 0; i < 60; ++i) Z = (Z + inverse(Z)).eval() / 2;
  Z.diagonal().array() += 1;
  Eigen::Vector4d K;
  for (int row = 0; row < 4; ++row) {
    const Eigen::VectorXd columnOfP = leastSquares(Z.rightCols(4), -Z.col(row));
    K[row] = system.B.dot(columnOfP) / R;
  }
  return K;
  // <todo>
  //| // TODO: solve 0 = A^T P + P A - P B B^T P / R + Q for P, which gives K. inverse(), solve() may help.
  //| return Eigen::Vector4d::Zero();
  // </solution>
}

Eigen::VectorXd featuresAt(const Eigen::Vector4d& y, const Eigen::VectorXd& before, double u, double tau) {
  // <solution featuresAt>
  const bool isFirst = before.size() == 0;
  Eigen::VectorXd now = Eigen::VectorXd::Zero(kFeatures);
  now[0] = 1;
  now.segment<4>(1) = now.segment<4>(9) = now.segment<4>(17) = y;
  if (isFirst) return now;
  now.segment<4>(5) = (y - before.segment<4>(1)) / tau;
  now.segment<8>(9) = .5 * before.segment<8>(9) + .5 * now.segment<8>(1);
  now.segment<8>(17) = .9 * before.segment<8>(17) + .1 * now.segment<8>(1);
  now[25] = u;
  now[26] = before[25];
  return now;
  // <todo>
  //| // TODO: 27 numbers; the first reading is a special case.
  //| return Eigen::VectorXd::Zero(kFeatures);
  // </solution>
}

Ride rideOf(const Eigen::VectorXd& w, const Eigen::Vector4d& start, const Eigen::MatrixXd& noise,
            const RacerModel& racer, const RacerSensors& sensors) {
  // <solution rideOf>
  const Eigen::Index T = noise.cols();
  Ride ride{Eigen::MatrixXd(4, T + 1), Eigen::VectorXd(T), 0};
  ride.states.col(0) = start;
  Eigen::Vector4d x = start;
  Eigen::VectorXd features;
  double u = 0;
  Eigen::Index n = 0;
  for (bool stands = true; stands && n < T; ++n) {
    features = featuresAt(sensors.measured(x, racer.r), features, u, kTau);
    u = std::clamp(w.dot(features), -kLargestControl, kLargestControl);
    x = stepped(x, u, kTau, racer);
    x.tail<2>() += noise.col(n);
    ride.controls[n] = u;
    ride.states.col(n + 1) = x;
    stands = std::abs(x[1]) <= kLargestAngle;
    ride.cost += stands ? x[0] * x[0] + 10 * x[1] * x[1] : kCostOfMissing * static_cast<double>(T - n);
  }
  ride.states.conservativeResize(4, n + 1);
  ride.controls.conservativeResize(n);
  return ride;
  // <todo>
  //| // TODO: step by step, until the time is over or the racer has failed.
  //| return {start, Eigen::VectorXd(0), 0};
  // </solution>
}

Species nextSpecies(const Species& species, const Eigen::MatrixXd& X, const Eigen::VectorXd& costs, int mu) {
  // <solution nextSpecies>
  std::vector<Eigen::Index> order(static_cast<std::size_t>(costs.size()));
  std::iota(order.begin(), order.end(), 0);
  std::ranges::sort(order, {}, [&](Eigen::Index i) { return costs[i]; });
  order.resize(static_cast<std::size_t>(mu));
  const double n = static_cast<double>(X.rows()), c = 1 / std::sqrt(n);
  Species next;
  next.mean = X(Eigen::all, order).rowwise().mean();
  const Eigen::VectorXd step = (next.mean - species.mean) / species.deviation;
  next.path = (1 - c) * species.path + std::sqrt(c * (2 - c) * mu) * step;
  next.deviation = species.deviation * std::exp(c / 2 * (next.path.squaredNorm() / n - 1));
  return next;
  // <todo>
  //| // TODO: which samples are the best, and where is their mean? Then path and deviation.
  //| return species;
  // </solution>
}

Species evolved(const Costs& costs, const Species& start, int mu, int lambda, int generations, Rng& rng) {
  // <solution evolved>
  const int n = static_cast<int>(start.mean.size());
  Species species = start;
  for (int i = 0; i < generations; ++i) {
    Eigen::MatrixXd X = species.mean.replicate(1, lambda);
    X += species.deviation * rng.normalVector(n * lambda).reshaped(n, lambda);
    species = nextSpecies(species, X, costs(X), mu);
  }
  return species;
  // <todo>
  //| // TODO: sample, ask for the costs, select.
  //| return start;
  // </solution>
}

Eigen::VectorXd searchedPolicy(const Rides& rides, int budget, Rng& rng) {
  // <solution searchedPolicy>
  constexpr int kSearches = 2, kSamples = 20, kRepeats = 4, kTests = 50, kSearched = 9;
  // Of 1, y and its rates: these tell how fast the wheel turns, and are a hundred times as large.
  Eigen::VectorXd deviations = Eigen::VectorXd::Constant(kSearched, .3);
  deviations.tail(4) *= kTau;
  const int generations = (budget / kSearches - kTests) / (kSamples * kRepeats);
  Eigen::MatrixXd found = Eigen::MatrixXd::Zero(kFeatures, kSearches);
  for (int k = 0; k < kSearches; ++k) {
    SearchCma cma(rng.next());
    cma.init(Eigen::VectorXd::Zero(kSearched), -1, kSamples, deviations);
    Eigen::MatrixXd samples, W = Eigen::MatrixXd::Zero(kFeatures, kSamples);
    Eigen::VectorXd values;
    for (int i = 0; i < generations; ++i) {
      cma.step(samples, values);
      W.topRows(kSearched) = samples.transpose();
      const int steps = std::min(kLongestRide, static_cast<int>(50 * std::pow(30., 1. * i / generations)));
      values.setZero();
      for (int j = 0; j < kRepeats; ++j) values += rides(W, steps);
    }
    cma.step(samples, values);
    found.col(k).head(kSearched) = cma.getMean();
  }
  Eigen::VectorXd costs = Eigen::VectorXd::Zero(kSearches);
  for (int j = 0; j < kTests; ++j) costs += rides(found, kLongestRide);
  int best = 0;
  costs.minCoeff(&best);
  return found.col(best);
  // <todo>
  //| // TODO: SearchCma or evolved() proposes, rides() judges. Which features, how many steps, how often?
  //| return Eigen::VectorXd::Zero(kFeatures);
  // </solution>
}

double sensedCost(const Eigen::MatrixXd& Y, int steps) {
  // <solution sensedCost>
  return Y.row(2).squaredNorm() + Y.row(3).squaredNorm() / 10 +
         kCostOfMissing * static_cast<double>(steps - Y.cols());
  // <todo>
  //| // TODO: the cost of the readings, and that of the steps without one.
  //| return 0;
  // </solution>
}

Eigen::Vector2d sensedPose(const Eigen::Vector4d& y, const RacerModel& racer, const RacerSensors& sensors) {
  // <solution sensedPose>
  const double spin = y[2] + sensors.gyroBias, pull = sensors.kappa * spin * spin;
  const double theta =
      std::atan2(y[1] + pull * std::sin(sensors.phi), y[0] + pull * std::cos(sensors.phi)) - sensors.phi;
  return {racer.r * (y[3] + theta), theta};
  // <todo>
  //| // TODO: solve the formulas of y for theta', theta and x, in this order.
  //| return Eigen::Vector2d::Zero();
  // </solution>
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
