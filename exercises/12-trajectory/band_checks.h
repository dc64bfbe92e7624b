#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "grading/check.h"
#include "grading/evidence.h"
#include "interface.h"
#include "problems.h"
#include "term_checks.h"

// Part 2: what must hold for banded systems, their factors, and Gauss-Newton steps.

inline void isAssembled(rex::grading::Check& check, Student& student, int n, int steps, int k) {
  check.input(fmt::format("terms up to order {}, n = {}, T = {}", k, n, steps));
  const std::vector<Term> terms = randomTerms(check.rng(), n, steps, k);
  const BandSystem got = student.assembled(terms, n, steps);
  const FullSystem wanted = denseSystem(terms, n, steps);
  check.near("gradient g of assembled", got.g, wanted.g, 1e-9 * (1 + wanted.g.cwiseAbs().maxCoeff()));
  const int rows = (k + 1) * n;
  check.near("band of H of assembled", got.band, bandOf(wanted.H, rows),
             1e-9 * (1 + wanted.H.cwiseAbs().maxCoeff()));
}

inline void isFactor(rex::grading::Check& check, Student& student, Eigen::Index rows, Eigen::Index columns) {
  rex::Rng& rng = check.rng();
  const Eigen::MatrixXd factor = randomFactor(rng, rows, columns), band = squared(factor);
  check.input(fmt::format("a band of {} x {}", rows, columns), {{"H", band}});
  const Eigen::MatrixXd L = student.bandCholesky(band);
  check.shape("L of bandCholesky", L, rows, columns);
  // Entries are at most a few times the largest, 4 + 0.16 (rows - 1).
  check.near("L L^T, with L of bandCholesky", squared(L), band, 1e-9 * static_cast<double>(rows));
  const Eigen::VectorXd wanted = rng.normalVector(static_cast<int>(columns)), b = times(band, wanted);
  check.input(fmt::format("the L of bandCholesky, {} x {}", rows, columns), {{"L", L}, {"b", b}});
  const Eigen::VectorXd x = student.bandSolve(L, b);
  check.near("x of bandSolve", x, wanted, 1e-8);
}

inline double costOf(const std::vector<Term>& terms) {
  double cost = 0;
  for (const Term& term : terms) cost += term.y.squaredNorm();
  return cost;
}

inline double slopeOf(const std::vector<Term>& terms, const Eigen::MatrixXd& X) {
  return denseSystem(terms, static_cast<int>(X.rows()), static_cast<int>(X.cols())).g.cwiseAbs().maxCoeff();
}

inline rex::grading::Evidence slopesSeen(const Terms& terms, const std::vector<Eigen::MatrixXd>& path,
                                         double tolerance) {
  rex::Series slopes = rex::grading::gotCurve("got");
  slopes.style = rex::SeriesStyle::kLinesPoints;
  for (const Eigen::MatrixXd& X : path)
    slopes.add(static_cast<double>(slopes.x.size()), std::max(slopeOf(terms(X), X), 1e-15));
  rex::Figure figure{.title = "Largest entry of the gradient after each step",
                     .xLabel = "step",
                     .yLabel = "value [1]",
                     .logY = true,
                     .series = {std::move(slopes)}};
  figure.horizontalLines = {{.at = tolerance, .label = "wanted: at most"}};
  return {.figures = {std::move(figure)}};
}

/// Whether H of the last trajectory is singular, although the gradient is not small.
inline bool endsWhereSingular(const Terms& terms, const std::vector<Eigen::MatrixXd>& path,
                              const Eigen::MatrixXd& start, double tolerance) {
  const Eigen::MatrixXd& X = path.empty() ? start : path.back();
  if (X.rows() != start.rows() || X.cols() != start.cols() || !X.allFinite()) return false;
  const FullSystem system = denseSystem(terms(X), static_cast<int>(X.rows()), static_cast<int>(X.cols()));
  const Eigen::VectorXd s = rex::svd(system.H).s;
  return system.g.cwiseAbs().maxCoeff() > tolerance && s[s.size() - 1] < 1e-9 * s[0];
}

inline void descends(rex::grading::Check& check, Student& student, const std::string& name,
                     const Terms& terms, const Eigen::MatrixXd& start, std::size_t mostSteps) {
  const auto n = static_cast<int>(start.rows()), steps = static_cast<int>(start.cols());
  const double tolerance = 1e-6;
  check.input(name + fmt::format(", n = {}, T = {}, tolerance = {:g}", n, steps, tolerance));
  const std::vector<Eigen::MatrixXd> path = student.descended(terms, start, tolerance);
  const auto singular = check.ask(
      "Does it end where H is singular? Add a number to the diagonal of H, and try again: that damps the "
      "step.",
      endsWhereSingular(terms, path, start, tolerance));
  check.atLeast("number of trajectories that descended returns", static_cast<double>(path.size()), 2);
  check.atMost("number of steps of descended", static_cast<double>(path.size()) - 1, 300);
  for (const Eigen::MatrixXd& X : path) check.shape("trajectory", X, n, steps);
  check.near("first trajectory that descended returns", path.front(), start, 0);
  const auto shown = check.show([&] { return slopesSeen(terms, path, tolerance); });
  rex::grading::Signal changes;
  bool isFull = false;  // the first step after which F has grown
  for (std::size_t i = 1; i < path.size(); ++i) {
    changes.add(static_cast<double>(i), costOf(terms(path[i])) - costOf(terms(path[i - 1])));
    if (changes.values.back()[0] <= 0 || isFull) continue;
    const FullSystem system = denseSystem(terms(path[i - 1]), n, steps);
    const Eigen::VectorXd full = rex::leastSquares(system.H, -system.g);
    isFull = ((path[i] - path[i - 1]).reshaped() - full).norm() < 1e-4 * full.norm();
  }
  {
    const auto whole = check.ask("Is a full step taken although F grows?", isFull);
    check.atMostAlong("change of F by a step of descended", changes, 0);
  }
  check.atMost("largest entry of the gradient of F after the last step of descended",
               slopeOf(terms(path.back()), path.back()), tolerance);
  check.atMost("number of steps of descended until the gradient is small",
               static_cast<double>(path.size()) - 1, static_cast<double>(mostSteps));
}
