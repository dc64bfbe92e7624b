#pragma once

#include "grading/check.h"
#include "grading/evidence_parts.h"
#include "interface.h"
#include "random_matrices.h"

// Part 2: functions to minimise, and what must hold for every step of a descent.

// f, its gradient, and a start. All are smooth and bounded below where they are finite.
struct Landscape {
  std::string name;
  ScalarFunction f;
  rex::VectorFunction gradient;
  Eigen::VectorXd start;
};

// f is a bowl of any depth, or a hole in a plain: flat far away, and not convex there.
inline Landscape bowl(rex::Rng& rng, int n) {
  const Eigen::MatrixXd H = std::pow(10, rng.uniform(-3, 3)) * positiveDefinite(rng, n);
  const Eigen::VectorXd center = rng.normalVector(n);
  return {fmt::format("a bowl in {} dimensions with curvature {:.3g}", n, H.norm()),
          [=](const Eigen::VectorXd& x) { return 0.5 * (x - center).dot(H * (x - center)); },
          [=](const Eigen::VectorXd& x) { return Eigen::VectorXd(H * (x - center)); },
          center + 2 * rng.normalVector(n)};
}

inline Landscape hole(rex::Rng& rng, int n) {
  const Eigen::MatrixXd H = positiveDefinite(rng, n);
  return {fmt::format("x^T H x / (1 + x^T H x) in {} dimensions", n),
          [=](const Eigen::VectorXd& x) {
            const double r = x.dot(H * x);
            return r / (1 + r);
          },
          [=](const Eigen::VectorXd& x) {
            const double r = x.dot(H * x);
            return Eigen::VectorXd(2 * H * x / ((1 + r) * (1 + r)));
          },
          rng.normalVector(n)};
}

// What every path must satisfy: it begins at the start, its points are finite, and it has at least one step
// and at most maxSteps.
inline void checkPath(rex::grading::Check& check, const std::vector<Eigen::VectorXd>& path,
                      const Eigen::VectorXd& start, int maxSteps) {
  check.atLeast("number of points in the path", static_cast<double>(path.size()), 2);
  check.atMost("number of steps", static_cast<double>(path.size()) - 1, maxSteps);
  for (const Eigen::VectorXd& x : path) check.shape("point of the path", x, start.size(), 1);
  check.near("first point of the path", path.front(), start, 0);
}

// Armijo's condition for a step of size alpha, up to the rounding of f.
inline void decreases(rex::grading::Check& check, double before, double after, double alpha, double slope,
                      double decrease) {
  check.atMost("f after a step, beyond what sufficient decrease allows",
               after - before - decrease * alpha * slope,
               1e-6 * alpha * std::abs(slope) + 1e-13 * std::abs(before));
}

/// The values along a path, and the largest value that Armijo's condition allows after each step.
inline rex::grading::Evidence descentSeen(const std::vector<double>& values,
                                          const std::vector<double>& allowed) {
  rex::Series got = rex::grading::gotCurve("got");
  rex::Series wanted{.label = "wanted: at most",
                     .style = rex::SeriesStyle::kPoints,
                     .marker = rex::Marker::kTriangle,
                     .size = 1.5,
                     .color = rex::grading::kWantedColor};
  got.style = rex::SeriesStyle::kLinesPoints;
  got.marker = rex::Marker::kDot;
  got.y = values;
  for (std::size_t t = 0; t < allowed.size(); ++t) {
    wanted.x.push_back(static_cast<double>(t + 1));
    wanted.y.push_back(allowed[t]);
  }
  rex::Figure figure{.title = "The descent", .xLabel = "step", .yLabel = "f", .series = {got}};
  if (!allowed.empty()) figure.series.push_back(wanted);
  return {.figures = {figure}};
}

inline void descends(rex::grading::Check& check, Student& student, const Landscape& land,
                     SearchOptions options) {
  options.tolerance = 1e-5 * land.gradient(land.start).norm();
  check.input(land.name + fmt::format(", shrink {:.2f}, grow {:.2f}, decrease {:.2f}", options.shrink,
                                      options.grow, options.decrease));
  const std::vector<Eigen::VectorXd> path =
      student.gradientDescent(land.f, land.gradient, land.start, options);
  const auto shown = check.show([&] {
    std::vector<double> values, allowed;
    for (const Eigen::VectorXd& x : path) values.push_back(land.f(x));
    for (std::size_t t = 0; t + 1 < path.size(); ++t)
      allowed.push_back(values[t] + options.decrease * land.gradient(path[t]).dot(path[t + 1] - path[t]));
    return descentSeen(values, allowed);
  });
  checkPath(check, path, land.start, options.maxSteps);
  double firstTrial = 1;
  for (std::size_t t = 1; t < path.size(); ++t) {
    const Eigen::VectorXd step = path[t] - path[t - 1], g = land.gradient(path[t - 1]);
    const double alpha = -step.dot(g) / g.squaredNorm();
    check.that(
        "every step goes along the negative gradient",
        alpha > 0 && (step + alpha * g).norm() <= 1e-5 * alpha * g.norm() + 1e-13 * path[t - 1].norm());
    decreases(check, land.f(path[t - 1]), land.f(path[t]), alpha, -g.squaredNorm(), options.decrease);
    check.atMost("step size, relative to its first trial", alpha / firstTrial, 1 + 1e-4);
    const double shrunk = std::log(alpha / firstTrial) / std::log(options.shrink);
    check.atMost("distance of log(step size / first trial) / log(shrink) from the nearest integer",
                 std::abs(shrunk - std::round(shrunk)), 0.02);
    firstTrial = alpha * options.grow;
  }
  check.atMost("gradient at the end, relative to that at the start",
               land.gradient(path.back()).norm() / land.gradient(land.start).norm(), 1.0001e-5);
}

// phi, its derivative, and a start.
struct Residuals {
  std::string name;
  rex::VectorFunction phi;
  MatrixFunction J;
  Eigen::VectorXd start;
};

inline Residuals affine(rex::Rng& rng, int d, int n) {
  const Eigen::MatrixXd A = wellConditioned(rng, d, n);
  const Eigen::VectorXd y = rng.normalVector(d);
  return {sizes("phi = A x - y, A", d, n),
          [=](const Eigen::VectorXd& x) { return Eigen::VectorXd(A * x - y); },
          [=](const Eigen::VectorXd&) { return A; }, rng.normalVector(n)};
}

// Full steps lead away from the zero. All entries start at the same distance from it: otherwise a step could
// bring one entry nearer and send another so far away that J loses rank.
inline Residuals arcTangent(rex::Rng& rng, int n) {
  return {fmt::format("the arc tangent of each of {} entries of x", n),
          [](const Eigen::VectorXd& x) { return Eigen::VectorXd(x.array().atan()); },
          [](const Eigen::VectorXd& x) {
            return Eigen::MatrixXd((1 / (1 + x.array().square())).matrix().asDiagonal());
          },
          rng.uniform(2, 4) * rng.normalVector(n).cwiseSign()};
}

inline Residuals curvedValley(rex::Rng& rng) {
  const double steep = rng.uniform(3, 10);
  return {fmt::format("(1 - x1, {:.2f} (x2 - x1^2))", steep),
          [=](const Eigen::VectorXd& x) {
            return Eigen::VectorXd(Eigen::Vector2d(1 - x[0], steep * (x[1] - x[0] * x[0])));
          },
          [=](const Eigen::VectorXd& x) {
            return (Eigen::MatrixXd(2, 2) << -1, 0, -2 * steep * x[0], steep).finished();
          },
          Eigen::Vector2d(rng.uniform(-1.5, -1), rng.uniform(0, 2))};
}

// Every step is a fraction alpha <= 1 of the Gauss-Newton step, with sufficient decrease.
inline void followsGaussNewton(rex::grading::Check& check, Student& student, const Residuals& problem,
                               SearchOptions options) {
  const auto gradient = [&](const Eigen::VectorXd& x) {
    return Eigen::VectorXd(2 * problem.J(x).transpose() * problem.phi(x));
  };
  options.tolerance = 1e-5 * gradient(problem.start).norm();
  check.input(problem.name + fmt::format(", decrease {:.2f}", options.decrease));
  const std::vector<Eigen::VectorXd> path =
      student.gaussNewton(problem.phi, problem.J, problem.start, options);
  const auto shown = check.show([&] {
    std::vector<double> values, allowed;
    for (const Eigen::VectorXd& x : path) values.push_back(problem.phi(x).squaredNorm());
    for (std::size_t t = 0; t + 1 < path.size(); ++t)
      allowed.push_back(values[t] + options.decrease * gradient(path[t]).dot(path[t + 1] - path[t]));
    return descentSeen(values, allowed);
  });
  checkPath(check, path, problem.start, options.maxSteps);
  for (std::size_t t = 1; t < path.size(); ++t) {
    const Eigen::VectorXd x = path[t - 1], step = path[t] - x;
    const Eigen::MatrixXd J = problem.J(x);
    const Eigen::VectorXd phi = problem.phi(x), full = -rex::leastSquares(J, phi);
    const double alpha = step.dot(full) / full.squaredNorm();
    check.that(
        "every step goes along the d with J^T J d = -J^T phi",
        alpha > 0 && (step - alpha * full).norm() <= 1e-5 * alpha * full.norm() + 1e-10 * (1 + x.norm()));
    check.atMost("alpha of a step", alpha, 1 + 1e-4);
    decreases(check, phi.squaredNorm(), problem.phi(path[t]).squaredNorm(), alpha, gradient(x).dot(full),
              options.decrease);
  }
  // The factor of two allows for solutions that compare half of the gradient with the tolerance.
  check.atMost("gradient at the end, relative to that at the start",
               gradient(path.back()).norm() / gradient(problem.start).norm(), 2.0001e-5);
}
