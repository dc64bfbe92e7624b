#pragma once

#include <functional>
#include <vector>

#include "course/course.h"

// The functions you complete in main.cpp. Matrices are written rows x columns. As in the script, the
// derivative of a number with respect to x is a row (1 x n), and that of d numbers is d x n. Slides are cited
// as chapter:number.

// Part 1, matrix equations and vector derivatives (12.1.1, 12.1.2).

/// 12.1.1 a: the X with X A + A^T = Id, for an invertible A (n x n).
Eigen::MatrixXd equationA(const Eigen::MatrixXd& A);

/// 12.1.1 b: the X (n x m) with X^T C = (2 A (X + B))^T, for A and C (n x n) and B (n x m) such that
/// C - 2 A^T is invertible.
Eigen::MatrixXd equationB(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B, const Eigen::MatrixXd& C);

/// 12.1.1 c: the x (n) with (A x - y)^T A = 0, for y (d) and A (d x n) with independent columns.
Eigen::VectorXd equationC(const Eigen::MatrixXd& A, const Eigen::VectorXd& y);

/// 12.1.1 d: the x (n) with (A x - y)^T A + x^T B = 0, for y (d), any A (d x n) and a symmetric and positive
/// definite B (n x n).
Eigen::VectorXd equationD(const Eigen::MatrixXd& A, const Eigen::VectorXd& y, const Eigen::MatrixXd& B);

/// What a function R^n -> R^d returns at one x: its value y (d) and its derivative J (d x n).
struct Evaluation {
  Eigen::VectorXd y;
  Eigen::MatrixXd J;
};

/// 12.1.2 d: the derivative (1 x n) of f(x)^T C g(x) with respect to x, for any C (d x d), given what f and g
/// (both R^n -> R^d) return at x.
Eigen::MatrixXd productDerivative(const Evaluation& f, const Eigen::MatrixXd& C, const Evaluation& g);

/// Where a function has its minimum, and its value there.
struct Minimum {
  Eigen::VectorXd x;
  double value = 0;
};

/// 12.1.2 e: the minimum over x (n) of (A x - y)^T C (A x - y) + x^T B x, for y (d), A (d x n) and symmetric,
/// positive definite C (d x d) and B (n x n).
Minimum quadraticMinimum(const Eigen::MatrixXd& A, const Eigen::VectorXd& y, const Eigen::MatrixXd& C,
                         const Eigen::MatrixXd& B);

// Part 2, optimisation (12.1.3). Both methods return all points x_0, x_1, ... they visited, the start first
// and rejected trials left out. They stop as soon as the gradient is no longer than `tolerance`, or after
// `maxSteps` steps. For a direction d, a step to x + alpha d is accepted if (Armijo, 1966)
//   f(x + alpha d) <= f(x) + decrease * alpha * (gradient of f at x)^T d
// and otherwise tried again with alpha * shrink. f may be infinite somewhere: never accept a step there.

struct SearchOptions {
  double shrink = 0.5;
  double grow = 1.2;
  double decrease = 0.01;
  double tolerance = 1e-6;
  int maxSteps = 1000;
};

using ScalarFunction = std::function<double(const Eigen::VectorXd&)>;
using MatrixFunction = std::function<Eigen::MatrixXd(const Eigen::VectorXd&)>;

/// Minimises f by steps along d = -gradient(x), which is a column here (n). The first step tries alpha = 1
/// first; every later step first tries the alpha that the step before accepted, times `grow`.
std::vector<Eigen::VectorXd> gradientDescent(const ScalarFunction& f, const rex::VectorFunction& gradient,
                                             const Eigen::VectorXd& start, const SearchOptions& options);

/// Minimises f(x) = phi(x)^T phi(x) by steps along the d with J^T J d = -J^T phi, where J(x) is the
/// derivative of phi and has independent columns. Every step tries alpha = 1 first; `grow` is not needed.
std::vector<Eigen::VectorXd> gaussNewton(const rex::VectorFunction& phi, const MatrixFunction& J,
                                         const Eigen::VectorXd& start, const SearchOptions& options);

// Part 3, the book on the table (12.2.1), in the plane. X_AB is the homogeneous transform (3 x 3) that takes
// coordinates in frame B to coordinates in frame A: (p_A, 1) = X_AB (p_B, 1). W is the world, lengths are
// metres.

/// X_WB of a book B that lay in W, was moved by `move` (in W) and then turned by `angle` [rad]
/// counter-clockwise about its own origin.
Eigen::Matrix3d bookPose(const Eigen::Vector2d& move, double angle);

/// p_A of a point p_B.
Eigen::Vector2d mapped(const Eigen::Matrix3d& X_AB, const Eigen::Vector2d& p_B);

/// X_BA, the inverse transform. Any way to compute it counts, even `inverse(X_AB)`.
Eigen::Matrix3d inverted(const Eigen::Matrix3d& X_AB);

/// X_AB: frame B as seen from frame A, given the poses of both in the world.
Eigen::Matrix3d seenFrom(const Eigen::Matrix3d& X_WA, const Eigen::Matrix3d& X_WB);

// Part 4, Bayes (12.8.1, slides 6:8 to 6:10).

struct Fruit {
  double apple = 0;               ///< P(apple)
  Eigen::VectorXd boxGivenApple;  ///< P(box | apple), one entry for each box
};

/// 12.8.1 a: box i holds apples[i] apples and oranges[i] oranges. A box is drawn, all with equal probability,
/// then a fruit from it, all with equal probability. No box is empty, and at least one has an apple.
Fruit fruitBoxes(const std::vector<int>& apples, const std::vector<int>& oranges);

struct Doors {
  double stay = 0;  ///< P(prize) if you keep your first choice
  double swap = 0;  ///< P(prize) if you switch to one of the other closed boxes, at random
};

/// 12.8.1 b: one of `boxes` boxes holds the prize, and you choose one. The host, who knows where the prize
/// is, opens `opened` of the other boxes, at random among the empty ones; at least one other box stays
/// closed.
Doors montyHall(int boxes, int opened);

struct TableAnswers {
  Eigen::VectorXd PX;        ///< P(X), one entry for each row
  Eigen::VectorXd PY;        ///< P(Y), one entry for each column
  Eigen::MatrixXd XGivenY;   ///< P(X | Y), of the same shape as the table
  bool independent = false;  ///< are X and Y independent, up to 1e-9 in every entry of the table?
};

/// 12.8.1 c: the questions about a joint distribution P(X, Y): its rows are the values of X, its columns
/// those of Y. Every value of X and Y has a positive probability.
TableAnswers jointTable(const Eigen::MatrixXd& P_XY);

// Part 5, beliefs: Gaussians (12.8.2, slides 6:27 and 6:28) and conjugate priors (slides 6:14 to 6:24).

/// N(mean, cov) over R^n: mean (n), covariance (n x n), symmetric and positive definite.
struct GaussianBelief {
  Eigen::VectorXd mean;
  Eigen::MatrixXd cov;
};

/// The Gaussian that is proportional to p(x) q(x), both over R^n.
GaussianBelief product(const GaussianBelief& p, const GaussianBelief& q);

/// The distribution of x (m) = a + F y + w, for y (n) distributed as `y`, independent noise w ~ N(0, A), a
/// (m) and F (m x n).
GaussianBelief propagated(const GaussianBelief& y, const Eigen::VectorXd& a, const Eigen::MatrixXd& F,
                          const Eigen::MatrixXd& A);

/// Beta(mu | a, b), the belief about mu = P(x = 1), as on slide 6:15; a, b > 0.
struct BetaBelief {
  double a = 1;
  double b = 1;
};

/// The belief after any number of outcomes x_i, each 0 or 1.
BetaBelief betaPosterior(const BetaBelief& prior, const std::vector<int>& data);

/// The parameters (K) of the belief Dir(mu | alpha) after any number of outcomes x_i, each one of 1, ..., K.
Eigen::VectorXd dirichletPosterior(const Eigen::VectorXd& alpha, const std::vector<int>& data);

/// P(next outcome = k), k = 1, ..., K, under the belief Dir(mu | alpha).
Eigen::VectorXd nextOutcome(const Eigen::VectorXd& alpha);
