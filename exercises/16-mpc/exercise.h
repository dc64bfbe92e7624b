#pragma once

#include <functional>

#include "course/course.h"

// The functions you complete in main.cpp. n is the number of states, m that of controls, N that of steps
// that are planned. A plan U consists of u_0, ..., u_{N-1}, one below the other: N m numbers. Slides are
// named as chapter:number.

/// A linear system in discrete time: x_{t+1} = A x_t + B u_t.
struct Plant {
  Eigen::MatrixXd A;  ///< n x n
  Eigen::MatrixXd B;  ///< n x m
};

// Part 1, prediction (8:15).

/// x_1, ..., x_N, one below the other, are Sx x_0 + Su U.
struct Prediction {
  Eigen::MatrixXd Sx;  ///< N n x n
  Eigen::MatrixXd Su;  ///< N n x N m
};
Prediction predicted(const Plant& plant, int N);

// Part 2, the cost of a plan (8:11 to 8:13).

/// A plan costs x_t^T Q x_t + u_t^T R u_t, summed over t = 0, ..., N - 1, plus x_N^T F x_N. All three are
/// symmetric; Q and F have no negative eigenvalue, those of R are positive.
struct Costs {
  Eigen::MatrixXd Q;  ///< n x n
  Eigen::MatrixXd R;  ///< m x m
  Eigen::MatrixXd F;  ///< n x n
};

/// 1/2 z^T H z + g^T z, with a symmetric, positive definite H.
struct Quadratic {
  Eigen::MatrixXd H;
  Eigen::VectorXd g;
};

/// The cost of each plan U from x_0 = x, except for a constant.
Quadratic planCost(const Plant& plant, const Costs& costs, int N, const Eigen::VectorXd& x);

/// The F for which x^T F x is the minimum cost from x over an infinite horizon. Exact to 1e-6 of
/// its largest entry. All eigenvalues of the best closed loop are at most 0.97 in size.
Eigen::MatrixXd costToGo(const Plant& plant, const Eigen::MatrixXd& Q, const Eigen::MatrixXd& R);

// Part 3, bounds.

/// By how much each z_i would have to move to reach its optimum between its bounds while all others are
/// fixed: one signed number for each. lower <= z <= upper; bounds may be equal, or infinite.
Eigen::VectorXd bestMoves(const Quadratic& cost, const Eigen::VectorXd& lower, const Eigen::VectorXd& upper,
                          const Eigen::VectorXd& z);

/// The z with lower <= z <= upper of least cost; its bestMoves() are at most 1e-8 in size. There are up to 60
/// numbers, and the largest eigenvalue of H is at most 10000 times the smallest.
Eigen::VectorXd boxed(const Quadratic& cost, const Eigen::VectorXd& lower, const Eigen::VectorXd& upper);

// Part 4, model-predictive control.

/// What is planned in each step: N steps, with uMin <= u_t <= uMax. The H of its plans is as in boxed().
struct Task {
  Plant plant{};
  Costs costs{};
  int N = 20;
  Eigen::VectorXd uMin{}, uMax{};  ///< m each
};

/// The cheapest plan from x within the bounds: column t is u_t (m x N).
Eigen::MatrixXd planned(const Task& task, const Eigen::VectorXd& x);

struct Drive {
  Eigen::MatrixXd X;  ///< n x (T + 1): x_0, ..., x_T
  Eigen::MatrixXd U;  ///< m x T: u_0, ..., u_{T-1}
};

/// A drive of T steps from x_0 = `start`. In each step a plan is made from the current state, only its first
/// control is used, and the state is pushed: x_{t+1} = A x_t + B u_t + column t of `pushes` (n x T).
/// Plans do not anticipate pushes.
Drive driven(const Task& task, const Eigen::VectorXd& start, const Eigen::MatrixXd& pushes);

// Part 5, a hand within limits (2:29, 2:37; limits are not on these slides). n joints turn at rates w
// [rad/s], the same for the tau seconds of a step. d numbers say where the hand is [m].

struct ArmLimits {
  Eigen::VectorXd qMin, qMax;  ///< n each [rad]; infinite: none
  Eigen::VectorXd rateMax;     ///< n, positive [rad/s]
};

struct RateBounds {
  Eigen::VectorXd lower, upper;  ///< of the same size, lower <= upper
};

/// Of the rates of a step from q: none is beyond rateMax in size, and no joint leaves its limits. A joint
/// that is outside of them returns at least to the nearer limit; if it cannot in one step, as fast as it may.
RateBounds rateBounds(const ArmLimits& limits, const Eigen::VectorXd& q, double tau);

/// A hand with Jacobian J shall move at v.
struct HandTask {
  Eigen::MatrixXd J;                      ///< d x n
  Eigen::VectorXd v;                      ///< d [m/s]
  Eigen::MatrixXd W;                      ///< d x d, symmetric, positive definite
  double damping = 1e-3, slowness = 0.1;  ///< positive
};

/// The hand may do with a share s of its speed. The cost of z = (w, s), n + 1 numbers, except for a constant:
/// (J w - s v)^T W (J w - s v) + damping |w|^2 + slowness (1 - s)^2.
Quadratic rateCost(const HandTask& task);

/// The cheapest z in a step from q, within rateBounds() and 0 <= s <= 1. The H of its cost is as in boxed().
Eigen::VectorXd limitedRates(const HandTask& task, const ArmLimits& limits, const Eigen::VectorXd& q,
                             double tau);

/// Where the hand is in a posture.
struct Hand {
  Eigen::VectorXd p;  ///< d
  Eigen::MatrixXd J;  ///< d x n
};
using Arm = std::function<Hand(const Eigen::VectorXd& q)>;

/// q_0 = q, ..., q_T (n x (T + 1)): T steps along the line from the hand in q to `goal`, with W = Id. In each
/// step the hand shall get from where it is to the point of the line at r' = min(1, r + pace): r is the share
/// of the line that is done, at first 0. Then r grows by s (r' - r).
Eigen::MatrixXd traced(const Arm& arm, const ArmLimits& limits, const Eigen::VectorXd& q,
                       const Eigen::VectorXd& goal, double pace, double tau, int T);

// Part 6, a bonus: soft limits of states.

/// A state beyond xMin or xMax by s costs `weight` s^2 for each step and each number, from x_1 to x_N.
struct Corridor {
  Eigen::VectorXd xMin, xMax;  ///< n each; infinite: no limit
  double weight = 1;           ///< positive
};

/// The cheapest plan (m x N) from x within the bounds of its controls, with that cost included; correct to
/// 1e-3. N n is at most 30, and the weight at most 10.
Eigen::MatrixXd plannedWithin(const Task& task, const Corridor& corridor, const Eigen::VectorXd& x);
