#pragma once

#include <cmath>
#include <vector>

#include "exercise.h"

// Random terms for the checks, and problems whose minimum is known.

inline Eigen::MatrixXd randomMatrix(rex::Rng& rng, Eigen::Index rows, Eigen::Index columns) {
  return rng.normalVector(static_cast<int>(rows * columns)).reshaped(rows, columns);
}

/// At least two terms at each step, of orders up to k; order k occurs.
inline std::vector<Term> randomTerms(rex::Rng& rng, int n, int steps, int k) {
  std::vector<Term> terms;
  for (int t = 0; t < steps; ++t)
    for (const int order : {k, rng.index(k + 1), 0}) {
      const int d = 1 + rng.index(3);
      terms.push_back({Role::cost, t, rng.normalVector(d), randomMatrix(rng, d, (order + 1) * n)});
    }
  return terms;
}

/// J of a term as a function of all of X: d x n T, without the prefix.
inline Eigen::MatrixXd overAll(const Term& term, int n, int steps) {
  const Eigen::Index order = term.J.cols() / n - 1;
  Eigen::MatrixXd J = Eigen::MatrixXd::Zero(term.J.rows(), n * steps);
  for (Eigen::Index i = 0; i <= order; ++i)
    if (term.t - order + i >= 0) J.middleCols((term.t - order + i) * n, n) = term.J.middleCols(i * n, n);
  return J;
}

struct FullSystem {
  Eigen::MatrixXd H;
  Eigen::VectorXd g;
  double cost = 0;
};

inline FullSystem denseSystem(const std::vector<Term>& terms, int n, int steps) {
  FullSystem all{Eigen::MatrixXd::Zero(n * steps, n * steps), Eigen::VectorXd::Zero(n * steps)};
  for (const auto& term : terms) {
    const Eigen::MatrixXd J = overAll(term, n, steps);
    all.H += 2 * J.transpose() * J;
    all.g += 2 * J.transpose() * term.y;
    all.cost += term.y.squaredNorm();
  }
  return all;
}

inline Eigen::MatrixXd bandOf(const Eigen::MatrixXd& H, Eigen::Index rows) {
  Eigen::MatrixXd band = Eigen::MatrixXd::Zero(rows, H.cols());
  for (Eigen::Index j = 0; j < H.cols(); ++j)
    for (Eigen::Index i = 0; i < rows && j + i < H.cols(); ++i) band(i, j) = H(j + i, j);
  return band;
}

/// A lower triangular band with a diagonal between 1 and 2.
inline Eigen::MatrixXd randomFactor(rex::Rng& rng, Eigen::Index rows, Eigen::Index columns) {
  Eigen::MatrixXd L(rows, columns);
  for (Eigen::Index j = 0; j < columns; ++j)
    for (Eigen::Index i = 0; i < rows; ++i)
      L(i, j) = i == 0 ? rng.uniform(1, 2) : j + i < columns ? rng.uniform(-0.4, 0.4) : 0;
  return L;
}

/// The band of L L^T; what L holds beyond the end does not matter.
inline Eigen::MatrixXd squared(const Eigen::MatrixXd& L) {
  Eigen::MatrixXd band = Eigen::MatrixXd::Zero(L.rows(), L.cols());
  for (Eigen::Index k = 0; k < L.cols(); ++k)
    for (Eigen::Index a = 0; a < L.rows() && k + a < L.cols(); ++a)
      for (Eigen::Index b = a; b < L.rows() && k + b < L.cols(); ++b) band(b - a, k + a) += L(a, k) * L(b, k);
  return band;
}

/// The product of the symmetric matrix of a band with x.
inline Eigen::VectorXd times(const Eigen::MatrixXd& band, const Eigen::VectorXd& x) {
  Eigen::VectorXd y = Eigen::VectorXd::Zero(x.size());
  for (Eigen::Index j = 0; j < band.cols(); ++j)
    for (Eigen::Index i = 0; i < band.rows() && j + i < band.cols(); ++i) {
      y[j + i] += band(i, j) * x[j];
      if (i > 0) y[j] += band(i, j) * x[j + i];
    }
  return y;
}

/// A problem with a unique minimum that is known.
struct KnownProblem {
  std::string name;
  Terms terms;
  Eigen::MatrixXd start, minimum;
  double mu = 1;
};

inline Term termOf(Role role, int t, const Eigen::VectorXd& y, const Eigen::MatrixXd& J) {
  return {role, t, y, J};
}

/// Hock and Schittkowski's number 43 (Rosen and Suzuki), with its cost as a sum of squares.
inline KnownProblem rosenSuzuki() {
  const Terms terms = [](const Eigen::MatrixXd& X) {
    const Eigen::Vector4d x = X.col(0), scale(1, 1, std::sqrt(2.), 1), middle(2.5, 2.5, 5.25, -3.5);
    const Eigen::Vector4d f = scale.cwiseProduct(x - middle);
    const Eigen::Matrix<double, 3, 4> squares{{1, 1, 1, 1}, {1, 2, 1, 2}, {2, 1, 1, 0}},
        slopes{{1, -1, 1, -1}, {-1, 0, 0, -1}, {2, -1, 0, -1}};
    const Eigen::Vector3d y = squares * x.cwiseAbs2() + slopes * x - Eigen::Vector3d(8, 10, 5);
    const Eigen::MatrixXd J = 2 * squares * x.asDiagonal() + slopes;
    return std::vector<Term>{termOf(Role::cost, 0, f, scale.asDiagonal().toDenseMatrix()),
                             termOf(Role::inequality, 0, y, J)};
  };
  return {"the problem of Rosen and Suzuki, from (0, 0, 0, 0)", terms, Eigen::Vector4d::Zero(),
          Eigen::Vector4d(0, 1, 2, -1)};
}

/// Number 6: a curved valley without any slope at its end.
inline KnownProblem curvedEquality() {
  const Terms terms = [](const Eigen::MatrixXd& X) {
    const double a = X(0, 0), b = X(1, 0);
    return std::vector<Term>{
        termOf(Role::cost, 0, Eigen::VectorXd::Constant(1, 1 - a), Eigen::RowVector2d(-1, 0)),
        termOf(Role::equality, 0, Eigen::VectorXd::Constant(1, 10 * (b - a * a)),
               Eigen::RowVector2d(-20 * a, 10))};
  };
  return {"(1 - a)^2 with 10 (b - a^2) = 0, from (-1.2, 1)", terms, Eigen::Vector2d(-1.2, 1),
          Eigen::Vector2d(1, 1)};
}

/// The point of a sphere, or of the ball in it, that is nearest to p outside of it.
inline KnownProblem nearestOnBall(rex::Rng& rng, Role role) {
  const double radius = rng.uniform(0.5, 2);
  const Eigen::Vector3d p = rng.normalVector(3).normalized() * radius * rng.uniform(1.3, 3);
  const Terms terms = [=](const Eigen::MatrixXd& X) {
    const Eigen::Vector3d x = X.col(0);
    return std::vector<Term>{
        termOf(Role::cost, 0, x - p, Eigen::Matrix3d::Identity()),
        termOf(role, 0, Eigen::VectorXd::Constant(1, x.squaredNorm() - radius * radius), 2 * x.transpose())};
  };
  return {"the point of a ball that is nearest to one outside", terms,
          p + Eigen::Vector3d(rng.uniformVector(3, -0.3, 0.3)), radius * p.normalized()};
}

/// Linear terms over T steps after a prefix. The minimum is drawn first; then costs x_t - c_t are chosen so
/// that it is one, with random multipliers. These costs also make it unique.
inline KnownProblem linearMotion(rex::Rng& rng, int n, int steps) {
  const Eigen::MatrixXd minimum = randomMatrix(rng, n, steps), prefix = randomMatrix(rng, n, 2);
  std::vector<Term> all = randomTerms(rng, n, steps, 2);
  Eigen::VectorXd slope = denseSystem(all, n, steps).g;
  for (int t = 0; t < steps; ++t) {
    const bool isEquality = t % 4 == 2, isActive = t % 2 == 0;
    const int order = rng.index(2);
    Term term{isEquality ? Role::equality : Role::inequality, t,
              Eigen::VectorXd::Constant(1, isActive ? 0 : -rng.uniform(0.3, 1)),
              rng.normalVector((order + 1) * n).normalized().transpose()};
    const double multiplier = isEquality ? rng.normal() : isActive ? rng.uniform(0.5, 2) : 0;
    slope += multiplier * overAll(term, n, steps).transpose();
    all.push_back(term);
  }
  for (int t = 0; t < steps; ++t)
    all.push_back({Role::cost, t, -slope.segment(t * n, n) / 2, Eigen::MatrixXd::Identity(n, n)});
  const Terms terms = [=](const Eigen::MatrixXd& X) {
    std::vector<Term> at = all;
    const Eigen::VectorXd away = (X - minimum).reshaped();
    for (Term& term : at) term.y += overAll(term, n, steps) * away;
    return at;
  };
  return {"linear terms over " + std::to_string(steps) + " steps", terms, randomMatrix(rng, n, steps),
          minimum};
}

/// Arc tangents, for which full steps diverge, and differences of neighbours.
inline Terms arcTangents(int n, double stiffness) {
  return [=](const Eigen::MatrixXd& X) {
    std::vector<Term> terms;
    for (int t = 0; t < X.cols(); ++t) {
      const Eigen::VectorXd x = X.col(t);
      terms.push_back({Role::cost, t, x.array().atan().matrix(),
                       (1 / (1 + x.array().square())).matrix().asDiagonal().toDenseMatrix()});
      if (t == 0) continue;
      Eigen::MatrixXd J(n, 2 * n);
      J << -stiffness * Eigen::MatrixXd::Identity(n, n), stiffness * Eigen::MatrixXd::Identity(n, n);
      terms.push_back({Role::cost, t, stiffness * (X.col(t) - X.col(t - 1)), J});
    }
    return terms;
  };
}

/// The motion (n x T) with the least sum of squared second differences through points and to rest, by one
/// dense system.
inline Eigen::MatrixXd leastAcceleration(const Eigen::VectorXd& start, const Eigen::MatrixXd& points,
                                         const std::vector<int>& when) {
  const Eigen::Index T = when.back() + 1, m = points.cols();
  Eigen::MatrixXd D = Eigen::MatrixXd::Zero(T, T), E = Eigen::MatrixXd::Zero(m + 1, T);
  for (Eigen::Index t = 0; t < T; ++t) {
    D(t, t) = 1;
    if (t > 0) D(t, t - 1) = -2;
    if (t > 1) D(t, t - 2) = 1;
  }
  for (Eigen::Index i = 0; i < m; ++i) E(i, when[static_cast<std::size_t>(i)]) = 1;
  E(m, T - 2) = 1;
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(T + m + 1, T + m + 1);
  A << 2 * D.transpose() * D, E.transpose(), E, Eigen::MatrixXd::Zero(m + 1, m + 1);
  // Relative to the start, everything before it is zero.
  Eigen::MatrixXd b = Eigen::MatrixXd::Zero(T + m + 1, start.size());
  for (Eigen::Index i = 0; i < m; ++i) b.row(T + i) = (points.col(i) - start).transpose();
  b.row(T + m) = b.row(T + m - 1);
  return rex::solveMatrix(A, b).topRows(T).transpose().colwise() + start;
}
