#pragma once

#include <algorithm>
#include <cmath>

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
  for (std::size_t t = 1; t < path.size(); ++t)
    check.that("each point of the path differs from the one before", path[t] != path[t - 1]);
}

// The angle between a step from x and its wanted direction d, radians, up to the rounding of x.
inline double angleOf(const Eigen::VectorXd& step, const Eigen::VectorXd& d, double rounding) {
  const double along = step.dot(d) / d.norm();
  const double aside = (step - along * d.normalized()).norm() - rounding;
  return std::atan2(std::max(0., aside), along);
}

// The steps of a path that should lead down: their angles to the wanted directions, their sizes alpha, and
// what Armijo's condition compares: the decrease of f divided by what the slope promises.
struct Steps {
  rex::grading::Signal angles, sizes, decreases;
};

// The decrease, up to the rounding of f.
inline double shareOfSlope(double before, double after, double alpha, double slope) {
  return (before - after + 1e-13 * std::abs(before)) / (alpha * std::abs(slope)) + 1e-6;
}

inline void decreases(rex::grading::Check& check, const std::string& function, const Steps& steps,
                      double decrease) {
  bool rises = false, full = true;
  for (const Eigen::VectorXd& share : steps.decreases.values) rises = rises || share[0] < 0;
  for (const Eigen::VectorXd& alpha : steps.sizes.values) full = full && std::abs(alpha[0] - 1) < 1e-9;
  const auto whole = check.ask("Every step is a full one, alpha = 1: is the line search missing?", full);
  const auto uphill = check.ask(
      "f rises there: is the condition of sufficient decrease tested, with the slope's sign?", rises);
  check.atLeastAlong("(f before - f after) / (alpha |slope|) of a step in " + function, steps.decreases,
                     decrease);
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

// How often a step size was multiplied by `shrink`, if its first trial was the size before times `grow`. With
// `again`, each line search begins with 1.
inline rex::grading::Signal timesShrunk(const rex::grading::Signal& sizes, double shrink, double grow,
                                        bool again = false) {
  rex::grading::Signal times;
  double firstTrial = 1;
  for (std::size_t i = 0; i < sizes.at.size(); ++i) {
    const double alpha = sizes.values[i][0];
    times.add(sizes.at[i], std::log(alpha / firstTrial) / std::log(shrink));
    firstTrial = again ? 1 : alpha * grow;
  }
  return times;
}

// Whole numbers, not negative.
inline std::vector<Eigen::VectorXd> wholeNumbers(const rex::grading::Signal& times) {
  std::vector<Eigen::VectorXd> whole;
  for (const Eigen::VectorXd& one : times.values) whole.emplace_back(one.array().round().max(0));
  return whole;
}

inline void sizesAreTried(rex::grading::Check& check, const rex::grading::Signal& sizes,
                          const SearchOptions& options) {
  constexpr double kTolerance = 0.02;
  const auto fits = [&](double shrink, double grow, bool again) {
    const rex::grading::Signal times = timesShrunk(sizes, shrink, grow, again);
    const std::vector<Eigen::VectorXd> whole = wholeNumbers(times);
    for (std::size_t i = 0; i < whole.size(); ++i)
      if (std::abs(times.values[i][0] - whole[i][0]) > kTolerance) return false;
    return true;
  };
  const auto stays = check.ask("Is alpha never multiplied by `grow`?", fits(options.shrink, 1, false));
  const auto again = check.ask(
      "Does each line search begin with alpha = 1? It should begin with the last alpha, times `grow`.",
      fits(options.shrink, 1, true));
  const auto halved =
      check.ask("Is alpha halved? It should be multiplied by `shrink`.", fits(0.5, options.grow, false));
  const rex::grading::Signal times = timesShrunk(sizes, options.shrink, options.grow);
  check.nearAlong("how often alpha was multiplied by `shrink` in a step of gradientDescent", times,
                  wholeNumbers(times), kTolerance);
}

inline void descends(rex::grading::Check& check, Student& student, const Landscape& land,
                     SearchOptions options) {
  options.tolerance = 1e-5 * land.gradient(land.start).norm();
  check.input(land.name, {{"start", land.start},
                          {"shrink", options.shrink},
                          {"grow", options.grow},
                          {"decrease", options.decrease},
                          {"tolerance", options.tolerance}});
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
  Steps steps;
  for (std::size_t t = 1; t < path.size(); ++t) {
    const Eigen::VectorXd x = path[t - 1], step = path[t] - x, g = land.gradient(x);
    const double alpha = -step.dot(g) / g.squaredNorm(), place = static_cast<double>(t);
    steps.angles.add(place, angleOf(step, -g, 1e-13 * x.norm()));
    steps.sizes.add(place, alpha);
    steps.decreases.add(place, shareOfSlope(land.f(x), land.f(path[t]), alpha, g.squaredNorm()));
  }
  check.atMostAlong("angle between a step of gradientDescent and the negative gradient", steps.angles, 1e-5,
                    "rad");
  decreases(check, "gradientDescent", steps, options.decrease);
  sizesAreTried(check, steps.sizes, options);
  check.atMost("norm of the gradient at the end of gradientDescent", land.gradient(path.back()).norm(),
               1.0001 * options.tolerance);
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
  check.input("phi is " + problem.name, {{"start", problem.start},
                                         {"shrink", options.shrink},
                                         {"decrease", options.decrease},
                                         {"tolerance", options.tolerance}});
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
  Steps steps;
  for (std::size_t t = 1; t < path.size(); ++t) {
    const Eigen::VectorXd x = path[t - 1], step = path[t] - x, phi = problem.phi(x);
    const Eigen::VectorXd full = -rex::leastSquares(problem.J(x), phi);
    const double alpha = step.dot(full) / full.squaredNorm(), place = static_cast<double>(t);
    steps.angles.add(place, angleOf(step, full, 1e-10 * (1 + x.norm())));
    steps.sizes.add(place, alpha);
    steps.decreases.add(place, shareOfSlope(phi.squaredNorm(), problem.phi(path[t]).squaredNorm(), alpha,
                                            gradient(x).dot(full)));
  }
  check.atMostAlong("angle between a step of gaussNewton and the d with J^T J d = -J^T phi", steps.angles,
                    1e-5, "rad");
  double longest = 0;
  for (const Eigen::VectorXd& alpha : steps.sizes.values) longest = std::max(longest, alpha[0]);
  const auto twice =
      check.ask("Full steps are twice too long: does one side of J^T J d = -J^T phi have a factor 2?",
                std::abs(longest - 2) < 1e-6);
  check.atMostAlong("alpha of a step of gaussNewton, its length divided by that of d", steps.sizes, 1 + 1e-4);
  decreases(check, "gaussNewton", steps, options.decrease);
  // The factor of two allows for solutions that compare half of the gradient with the tolerance.
  check.atMost("norm of the gradient at the end of gaussNewton", gradient(path.back()).norm(),
               2.0001 * options.tolerance);
}
