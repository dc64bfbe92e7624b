#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "grading/check.h"
#include "grading/evidence.h"
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
// what Armijo's condition compares: the decrease of f divided by what the slope promises, also for the trials
// with alpha / shrink before those steps that were shrunk.
struct Steps {
  rex::grading::Signal angles, sizes, decreases, trials;
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

// A step that was shrunk: the trial before it must not have been good enough. `value` is f, and `trial` where
// that trial was. Values that are not finite are never good enough.
inline void addTrialBefore(rex::grading::Signal& trials, double place, const ScalarFunction& value,
                           const Eigen::VectorXd& x, const Eigen::VectorXd& trial, double alpha,
                           double slope) {
  const double before = value(x), after = value(trial);
  if (!std::isfinite(after)) return;
  trials.add(place, (before - after - 1e-13 * std::abs(before)) / (alpha * std::abs(slope)) - 1e-6);
}

inline void takesTheFirst(rex::grading::Check& check, const std::string& function,
                          const rex::grading::Signal& trials, double decrease) {
  if (trials.at.empty()) return;
  const auto late =
      check.ask("Does the line search begin with the right alpha, and end with the first that holds?");
  check.atMostAlong(
      "(f before - f) / (alpha |slope|) of the trial before, with alpha / shrink, in " + function, trials,
      decrease);
}

// A search that takes `steps` steps takes fewer if there may not be as many.
inline void stopsAfter(rex::grading::Check& check, const std::string& function, std::size_t steps,
                       const std::function<std::vector<Eigen::VectorXd>(int maxSteps)>& search) {
  const int most = std::min(3, static_cast<int>(steps) / 2);
  if (most < 1) return;
  const double taken = static_cast<double>(search(most).size()) - 1;
  const auto rejected = check.ask("Do rejected trials count as steps?", taken < most);
  const auto more = check.ask("Is there a step after the last one?", taken == most + 1);
  check.near(fmt::format("number of steps of {} with maxSteps = {}", function, most), taken, most, 0);
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
  for (std::size_t t = 0; t < allowed.size(); ++t) wanted.add(static_cast<double>(t + 1), allowed[t]);
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

constexpr double kWholeNumber = 0.02;

inline void sizesAreTried(rex::grading::Check& check, const rex::grading::Signal& sizes,
                          const rex::grading::Signal& lengths, const SearchOptions& options) {
  const auto agree = [&](const rex::grading::Signal& values, double shrink, double grow, bool again) {
    const rex::grading::Signal times = timesShrunk(values, shrink, grow, again);
    const std::vector<Eigen::VectorXd> whole = wholeNumbers(times);
    for (std::size_t i = 0; i < whole.size(); ++i)
      if (std::abs(times.values[i][0] - whole[i][0]) > kWholeNumber) return false;
    return true;
  };
  const auto fits = [&](double shrink, double grow, bool again) { return agree(sizes, shrink, grow, again); };
  const auto unit =
      check.ask("Is the direction of length one? It is the gradient itself, with the opposite sign.",
                agree(lengths, options.shrink, options.grow, false));
  const auto stays =
      check.ask("Is alpha never multiplied by `grow`, or kept below 1?", fits(options.shrink, 1, false));
  const auto again = check.ask(
      "Does each line search begin with alpha = 1? It should begin with the last alpha, times `grow`.",
      fits(options.shrink, 1, true));
  const auto halved =
      check.ask("Is alpha halved? It should be multiplied by `shrink`.", fits(0.5, options.grow, false));
  const rex::grading::Signal times = timesShrunk(sizes, options.shrink, options.grow);
  check.nearAlong("how often alpha was multiplied by `shrink` in a step of gradientDescent", times,
                  wholeNumbers(times), kWholeNumber);
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
  rex::grading::Signal lengths;
  double firstTrial = 1;
  for (std::size_t t = 1; t < path.size(); ++t) {
    const Eigen::VectorXd x = path[t - 1], step = path[t] - x, g = land.gradient(x);
    const double alpha = -step.dot(g) / g.squaredNorm(), place = static_cast<double>(t);
    steps.angles.add(place, angleOf(step, -g, 1e-13 * x.norm()));
    steps.sizes.add(place, alpha);
    lengths.add(place, step.norm());
    steps.decreases.add(place, shareOfSlope(land.f(x), land.f(path[t]), alpha, g.squaredNorm()));
    const double before = alpha / options.shrink;
    if (before < 1.001 * firstTrial)
      addTrialBefore(steps.trials, place, land.f, x, x - before * g, before, g.squaredNorm());
    firstTrial = alpha * options.grow;
  }
  check.atMostAlong("angle between a step of gradientDescent and the negative gradient", steps.angles, 1e-5,
                    "rad");
  decreases(check, "gradientDescent", steps, options.decrease);
  sizesAreTried(check, steps.sizes, lengths, options);
  takesTheFirst(check, "gradientDescent", steps.trials, options.decrease);
  check.atMost("norm of the gradient at the end of gradientDescent", land.gradient(path.back()).norm(),
               1.0001 * options.tolerance);
  stopsAfter(check, "gradientDescent", path.size() - 1, [&](int maxSteps) {
    SearchOptions few = options;
    few.maxSteps = maxSteps;
    return student.gradientDescent(land.f, land.gradient, land.start, few);
  });
}
