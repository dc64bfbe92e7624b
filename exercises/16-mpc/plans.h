#pragma once

#include <cmath>
#include <functional>
#include <limits>

#include <Eigen/Eigenvalues>

#include "control/predictive_controller.h"
#include "interface.h"

// The grader's plants and tasks, and what is right for them, by other ways than those that a student takes.

inline constexpr double kNoLimit = std::numeric_limits<double>::infinity();

/// Rounded to two digits, so that a case can be computed by hand.
inline Eigen::MatrixXd roundedMatrix(Eigen::Index rows, Eigen::Index cols, double size, rex::Rng& rng) {
  Eigen::MatrixXd matrix(rows, cols);
  for (double& entry : matrix.reshaped()) entry = std::round(100 * rng.uniform(-size, size)) / 100;
  return matrix;
}

/// Positive definite.
inline Eigen::MatrixXd roundedWeights(Eigen::Index size, double least, rex::Rng& rng) {
  Eigen::MatrixXd weights = roundedMatrix(size, size, .5, rng);
  weights = (.5 * (weights + weights.transpose())).eval();
  weights.diagonal() = weights.cwiseAbs().rowwise().sum();
  weights.diagonal().array() += least;
  return weights;
}

/// Eigenvalues of up to `growth` in size.
inline Plant randomPlant(Eigen::Index n, Eigen::Index m, double growth, rex::Rng& rng) {
  Plant plant{roundedMatrix(n, n, 1, rng), roundedMatrix(n, m, 1, rng)};
  const double radius = Eigen::EigenSolver<Eigen::MatrixXd>(plant.A).eigenvalues().cwiseAbs().maxCoeff();
  plant.A = ((100 * growth / std::max(radius, .2)) * plant.A).array().round() / 100;
  return plant;
}

/// A mass of 1 kg pushed along a line: (position, speed).
inline Plant sled(double tau) {
  return {(Eigen::MatrixXd(2, 2) << 1, tau, 0, 1).finished(),
          (Eigen::MatrixXd(2, 1) << tau * tau / 2, tau).finished()};
}

inline Costs randomCosts(const Plant& plant, rex::Rng& rng) {
  const Eigen::Index n = plant.A.rows(), m = plant.B.cols();
  return {roundedWeights(n, .1, rng), roundedWeights(m, .2, rng), roundedWeights(n, 2, rng)};
}

inline Eigen::VectorXd moved(const Plant& plant, const Eigen::VectorXd& x, const Eigen::VectorXd& u) {
  Eigen::VectorXd next = plant.A * x;
  next += plant.B * u;
  return next;
}

/// x_1, ..., x_N.
inline Eigen::VectorXd motionUnder(const Plant& plant, const Eigen::VectorXd& start,
                                   const Eigen::VectorXd& U) {
  const Eigen::Index n = plant.A.rows(), m = plant.B.cols(), N = U.size() / m;
  Eigen::VectorXd X(N * n), x = start;
  for (Eigen::Index t = 0; t < N; ++t) X.segment(t * n, n) = x = moved(plant, x, U.segment(t * m, m));
  return X;
}

inline double costOf(const Plant& plant, const Costs& costs, const Eigen::VectorXd& start,
                     const Eigen::VectorXd& U) {
  const Eigen::Index n = plant.A.rows(), m = plant.B.cols(), N = U.size() / m;
  const Eigen::VectorXd X = motionUnder(plant, start, U);
  double cost = 0;
  Eigen::VectorXd x = start;
  for (Eigen::Index t = 0; t < N; ++t) {
    const Eigen::VectorXd u = U.segment(t * m, m);
    cost += x.dot(costs.Q * x) + u.dot(costs.R * u);
    x = X.segment(t * n, n);
  }
  return cost + x.dot(costs.F * x);
}

/// By motions from each unit vector, and under each unit control.
inline Prediction measuredPrediction(const Plant& plant, int N) {
  const Eigen::Index n = plant.A.rows(), controls = N * plant.B.cols();
  const auto unit = [](Eigen::Index size, Eigen::Index i) -> Eigen::VectorXd {
    return Eigen::VectorXd::Unit(size, i);
  };
  Prediction p{Eigen::MatrixXd(N * n, n), Eigen::MatrixXd(N * n, controls)};
  for (Eigen::Index i = 0; i < n; ++i)
    p.Sx.col(i) = motionUnder(plant, unit(n, i), Eigen::VectorXd::Zero(controls));
  for (Eigen::Index k = 0; k < controls; ++k)
    p.Su.col(k) = motionUnder(plant, Eigen::VectorXd::Zero(n), unit(controls, k));
  return p;
}

/// From values of a cost around 0.
inline Quadratic measuredQuadratic(Eigen::Index size,
                                   const std::function<double(const Eigen::VectorXd&)>& f) {
  Quadratic q{Eigen::MatrixXd(size, size), Eigen::VectorXd(size)};
  const Eigen::MatrixXd unit = Eigen::MatrixXd::Identity(size, size);
  for (Eigen::Index i = 0; i < size; ++i) {
    q.g[i] = (f(unit.col(i)) - f(-unit.col(i))) / 2;
    for (Eigen::Index k = 0; k <= i; ++k) {
      const Eigen::VectorXd both = unit.col(i) + unit.col(k), between = unit.col(i) - unit.col(k);
      q.H(i, k) = q.H(k, i) = (f(both) - f(between) - f(-between) + f(-both)) / 4;
    }
  }
  return q;
}

inline double conditionOf(const Eigen::MatrixXd& H) {
  const Eigen::VectorXd sizes = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(H).eigenvalues();
  return sizes.maxCoeff() / sizes.minCoeff();
}

inline Eigen::VectorXd within(const Eigen::VectorXd& z, const Eigen::VectorXd& lower,
                              const Eigen::VectorXd& upper) {
  return z.cwiseMax(lower).cwiseMin(upper);
}

/// The minimum between bounds, by the library's dual active set.
inline Eigen::VectorXd boundedMinimum(const Quadratic& cost, const Eigen::VectorXd& lower,
                                      const Eigen::VectorXd& upper) {
  const Eigen::Index size = cost.g.size();
  return rex::QuadraticProgram(cost.H, Eigen::MatrixXd::Identity(size, size))
      .minimize(cost.g, lower, upper)
      .x;
}

/// What comes out if numbers beyond a bound are set to it, and stay there while the others are solved for.
inline Eigen::VectorXd neverReleased(const Quadratic& cost, const Eigen::VectorXd& lower,
                                     const Eigen::VectorXd& upper) {
  const Eigen::VectorXd none = Eigen::VectorXd::Constant(lower.size(), kNoLimit);
  Eigen::VectorXd from = -none, to = none;
  for (;;) {
    const Eigen::VectorXd z = boundedMinimum(cost, from, to), inside = within(z, lower, upper);
    if ((z - inside).cwiseAbs().maxCoeff() < 1e-9) return inside;
    for (Eigen::Index i = 0; i < z.size(); ++i)
      if (z[i] != inside[i]) from[i] = to[i] = inside[i];
  }
}

/// Numbers whose cost has that condition, and bounds, some infinite, some equal, and some that do not
/// contain zero. Many of them are active.
struct BoxedCase {
  Quadratic cost;
  Eigen::VectorXd lower, upper;
};
inline BoxedCase randomBoxedCase(Eigen::Index size, double condition, rex::Rng& rng) {
  const Eigen::MatrixXd root = rng.normalVector(static_cast<int>(size * size)).reshaped(size, size);
  const Eigen::MatrixXd axes =
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(root + root.transpose()).eigenvectors();
  Eigen::VectorXd curvatures(size);
  for (Eigen::Index i = 0; i < size; ++i)
    curvatures[i] =
        std::pow(condition, size > 1 ? static_cast<double>(i) / static_cast<double>(size - 1) : 1);
  BoxedCase c{{axes * curvatures.asDiagonal() * axes.transpose(), {}}, {}, {}};
  c.cost.H = (.5 * (c.cost.H + c.cost.H.transpose())).eval();
  c.cost.g = -c.cost.H * (2 * rng.normalVector(static_cast<int>(size)));
  c.lower.resize(size);
  c.upper.resize(size);
  for (Eigen::Index i = 0; i < size; ++i) {
    c.lower[i] = rng.uniform(-1.5, .5);
    c.upper[i] = c.lower[i] + rng.uniform(.2, 2);
    if (i % 7 == 3) c.upper[i] = kNoLimit;
    if (i % 7 == 5) c.lower[i] = -kNoLimit;
    if (i % 11 == 6) c.upper[i] = c.lower[i];
  }
  return c;
}

inline Quadratic costOfPlans(const Task& task, const Eigen::VectorXd& x) {
  return measuredQuadratic(task.N * task.uMin.size(),
                           [&](const Eigen::VectorXd& U) { return costOf(task.plant, task.costs, x, U); });
}

/// With controls that are cheap enough for the bounds to act, and dear enough for H to have a condition of
/// at most 1000.
inline Task randomTask(Eigen::Index n, Eigen::Index m, int N, double growth, rex::Rng& rng) {
  Task task{.plant = randomPlant(n, m, growth, rng), .N = N};
  task.uMin.resize(m);
  task.uMax.resize(m);
  for (Eigen::Index i = 0; i < m; ++i) {
    task.uMin[i] = std::round(100 * rng.uniform(-.8, -.2)) / 100;
    task.uMax[i] = std::round(100 * rng.uniform(.2, .8)) / 100;
  }
  task.costs = randomCosts(task.plant, rng);
  while (conditionOf(costOfPlans(task, Eigen::VectorXd::Zero(n)).H) > 1000) task.costs.R *= 2;
  return task;
}

inline rex::PredictiveController controllerOf(const Task& task) {
  return {{.A = task.plant.A, .B = task.plant.B, .step = 1.},
          {.Q = task.costs.Q,
           .R = task.costs.R,
           .F = task.costs.F,
           .horizon = task.N,
           .uMin = task.uMin,
           .uMax = task.uMax}};
}

inline Eigen::MatrixXd bestPlan(const Task& task, const Eigen::VectorXd& x) {
  return controllerOf(task).plan(x).U;
}

/// What a driver does: the control of step t, in x.
using Driver = std::function<Eigen::VectorXd(int t, const Eigen::VectorXd& x)>;
inline Drive driveBy(const Driver& driver, const Plant& plant, const Eigen::VectorXd& start,
                     const Eigen::MatrixXd& pushes) {
  const int T = static_cast<int>(pushes.cols());
  Drive drive{Eigen::MatrixXd(start.size(), T + 1), Eigen::MatrixXd(plant.B.cols(), T)};
  drive.X.col(0) = start;
  for (int t = 0; t < T; ++t) {
    const Eigen::VectorXd u = driver(t, drive.X.col(t));
    drive.U.col(t) = u;
    drive.X.col(t + 1) = moved(plant, drive.X.col(t), u) + pushes.col(t);
  }
  return drive;
}

/// The best plan if leaving the corridor costs, with a slack for each number that has a limit.
inline Eigen::MatrixXd bestPlanWithin(const Task& task, const Corridor& corridor, const Eigen::VectorXd& x) {
  const Quadratic plain = costOfPlans(task, x);
  const Prediction p = measuredPrediction(task.plant, task.N);
  const Eigen::Index controls = p.Su.cols(), states = p.Su.rows(), all = controls + states;
  Eigen::MatrixXd H = Eigen::MatrixXd::Identity(all, all) * (2 * corridor.weight);
  H.topLeftCorner(controls, controls) = plain.H;
  Eigen::VectorXd g = Eigen::VectorXd::Zero(all);
  g.head(controls) = plain.g;
  // The controls; the states minus their slacks.
  Eigen::MatrixXd rows = Eigen::MatrixXd::Identity(all, all);
  rows.bottomLeftCorner(states, controls) = p.Su;
  rows.bottomRightCorner(states, states) *= -1;
  const Eigen::VectorXd rest = motionUnder(task.plant, x, Eigen::VectorXd::Zero(controls));
  Eigen::VectorXd lower(all), upper(all);
  lower << task.uMin.replicate(task.N, 1), corridor.xMin.replicate(task.N, 1) - rest;
  upper << task.uMax.replicate(task.N, 1), corridor.xMax.replicate(task.N, 1) - rest;
  const Eigen::VectorXd z = rex::QuadraticProgram(H, rows).minimize(g, lower, upper).x;
  return z.head(controls).reshaped(task.uMin.size(), task.N);
}
