#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "course/course.h"

// The functions you complete in main.cpp. Metres, seconds, kilograms, newtons, radians. n is the number of
// states, m that of controls. Everywhere the controller is u = K x with K (m x n): the sign of 12.11 and
// 8:43, not that of 8:18. Slides are named as chapter:number.

// Part 1, the cart pole and its linearisation (12.11.1 a).

/// A pole on a cart. Its state is x = (p, p', theta, theta'): where the cart is, and how far the pole leans
/// from upright.
struct PoleCart {
  double poleMass = 1;  ///< M_p
  double cartMass = 1;  ///< M_c
  double l = 1;
  double g = 9.8;  ///< m/s^2
};

/// x' under the force u on the cart: eqs. (13) and (14).
Eigen::Vector4d rateOf(const PoleCart& cart, const Eigen::Vector4d& x, double u);

/// x' = A x + B u; where it says so x_{t+1} = A x_t + B u_t.
struct Plant {
  Eigen::MatrixXd A;  ///< n x n
  Eigen::MatrixXd B;  ///< n x m
};

/// The derivatives of rateOf() by x and by u at x = 0, u = 0, exact up to rounding.
Plant linearised(const PoleCart& cart);

// Part 2, the algebraic Riccati equation (12.11.1 b, c; 8:19).

/// x^T Q x + u^T R u, both symmetric.
struct Costs {
  Eigen::MatrixXd Q;  ///< n x n, no eigenvalue is negative
  Eigen::MatrixXd R;  ///< m x m, all eigenvalues are positive
};

/// The iteration of 12.11.1 b from P_0 = Q. It ends with the first of P_0, P_1, ..., P_most for which no
/// number in the bracket is larger than `tolerance` in size, and returns it; nothing if there is none.
std::optional<Eigen::MatrixXd> iterated(const Plant& plant, const Costs& costs, double epsilon,
                                        double tolerance, int most);

/// The symmetric P that solves the equation and makes the closed loop stable, from the stable half of the
/// Hamiltonian matrix; the bracket is zero up to 1e-9 of its largest term. There is such a P, also where u
/// does not reach all of x (what it does not reach dies by itself), and the closed loop then has no pole near
/// the imaginary axis. Poles may differ in size by a factor of 1e4.
Eigen::MatrixXd viaHamiltonian(const Plant& plant, const Costs& costs);

/// The K (m x n) that belongs to P, for u = K x.
Eigen::MatrixXd gainOf(const Plant& plant, const Costs& costs, const Eigen::MatrixXd& P);

// Part 3, simulation with noise (12.11.1 d).

/// One step of tau seconds of explicit Euler from x under u: all of it moves with the rates before the step.
/// Then noise * rng.normal() is added to p', and after that noise * rng.normal() to theta'.
Eigen::Vector4d stepped(const PoleCart& cart, const Eigen::Vector4d& x, double u, double tau, double noise,
                        rex::Rng& rng);

/// How long and in which world one balances.
struct Outing {
  double tau = 1. / 60;
  double noise = 0.1;
  int steps = 3000;
};

/// The states of an outing with u = K x, one per column, `start` first: steps + 1 of them, or fewer, because
/// the first with |theta| > pi / 2 is the last. A start is never as far as that.
Eigen::MatrixXd balanced(const PoleCart& cart, const Eigen::MatrixXd& K, const Eigen::Vector4d& start,
                         const Outing& outing, rex::Rng& rng);

// Part 4, controllability (8:27).

/// (B, A B, ..., A^(n-1) B), n x n m.
Eigen::MatrixXd reachMatrix(const Plant& plant);

/// Its rank, where singular values below 1e-9 of the largest count as zero. B is not zero.
int reachable(const Plant& plant);

// Part 5, poles (8:36).

/// The largest real part of the eigenvalues of the closed loop of u = K x.
double slowestPole(const Plant& plant, const Eigen::MatrixXd& K);

enum class Fate {
  dies,   ///< all motions of x' = A x end at zero
  stays,  ///< none grows beyond all bounds, some do not end at zero
  grows   ///< some grow beyond all bounds, be it slowly
};

/// What becomes of the motions of x' = A x. Real parts below 1e-5 in size count as zero, and so do distances
/// of eigenvalues below 1e-4; all others are above 0.01.
Fate fateOf(const Eigen::MatrixXd& A);

// Part 6, the fastest controller (8:39).

/// A K (1 x n) with no number larger than `bound` in size, for which slowest(K), the slowestPole() of some
/// plant, is 0.5 times the least possible one or lower. `start` (1 x n) is within the bound, and stable. You
/// may ask slowest() 3000 times.
Eigen::MatrixXd quickGains(const std::function<double(const Eigen::MatrixXd&)>& slowest,
                           const Eigen::MatrixXd& start, double bound, rex::Rng& rng);

// Part 7, Lyapunov's second method (8:40).

/// A rate f(x) of all states x, with f(0) = 0: x' = f(x).
using Flow = std::function<Eigen::VectorXd(const Eigen::VectorXd& x)>;

/// A point that disproves V = x^T P x (P symmetric) in the box |x_i| <= high_i: x is not 0, and V(x) <= 0 or
/// V'(x) >= 0. Nothing if you find none. Find one where such points fill 1 % of the box, and where they lie
/// on its axes, on which only one x_i is not zero. You may ask f 20000 times.
std::optional<Eigen::VectorXd> counterexample(const Flow& f, const Eigen::MatrixXd& P,
                                              const Eigen::VectorXd& high, rex::Rng& rng);

/// The largest c for which all x with x^T P x <= c lie in the box. P is symmetric and positive definite.
double levelInside(const Eigen::MatrixXd& P, const Eigen::VectorXd& high);

// Part 8, a finite horizon (8:19).

/// The gains u_t = K[t] x_t, t = 0, ..., steps - 1, of a plant x_{t+1} = A x_t + B u_t, for which the costs
/// of x_t and u_t, summed over these steps, and x^T F x of the last state are together least. F is symmetric,
/// no eigenvalue is negative.
std::vector<Eigen::MatrixXd> gainsOverTime(const Plant& plant, const Costs& costs, const Eigen::MatrixXd& F,
                                           int steps);
