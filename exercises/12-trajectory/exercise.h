#pragma once

#include <algorithm>
#include <functional>
#include <vector>

#include "course/course.h"

// The functions you complete in main.cpp. Metres, seconds, radians. The T columns of a trajectory X are its
// configurations x_t of n numbers, t = 0, 1, ..., T - 1, tau seconds apart. The prefix holds the
// configurations before: its last column is x_{-1}, the one before that x_{-2}. Slides are named as
// chapter:number.

/// The value y (d numbers) of a function and its Jacobian J (d rows).
struct TermValue {
  Eigen::VectorXd y;
  Eigen::MatrixXd J;
};

// Part 1, terms of order k (5:3, 5:4). k is 1, 2 or 3.

/// The velocity, acceleration or jerk at the end of a window of k + 1 configurations x_{t-k} ... x_t (n x
/// (k + 1)): the k-th difference quotient, times sqrt(tau), so that sums of squares are integrals over time.
/// J is n x (k + 1) n, with n columns for x_{t-k} first.
TermValue differenceTerm(const Eigen::MatrixXd& window, double tau);

/// The sum of y^T y of differenceTerm over t = 0 ... T - 1. The prefix has k columns or more.
double motionCost(const Eigen::MatrixXd& prefix, const Eigen::MatrixXd& X, int k, double tau);

/// The same difference quotient, times sqrt(tau), of a task map phi (d numbers). `phi` has its values and
/// Jacobians (d x n) at x_{t-k}, ..., x_t: k + 1 of them. J is d x (k + 1) n, as above.
TermValue taskDifference(const std::vector<TermValue>& phi, double tau);

// Part 2, banded Gauss-Newton (5:5).

enum class Role {
  cost,        ///< costs y^T y
  inequality,  ///< y <= 0
  equality     ///< y = 0
};

/// A term of order k at step t, at the current trajectory. J is d x (k + 1) n, with the columns of x_{t-k}
/// first, including columns of the prefix.
struct Term {
  Role role = Role::cost;
  int t = 0;
  Eigen::VectorXd y;
  Eigen::MatrixXd J;
};

/// Returns all terms at a trajectory X (n x T), in the same order and of the same sizes for every X. It
/// knows the prefix.
using Terms = std::function<std::vector<Term>(const Eigen::MatrixXd& X)>;

/// The largest order of the terms.
inline int orderOf(const std::vector<Term>& terms, int n) {
  int k = 0;
  for (const Term& term : terms) k = std::max(k, static_cast<int>(term.J.cols()) / n - 1);
  return k;
}

/// The cost F, the sum of y^T y over all terms (here they all count as costs, whatever their role), near a
/// trajectory: its gradient g (n T; x_0 first, then x_1, ...), and the Gauss-Newton approximation H of its
/// second derivatives, as a band. The band has (k + 1) n rows, k the largest order, and n T columns: row i
/// of column j is H_{j+i, j}; the diagonal is row 0. Entries with j + i beyond the end are 0.
struct BandSystem {
  Eigen::MatrixXd band;
  Eigen::VectorXd g;
};
BandSystem assembled(const std::vector<Term>& terms, int n, int steps);

/// The lower triangular L with L L^T = H, both as bands of the same size. An empty matrix (0 x 0) if H is not
/// positive definite. Memory and number of products are proportional to the length of the band.
Eigen::MatrixXd bandCholesky(const Eigen::MatrixXd& band);

/// x with L L^T x = b, for such an L and b (n T). Memory and products as above.
Eigen::VectorXd bandSolve(const Eigen::MatrixXd& L, const Eigen::VectorXd& b);

/// Gauss-Newton steps with line search, damped if H is singular, for the F of all terms. Returns the start
/// and the trajectory after each step; F falls with each step. It ends with the first trajectory at which
/// no entry of the gradient of F is larger than `tolerance`, when no step lowers F any more, or after 300
/// steps.
std::vector<Eigen::MatrixXd> descended(const Terms& terms, const Eigen::MatrixXd& start, double tolerance);

// Part 3, constraints (5:5). The Lagrangian is the sum of the y^T y of all costs and of the m^T y of all
// constraints, with a vector m of multipliers for each.

/// The cost that replaces a term in the augmented Lagrangian: rows r, with d r / dx as J, such that r^T r
/// is mu y^T y + m^T y up to a number that does not depend on x. For an inequality, a row is 0 if its
/// multiplier by nextMultipliers() would be 0. A term that is a cost stays (`multipliers` may be empty). mu
/// is positive, and multipliers of inequalities are not negative.
Term asCost(const Term& term, const Eigen::VectorXd& multipliers, double mu);

/// The multipliers after a minimisation, from those before and the term at the minimum: the coefficients of
/// dy/dx in the gradient of the augmented Lagrangian there. Those of costs stay.
Eigen::VectorXd nextMultipliers(const Term& term, const Eigen::VectorXd& multipliers, double mu);

/// How accurate a minimum must be: no constraint is violated by more than `violation`, no entry of the
/// gradient of the Lagrangian is larger than `gradient`, and for each inequality, -y or m is `violation` at
/// most.
struct Accuracy {
  double violation = 1e-6, gradient = 1e-4;
};

/// A minimum, one vector of multipliers for each term (empty for a cost), and the cost and the largest
/// violation of a constraint after each round. A round ends with new multipliers.
struct Minimum {
  Eigen::MatrixXd X;
  std::vector<Eigen::VectorXd> multipliers;
  std::vector<double> cost, violation;
};

/// A local minimum of the costs under the constraints, from any start. `mu` is a sensible penalty to begin
/// with.
Minimum minimised(const Terms& terms, const Eigen::MatrixXd& start, double mu, const Accuracy& accuracy);

// Part 4, via points.

/// The motion (n x T) with the least motionCost of order k = 2 from rest at `start` (n) through the columns
/// of `points` (n x m) at steps `when` (m, ascending, above 0). It ends at rest at the last point: T =
/// when.back() + 1, and x_{T-1} = x_{T-2}. There is no via point at when.back() - 1; m is at least 1.
/// Accurate to 1e-6 of the greatest distance.
Eigen::MatrixXd throughPoints(const Eigen::VectorXd& start, const Eigen::MatrixXd& points,
                              const std::vector<int>& when, double tau);

// Part 5, an arm among obstacles.

/// How near bodies are on the straight way from x_{t-1} to x_t (`window`, n x 2): 1 - d / margin for the
/// distance d of each pair of rex::clearances(S), in their order, first at one `samples`-th of the way,
/// then at two, ..., last at x_t. J has 2 n columns, those of x_{t-1} first.
TermValue keptApart(rex::Simulator& S, const Eigen::MatrixXd& window, double margin, int samples);

/// What the arm is to do, from rest at S's configuration, in `steps` steps of `tau` seconds.
struct Errand {
  Eigen::VectorXd goal;    ///< n: where the arm comes to rest
  Eigen::VectorXd detour;  ///< n: a posture on the right side of the obstacle; need not be reached
  double margin = 0.02;    ///< metres that all pairs of clearances() should stay apart
  int steps = 16;          ///< T
  double tau = 0.125;
  double budget = 100;  ///< of the motionCost with k = 2; some 25 % above what a good local minimum costs
};

/// A trajectory (n x T) for the errand: x_{T-1} and x_{T-2} are the goal, up to 1e-3; on the straight way
/// from each configuration to the next, the first one from S's, all pairs are 0.8 margin or more apart; its
/// cost is within the budget.
Eigen::MatrixXd aroundObstacle(rex::Simulator& S, const Errand& errand);
