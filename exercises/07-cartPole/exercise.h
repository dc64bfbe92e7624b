#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "course/course.h"

// The functions you complete in main.cpp. Metres, seconds, kilograms, newtons, radians. n is the number of
// states, m that of controls. Everywhere the controller is u = K x with K (m x n): the sign of 12.11 and
// 8:43, not that of 8:18. Slides are named as chapter:number.

// Part 1, the cart pole and its linearisation (12.11.1 a).

/// A pole on a cart. Its state is x = (p, p', theta, theta'): the position of the cart, the angle of the
/// pole from upright, and their rates.
struct PoleCart {
  double poleMass = 1;  ///< M_p
  double cartMass = 1;  ///< M_c
  double l = 1;         ///< from the hinge to the centre of the pole, which is uniform and 2 l long [m]
  double g = 9.8;       ///< m/s^2
};

/// x' under the force u on the cart: eqs. (13) and (14).
Eigen::Vector4d rateOf(const PoleCart& cart, const Eigen::Vector4d& x, double u);

/// x' = A x + B u, or x_{t+1} = A x_t + B u_t where stated.
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

/// The iteration of 12.11.1 b from P_0 = Q. Returns the first of P_0, P_1, ..., P_most for which no entry
/// of D = A^T P + P A - P B R^-1 B^T P + Q is larger than `tolerance` in size, or nothing if there is none.
std::optional<Eigen::MatrixXd> iterated(const Plant& plant, const Costs& costs, double epsilon,
                                        double tolerance, int most);

/// The symmetric P that solves the equation and makes the closed loop stable, from the stable half of the
/// Hamiltonian matrix; D is zero up to 1e-9 of its largest term. If u does not reach all of x, the rest
/// decays by itself, so that P exists. The closed loop has no pole near the imaginary axis. Poles may differ
/// in size by a factor of 1e4.
Eigen::MatrixXd viaHamiltonian(const Plant& plant, const Costs& costs);

/// The K (m x n) that belongs to P, for u = K x.
Eigen::MatrixXd gainOf(const Plant& plant, const Costs& costs, const Eigen::MatrixXd& P);

// Part 3, simulation with noise (12.11.1 d).

/// One explicit Euler step of tau seconds from x under u: all states move with the rates before the step.
/// Then noise * rng.normal() is added to p', and after that noise * rng.normal() to theta'.
Eigen::Vector4d stepped(const PoleCart& cart, const Eigen::Vector4d& x, double u, double tau, double noise,
                        rex::Rng& rng);

/// Step size [s], noise and length of an attempt to balance the pole.
struct Outing {
  double tau = 1. / 60;
  double noise = 0.1;
  int steps = 3000;
};

/// The states of an outing with u = K x, one per column, `start` first. There are steps + 1 of them, or
/// fewer: the first with |theta| > pi / 2 is the last. The start is always within this limit.
Eigen::MatrixXd balanced(const PoleCart& cart, const Eigen::MatrixXd& K, const Eigen::Vector4d& start,
                         const Outing& outing, rex::Rng& rng);

// Part 4, controllability (8:27).

/// (B, A B, ..., A^(n-1) B), n x n m.
Eigen::MatrixXd reachMatrix(const Plant& plant);

/// Its rank, where singular values below 1e-9 of the largest count as zero. B is not zero.
int reachable(const Plant& plant);

// Part 5, poles (8:36), and the fastest controller (8:39).

/// The largest real part of the eigenvalues of the closed loop of u = K x.
double slowestPole(const Plant& plant, const Eigen::MatrixXd& K);

enum class Fate {
  dies,   ///< all motions of x' = A x converge to zero
  stays,  ///< all are bounded, some do not converge to zero
  grows   ///< some grow without bound, even if slowly
};

/// The fate of the motions of x' = A x. Real parts below 1e-5 in size count as zero, and so do distances
/// between eigenvalues below 1e-4; all others are above 0.01.
Fate fateOf(const Eigen::MatrixXd& A);

/// A K (1 x n) with no entry larger than `bound` in size, for which slowest(K), the slowestPole() of some
/// plant, is at most half of the lowest possible value, which is negative. `start` (1 x n) is within the
/// bound, and stable.
/// You may call slowest() 3000 times.
Eigen::MatrixXd quickGains(const std::function<double(const Eigen::MatrixXd&)>& slowest,
                           const Eigen::MatrixXd& start, double bound, rex::Rng& rng);

// Part 6, what a sensor sees (8:3, 8:44). p is the number of measurements, y = C x with C (p x n).

/// An orthonormal basis (n x k) of the states that y never shows: from there y stays zero if u does. k may
/// be 0. Singular values below 1e-9 of the largest count as zero, as in part 4. C is not zero.
Eigen::MatrixXd unseen(const Eigen::MatrixXd& A, const Eigen::MatrixXd& C);

/// Intensities of white noise, both symmetric.
struct Noise {
  Eigen::MatrixXd W;  ///< n x n, of w in x' = A x + B u + w; no eigenvalue is negative
  Eigen::MatrixXd V;  ///< p x p, of v in y = C x + v; all eigenvalues are positive
};

/// The L (n x p) with which the observer x^' = A x^ + B u + L (y - C x^) has the smallest error x - x^ in the
/// long run: its covariance S is minimal. Relative accuracy 1e-7. Such an L exists even if y does not show
/// all of x, because what it does not show decays by itself. A - L C has no pole near the imaginary axis.
Eigen::MatrixXd observerGain(const Eigen::MatrixXd& A, const Eigen::MatrixXd& C, const Noise& noise);

/// The matrix (2 n x 2 n) that moves (x, x^), first x, if u = K x^. The plant is `real`, y = C x has no
/// noise, and the observer knows y and u, and takes the plant to be `model`.
Eigen::MatrixXd observedLoop(const Plant& real, const Plant& model, const Eigen::MatrixXd& C,
                             const Eigen::MatrixXd& K, const Eigen::MatrixXd& L);

/// The frequency response G(i w) = C (i w - A)^-1 B from one control to one measurement, at N frequencies w
/// [rad/s]: real parts in the first row, imaginary parts in the second (2 x N). No i w is near an eigenvalue
/// of A. Relative accuracy 1e-6.
Eigen::MatrixXd responseAt(const Plant& plant, const Eigen::MatrixXd& C, const Eigen::VectorXd& frequencies);
