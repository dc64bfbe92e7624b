#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "grid_checks.h"

// Part 4: whole tours.

// A sine of the number of the step, with a random period and phase.
inline std::function<double(Eigen::Index)> randomWave(double shortest, double longest, rex::Rng& rng) {
  const double period = rng.uniform(shortest, longest), phase = rng.uniform(0, kTurn);
  return
      [period, phase](Eigen::Index t) { return std::sin(kTurn * static_cast<double>(t) / period + phase); };
}

/// The poses of a tour of 106 steps, at least 0.4 m from all walls: around the block, and along its first
/// side once more, from any corner and either way. Speed, line and heading are wavy: over 14 seeds, constant
/// speed on straight lines is off by 0.9 m at least, and the map along them overlaps by 0.71 at most.
inline Eigen::Matrix3Xd randomTourPoses(rex::Rng& rng) {
  const double a = 2.3, b = 9.7;
  const std::array<Eigen::Vector2d, 4> corners{{{a, a}, {b, a}, {b, b}, {a, b}}};
  const int first = rng.index(4), next = rng.index(2) == 0 ? 1 : 3;
  std::vector<Eigen::Vector2d> points;
  for (int i = 0; i < 6; ++i) points.push_back(corners[static_cast<std::size_t>((first + i * next) % 4)]);
  const Eigen::Matrix3Xd line = rex::posesAlong(points, .05, .05);
  constexpr Eigen::Index kSteps = 106;
  Eigen::VectorXd way = Eigen::VectorXd::Zero(kSteps + 1);
  while (way[10] <= .1 * way[kSteps]) {  // a fast beginning: many scans from one place hide the first
    const auto speed = randomWave(40, 80, rng);
    for (Eigen::Index t = 0; t < kSteps; ++t) way[t + 1] = way[t] + 1 + .4 * speed(t);
  }
  Eigen::Matrix3Xd poses(3, kSteps + 1);
  for (Eigen::Index t = 0; t <= kSteps; ++t)
    poses.col(t) = line.col(std::lround(way[t] / way[kSteps] * static_cast<double>(line.cols() - 1)));
  for (int k = 0; k < 3; ++k) {
    const auto slow = randomWave(25, 45, rng), fast = randomWave(9, 15, rng);
    for (Eigen::Index t = 0; t <= kSteps; ++t) poses(k, t) += (k < 2 ? .15 : .3) * slow(t) + .1 * fast(t);
  }
  return poses;
}

// A tour on which odometry alone is off by 0.8 m at least; with `steps`, the first ones of any tour.
inline Tour misleadingTour(int steps, rex::Rng& rng) {
  const rex::Building building = randomBuilding(rng);
  const Eigen::Matrix3Xd all = randomTourPoses(rng), poses = steps > 0 ? all.leftCols(steps + 1) : all;
  for (;;) {
    const Tour tour = tourOf(building, poses, rng);
    if (steps > 0 || pathError(reckoned(tour.log), tour.truth) > .8) return tour;
  }
}

/// Requires that scans along the path draw the map.
inline void isDrawn(Check& check, const Mapped& got, const Log& log, const CellEvidence& evidence) {
  check.near("length of the path of mapped", static_cast<double>(got.path.size()),
             static_cast<double>(log.scans.size()), 0);
  check.shape("values of the map of mapped", got.map.values, 60, 60);
  check.near("first pose of mapped", got.path.front(), log.start, 1e-9);
  for (const Eigen::Vector3d& pose : got.path)
    check.atMost("distance of a pose of mapped from the start", (pose - log.start).head<2>().norm(), 30, "m");
  Grid drawn = emptyGrid(), later = drawn, late = drawn;
  for (std::size_t t = 0; t < got.path.size(); ++t) {
    drawn = mapAfter(drawn, got.path[t], log.scans[t], evidence);
    late = mapAfter(late, got.path[t], log.scans[t > 0 ? t - 1 : 0], evidence);
    if (t > 0) later = mapAfter(later, got.path[t], log.scans[t], evidence);
  }
  // Cells that a ray hardly passes may differ by one scan or two.
  const auto shareOff = [&](const Grid& map) {
    return ((map.values - got.map.values).array().abs() > .5).cast<double>().mean();
  };
  const auto first = check.ask("Is the first scan missing in the map?", shareOff(later) < .05);
  const auto scanBefore =
      check.ask("Does each motion go with the scan before it? scans[t + 1] comes after motions[t].",
                shareOff(late) < .05);
  const auto mixed = check.ask("Is it the map of another particle than the path?");
  check.atMost("share of the cells in which the map of mapped is not what scans draw along its path",
               shareOff(drawn), .08);
}

inline void maps(Check& check, Student& student) {
  const Tour tour = misleadingTour(0, check.rng());
  constexpr int kParticles = 12;
  check.input("a tour of " + std::to_string(tour.log.motions.size()) +
              " steps with 45 rays, and 12 particles");
  const Settings settings;
  const Mapped got = student.mapped(tour.log, emptyGrid(), settings, kParticles, check.split(7));
  const Grid truth = gridOf(tour.building);
  check.near("number of effective sizes of mapped", static_cast<double>(got.effectiveSizes.size()),
             static_cast<double>(tour.log.motions.size()), 0);
  for (const double size : got.effectiveSizes) {
    check.atLeast("effective size", size, 1 - 1e-6);
    check.atMost("effective size", size, kParticles + 1e-6);
  }
  const auto shown = check.show([&] {
    Evidence evidence = gridsOf(truth, got.map.values.cwiseMax(-5).cwiseMin(5), truth.values, "log odds");
    for (rex::Figure& figure : evidence.figures)
      figure.series = {rex::through(tour.truth, rex::grading::wantedCurve("true path")),
                       rex::through(got.path, rex::grading::wrongCurve("got"))};
    return evidence;
  });
  isDrawn(check, got, tour.log, settings.evidence);
  check.atMost("root mean square error of the positions of mapped", pathError(got.path, tour.truth), .6, "m");
  check.atLeast("overlap of the walls of mapped with the true ones", overlapOf(got.map, truth), .75);
}

/// The log weight of a particle with that path if nothing is ever resampled.
inline double logWeightOf(const std::vector<Eigen::Vector3d>& path, const Log& log,
                          const Settings& settings) {
  double sum = 0;
  Grid map = emptyGrid();
  for (std::size_t t = 0; t < path.size(); ++t) {
    if (t > 0) sum += fitOf(distancesTo(map, settings.reach), path[t], log.scans[t], settings.deviation);
    map = mapAfter(map, path[t], log.scans[t], settings.evidence);
  }
  return sum / settings.temper;
}

/// The log weight that a quarter of all particles do not reach, if poses are not matched. The best of ten
/// is below it in one of a hundred thousand cases.
inline double lowLogWeight(const Log& log, const Settings& settings, rex::Rng rng) {
  std::vector<double> weights;
  for (int n = 0; n < 40; ++n) {
    std::vector<Eigen::Vector3d> path{log.start};
    for (const Eigen::Vector3d& motion : log.motions)
      path.push_back(
          rex::movedPose(path.back(), motion + settings.odometry.cwiseProduct(rng.normalVector(3))));
    weights.push_back(logWeightOf(path, log, settings));
  }
  std::nth_element(weights.begin(), weights.begin() + 9, weights.end());
  return weights[9];
}

/// With a threshold of 0 nothing is resampled, with one above 1 always.
inline void keepsRule(Check& check, Student& student) {
  const Tour tour = misleadingTour(40, check.rng());
  Settings settings;
  settings.matches = false;
  settings.temper = 10;
  const auto sizesFor = [&](double threshold) {
    settings.threshold = threshold;
    check.input("a tour of 40 steps and 10 particles, without matches", {{"threshold", threshold}});
    const Mapped got = student.mapped(tour.log, emptyGrid(), settings, 10, check.split(7));
    check.near("number of effective sizes of mapped", static_cast<double>(got.effectiveSizes.size()), 40, 0);
    isDrawn(check, got, tour.log, settings.evidence);
    const auto least = check.ask("Is it a particle of the largest weight?");
    if (threshold <= 0)
      check.atLeast("log weight of the path of mapped", logWeightOf(got.path, tour.log, settings),
                    lowLogWeight(tour.log, settings, check.rng().split(7)));
    return got.effectiveSizes;
  };
  const auto meanOfLast = [](const std::vector<double>& sizes) {
    return Eigen::Map<const Eigen::VectorXd>(sizes.data(), 40).tail(15).mean();
  };
  std::vector<double> always;
  const std::vector<double> never = sizesFor(0);
  const auto shown = check.show([&] {
    const auto curve = [](const std::vector<double>& sizes, rex::Series series) {
      for (std::size_t t = 0; t < sizes.size(); ++t) series.add(static_cast<double>(t), sizes[t]);
      return series;
    };
    rex::Figure figure{.title = "effective sizes of 10 particles",
                       .xLabel = "step",
                       .yLabel = "effective size",
                       .series = {curve(never, rex::grading::gotCurve("threshold 0"))}};
    if (!always.empty()) figure.series.push_back(curve(always, rex::grading::wantedCurve("threshold 1.1")));
    return Evidence{.figures = {figure}};
  });
  {
    const auto resampledAll =
        check.ask("Are particles resampled even if the effective size is not below the threshold?");
    check.atMost("mean effective size of the last steps if the threshold is 0", meanOfLast(never), 3);
  }
  always = sizesFor(1.1);
  {
    const auto after = check.ask("Are these the sizes after resampling? Then all weights are equal.");
    check.atMost("least effective size if the threshold is above 1",
                 *std::min_element(always.begin(), always.end()), 9.99);
  }
  const auto neverDone = check.ask("Are particles never resampled, or do they keep their weights?");
  check.atLeast("mean effective size of the last steps if the threshold is above 1", meanOfLast(always), 4.5);
  settings.temper = 1e6;
  const std::vector<double> equal = sizesFor(0);
  check.atLeast("least effective size if scans hardly count", *std::min_element(equal.begin(), equal.end()),
                9.9);
}
