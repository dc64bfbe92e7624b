#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "descent_checks.h"
#include "grading/check.h"
#include "interface.h"
#include "random_matrices.h"

// Part 2: sums of squares to minimise, and what must hold for every step of Gauss-Newton.

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
  const ScalarFunction f = [&](const Eigen::VectorXd& x) { return problem.phi(x).squaredNorm(); };
  options.tolerance = 1e-5 * gradient(problem.start).norm();
  check.input("phi is " + problem.name, {{"start", problem.start},
                                         {"shrink", options.shrink},
                                         {"decrease", options.decrease},
                                         {"tolerance", options.tolerance}});
  const std::vector<Eigen::VectorXd> path =
      student.gaussNewton(problem.phi, problem.J, problem.start, options);
  const auto shown = check.show([&] {
    std::vector<double> values, allowed;
    for (const Eigen::VectorXd& x : path) values.push_back(f(x));
    for (std::size_t t = 0; t + 1 < path.size(); ++t)
      allowed.push_back(values[t] + options.decrease * gradient(path[t]).dot(path[t + 1] - path[t]));
    return descentSeen(values, allowed);
  });
  checkPath(check, path, problem.start, options.maxSteps);
  Steps steps;
  for (std::size_t t = 1; t < path.size(); ++t) {
    const Eigen::VectorXd x = path[t - 1], step = path[t] - x;
    const Eigen::VectorXd full = -rex::leastSquares(problem.J(x), problem.phi(x));
    const double alpha = step.dot(full) / full.squaredNorm(), place = static_cast<double>(t);
    steps.angles.add(place, angleOf(step, full, 1e-10 * (1 + x.norm())));
    steps.sizes.add(place, alpha);
    const double slope = gradient(x).dot(full), before = alpha / options.shrink;
    steps.decreases.add(place, shareOfSlope(f(x), f(path[t]), alpha, slope));
    if (before < 1.001) addTrialBefore(steps.trials, place, f, x, x + before * full, before, slope);
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
  {
    const rex::grading::Signal times = timesShrunk(steps.sizes, options.shrink, 1, true);
    const auto kept =
        check.ask("Does alpha stay from step to step? Every step of gaussNewton tries 1 first.");
    check.nearAlong("how often alpha was multiplied by `shrink` in a step of gaussNewton", times,
                    wholeNumbers(times), kWholeNumber);
    takesTheFirst(check, "gaussNewton", steps.trials, options.decrease);
  }
  // The factor of two allows for solutions that compare half of the gradient with the tolerance.
  check.atMost("norm of the gradient at the end of gaussNewton", gradient(path.back()).norm(),
               2.0001 * options.tolerance);
  stopsAfter(check, "gaussNewton", path.size() - 1, [&](int maxSteps) {
    SearchOptions few = options;
    few.maxSteps = maxSteps;
    return student.gaussNewton(problem.phi, problem.J, problem.start, few);
  });
}
