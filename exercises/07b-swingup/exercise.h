#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <optional>
#include <vector>

#include "course/course.h"

// The functions you complete in main.cpp. Metres, seconds, kilograms, newtons, radians. Everywhere the linear
// controller is u = K x, as in 07 and on 8:43. Slides are named as chapter:number.

/// A point mass on a rod without mass, with a motor at the hinge. Its state is x = (theta, theta'): the angle
/// from upright, to which whole turns may have been added, and its rate.
struct Pendulum {
  double mass = 1;       ///< m
  double length = 1;     ///< l
  double friction = .1;  ///< b, N m s
  double g = 9.81;       ///< m/s^2
  double strongest = 3;  ///< N m: the torque u of the motor is between -strongest and strongest
};

/// Given: x' under the torque u, m l^2 theta'' = m g l sin(theta) - b theta' + u.
inline Eigen::Vector2d rateOf(const Pendulum& p, const Eigen::Vector2d& x, double u) {
  const double inertia = p.mass * p.length * p.length;
  return {x[1], (p.mass * p.g * p.length * std::sin(x[0]) - p.friction * x[1] + u) / inertia};
}

/// Given: the state after the torque u has been held for tau seconds, by the midpoint rule.
inline Eigen::Vector2d nextOf(const Pendulum& p, const Eigen::Vector2d& x, double u, double tau) {
  const Eigen::Vector2d middle = x + tau / 2 * rateOf(p, x, u);
  return x + tau * rateOf(p, middle, u);
}

/// Given: the cost per second. It is zero only upright, at rest and without torque.
inline double costOf(const Eigen::Vector2d& x, double u, double effort) {
  return 2 * (1 - std::cos(x[0])) + .05 * x[1] * x[1] + effort * u * u;
}

// Part 1, Bellman's equation on a grid (8:8 to 8:14).

/// Nodes at the angles -pi + 2 pi i / angles, i = 0, ..., angles - 1, and at `rates` rates from -fastest to
/// fastest, both ends included, at equal distances. Values V are a matrix, angles x rates.
struct Grid {
  int angles = 60;
  int rates = 61;
  double fastest = 9;
};

/// V at any state: bilinear between the four nodes around it. Angles go round: the node after the last is the
/// first, and whole turns make no difference. Beyond the fastest rates V is what it is at those.
double valueAt(const Grid& grid, const Eigen::MatrixXd& V, const Eigen::Vector2d& x);

/// The problem in discrete time: a torque is held for tau seconds and costs tau costOf(x, u, effort). What
/// comes after a step counts `discount` times. There are `torques` to choose from, at least 2, at equal
/// distances from -strongest to strongest, both ends included.
struct Decision {
  Pendulum pendulum{};
  Grid grid{};
  double tau = .05;
  double effort = .02;
  double discount = .995;
  int torques = 9;
};

/// One sweep of Bellman's equation (8:9, 8:12). V holds the values after the step; returns at each node the
/// minimum over the torques of tau costOf(x, u, effort) + discount V(nextOf(x, u)).
Eigen::MatrixXd swept(const Decision& decision, const Eigen::MatrixXd& V);

/// The torque with which that minimum is reached at x, any state. If several reach it, any of them.
double bestTorque(const Decision& decision, const Eigen::MatrixXd& V, const Eigen::Vector2d& x);

// Part 2, a finite horizon (8:14, 8:19): the same equation where values are quadratic, x^T P x.

/// x_{t+1} = A x_t + B u_t.
struct Plant {
  Eigen::MatrixXd A;  ///< n x n
  Eigen::MatrixXd B;  ///< n x m
};

/// x^T Q x + u^T R u, both symmetric.
struct Costs {
  Eigen::MatrixXd Q;  ///< n x n, no eigenvalue is negative
  Eigen::MatrixXd R;  ///< m x m, all eigenvalues are positive
};

/// The gains u_t = K[t] x_t, t = 0, ..., steps - 1. They minimise the costs of x_t and u_t, summed over these
/// steps, plus x^T F x of the last state. F is symmetric and has no negative eigenvalue.
std::vector<Eigen::MatrixXd> gainsOverTime(const Plant& plant, const Costs& costs, const Eigen::MatrixXd& F,
                                           int steps);

// Part 3, energy shaping.

/// Kinetic and potential energy [J]; zero upright and at rest.
double energyOf(const Pendulum& pendulum, const Eigen::Vector2d& x);

/// The torque with which the energy changes at the rate E' = -gain theta'^2 E, friction included; if the
/// motor is too weak for it, the one nearest to it. At rest: 0.
double pumpTorque(const Pendulum& pendulum, double gain, const Eigen::Vector2d& x);

// Part 4, Lyapunov's second method (8:40 to 8:43).

/// A rate f(x) of all states x, with f(0) = 0: x' = f(x).
using Flow = std::function<Eigen::VectorXd(const Eigen::VectorXd& x)>;

/// A point that disproves V = x^T P x (P symmetric) in the box |x_i| <= high_i: x is not 0, and V(x) <= 0
/// or V'(x) >= 0 as computed, without a tolerance. Returns nothing if you find none. You must find one if
/// such points fill 1 % of the box, or a tenth of an axis: the segment |x_i| <= high_i on which all other x
/// are 0. You may call f 20000 times.
std::optional<Eigen::VectorXd> counterexample(const Flow& f, const Eigen::MatrixXd& P,
                                              const Eigen::VectorXd& high, rex::Rng& rng);

/// The largest c for which all x with x^T P x <= c lie in the box. P is symmetric and positive definite.
double levelInside(const Eigen::MatrixXd& P, const Eigen::VectorXd& high);

// Part 5, the catch.

/// For a system with two state variables: the largest c such that V = x^T P x falls, V' < 0, wherever
/// 0 < V(x) <= c; at most 2 % too large and 10 % too small. P is positive definite, 1.02 c < most, near 0 V
/// falls, and on at least 2 % of the ellipse V(x) = 1.02 c it does not. You may call f 100000 times.
double fallingLevel(const Flow& f, const Eigen::Matrix2d& P, double most);

/// Pumping as in part 3 with this gain, but a linear controller in every step in which x^T P x < level.
struct Swing {
  double gain = 1;
  Eigen::RowVector2d K{0, 0};  ///< u = K x, limited to -strongest ... strongest
  Eigen::Matrix2d P = Eigen::Matrix2d::Zero();
  double level = 0;
  double tau = .01;
};

/// The states of a motion, one per column, `start` first: steps + 1 of them, each nextOf() the one before.
/// The controllers get an angle from -pi to pi; the states keep their whole turns.
Eigen::MatrixXd swungUp(const Pendulum& pendulum, const Swing& swing, const Eigen::Vector2d& start,
                        int steps);

// Part 6, a bonus: a plan (8:22; iterative LQR, Li and Todorov 2004).

/// The torques U = (u_0, ..., u_{N-1}) move x_0 = start by nextOf(), with no limit on the torque, and cost
/// the sum of tau costOf(x_t, u_t, effort), t = 0, ..., N - 1, plus last * costOf(x_N, 0, 0).
struct Journey {
  Pendulum pendulum{};
  Eigen::Vector2d start{std::numbers::pi, 0};
  double tau = .05;
  double effort = .1;
  double last = 20;
};

/// Given: nextOf(x + dx, u + du) is nextOf(x, u) + A dx + B du to first order; A and B are exact derivatives.
inline Plant stepNear(const Pendulum& p, const Eigen::Vector2d& x, double u, double tau) {
  const Eigen::Vector2d middle = x + tau / 2 * rateOf(p, x, u);
  const double inertia = p.mass * p.length * p.length;
  Eigen::Matrix2d F{{0, 1}, {p.g / p.length * std::cos(x[0]), -p.friction / inertia}}, M = F;
  M(1, 0) = p.g / p.length * std::cos(middle[0]);
  const Eigen::Vector2d b(0, 1 / inertia), half = tau / 2 * b, through = M * half;
  const Eigen::Matrix2d MF = M * F;
  return {Eigen::Matrix2d::Identity() + tau * M + tau * tau / 2 * MF, tau * (through + b)};
}

/// Given: x_0, ..., x_N, one per column, and what the torques cost.
inline Eigen::MatrixXd statesOf(const Journey& journey, const Eigen::VectorXd& U) {
  Eigen::MatrixXd X(2, U.size() + 1);
  X.col(0) = journey.start;
  for (Eigen::Index t = 0; t < U.size(); ++t)
    X.col(t + 1) = nextOf(journey.pendulum, X.col(t), U[t], journey.tau);
  return X;
}
inline double priceOf(const Journey& journey, const Eigen::VectorXd& U) {
  const Eigen::MatrixXd states = statesOf(journey, U);
  double price = journey.last * costOf(states.col(U.size()), 0, 0);
  for (Eigen::Index t = 0; t < U.size(); ++t)
    price += journey.tau * costOf(states.col(t), U[t], journey.effort);
  return price;
}

/// The derivatives of the cost by each torque (N numbers).
Eigen::VectorXd costSlope(const Journey& journey, const Eigen::VectorXd& U);

/// Torques that cost less than U, with each |slope| <= 1e-3. N is at most 40 in the checks, and 80 in main().
Eigen::VectorXd planned(const Journey& journey, const Eigen::VectorXd& U);
