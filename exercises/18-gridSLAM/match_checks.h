#pragma once

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "grid_checks.h"

// Parts 3 and 5: scan matching, near a guess and anywhere.

// A scan in a random building, and where it was taken.
struct Sight {
  Grid truth{}, distances{};
  Eigen::Vector3d pose = Eigen::Vector3d::Zero();
  Scan scan{};
};
inline Sight randomSight(rex::Rng& rng) {
  const rex::Building building = randomBuilding(rng);
  Sight sight{.truth = gridOf(building)};
  sight.distances = distancesTo(sight.truth, Settings{}.reach);
  const rex::RangeScanner scanner = scannerOf(45, 6.5);
  // On the way of a tour, and a little aside.
  const double along = rng.uniform(2.2, 9.8), aside = (rng.index(2) == 0 ? 2.4 : 9.6) + rng.uniform(-.3, .3);
  sight.pose << along, aside, rng.uniform(-3, 3);
  if (rng.index(2) == 0) std::swap(sight.pose[0], sight.pose[1]);
  sight.scan = scanOf(scanner, rex::noisyRanges(building, scanner, sight.pose, .02, rng));
  return sight;
}

inline rex::Figure fitAround(const Sight& sight, const Eigen::Vector3d& middle, double heading, double size) {
  Grid grid{middle.head<2>() - Eigen::Vector2d::Constant(size), size / 20, Eigen::MatrixXd(40, 40)};
  for (int i = 0; i < 40; ++i)
    for (int j = 0; j < 40; ++j) {
      const Eigen::Vector2d p = grid.origin + grid.cell * Eigen::Vector2d(i + .5, j + .5);
      grid.values(i, j) = fitOf(sight.distances, {p[0], p[1], heading}, sight.scan, .15);
    }
  return gridFigure("how well the scan fits, with the best heading", grid, grid.values.minCoeff(),
                    grid.values.maxCoeff(), "fit");
}

inline void matches(Check& check, Student& student, double share) {
  const Sight sight = randomSight(check.rng());
  const double deviation = Settings{}.deviation;
  const Eigen::Vector2d window(rounded(check.rng().uniform(.2, .35)), rounded(check.rng().uniform(.1, .2)));
  Eigen::Vector3d guess = sight.pose;
  for (int k = 0; k < 3; ++k)
    guess[k] += (check.rng().index(2) == 0 ? 1 : -1) * share * window[k / 2] * check.rng().uniform(.5, 1);
  check.input("a scan in a building, a guess and a window", {{"guess", guess}, {"window", window}});
  const Eigen::Vector3d got = student.matched(sight.distances, sight.scan, deviation, guess, window),
                        best = bestIn(sight.distances, sight.scan, deviation, guess, window);
  const auto rate = [&](const Eigen::Vector3d& pose) {
    return fitOf(sight.distances, pose, sight.scan, deviation);
  };
  const auto shown = check.show([&] {
    rex::Figure figure = fitAround(sight, guess, best[2], 1.3 * window[0]);
    const double w = window[0];
    figure.series = {{.label = "window",
                      .x = {guess[0] - w, guess[0] + w, guess[0] + w, guess[0] - w, guess[0] - w},
                      .y = {guess[1] - w, guess[1] - w, guess[1] + w, guess[1] + w, guess[1] - w}},
                     rex::dots(guess, {.label = "guess", .marker = rex::Marker::kCross, .size = 2.5}),
                     rex::dots(best, {.label = "best", .marker = rex::Marker::kSquare, .size = 2.5}),
                     rex::grading::wrongPoint("got", got[0], got[1])};
    return Evidence{.figures = {figure}};
  });
  const Eigen::Vector3d apart(got[0] - guess[0], got[1] - guess[1], std::remainder(got[2] - guess[2], kTurn));
  {
    const auto leaves = check.ask("May each step leave the window? It is around the guess.");
    check.atMost("how far matched is from the guess in x or y", apart.head<2>().cwiseAbs().maxCoeff(),
                 window[0] + 1e-9, "m");
    check.atMost("how far the heading of matched is from the guess", std::abs(apart[2]), window[1] + 1e-9,
                 "rad");
  }
  const auto same = check.ask("Is it the guess?", apart.norm() < 1e-9);
  const auto unturned = check.ask("Is the heading never changed?", apart[2] == 0);
  const auto unmoved = check.ask("Is only the heading changed?", apart.head<2>().norm() == 0);
  const double aside = std::abs(apart[1]), limit = window[1] + 1e-9;
  const auto narrow =
      check.ask("Is y limited by window[1]? That is for the heading, window[0] for x and y.",
                aside <= limit && aside > .9 * limit && std::abs(best[1] - guess[1]) > limit + .01);
  const auto local =
      check.ask("Is it the summit of a small hill? Begin at several poses.",
                rate(got) >= rate(bestIn(sight.distances, sight.scan, deviation, got, {.03, .02})) - .5);
  const auto coarse = check.ask("Are the last steps too large, or are there too few?",
                                (got - best).head<2>().norm() < .1 && std::abs(got[2] - best[2]) < .1);
  check.atLeast("fit of matched", rate(got), rate(best) - 1 - .05 * (rate(best) - rate(guess)));
}

/// Only one place fits. The best of all others, a metre away or turned by half a radian, fit clearly worse,
/// even after a match.
inline bool isUnique(const Sight& sight) {
  const Grid wide = distancesTo(sight.truth, 1.2);
  std::vector<std::pair<double, Eigen::Vector3d>> others;
  for (int i = 0; i < 60; i += 2)
    for (int j = 0; j < 60; j += 2)
      for (int k = 0; k < 24 && sight.truth.values(i, j) < 0; ++k) {
        const Eigen::Vector3d pose(.2 * i + .1, .2 * j + .1, kTurn / 24 * k);
        if ((pose - sight.pose).head<2>().norm() > 1 ||
            std::abs(std::remainder(pose[2] - sight.pose[2], kTurn)) > .5)
          others.emplace_back(fitOf(wide, pose, sight.scan, .3), pose);
      }
  std::partial_sort(others.begin(), others.begin() + 3, others.end(),
                    [](const auto& a, const auto& b) { return a.first > b.first; });
  const auto rate = [&](const Eigen::Vector3d& pose) {
    return fitOf(sight.distances, pose, sight.scan, Settings{}.deviation);
  };
  return rate(sight.pose) > -4 && std::all_of(others.begin(), others.begin() + 3, [&](const auto& other) {
           return rate(bestIn(sight.distances, sight.scan, Settings{}.deviation, other.second, {.3, .2})) <
                  -10;
         });
}

inline void locates(Check& check, Student& student) {
  Sight sight = randomSight(check.rng());
  while (!isUnique(sight)) sight = randomSight(check.rng());
  check.input("a scan somewhere in a building", {{"ranges", sight.scan.ranges}});
  const Eigen::Vector3d got = student.located(sight.truth, sight.scan, {});
  const auto shown = check.show([&] {
    rex::Figure figure = gridFigure("the map", sight.truth, -5, 5, "log odds");
    const auto ends = [&](const Eigen::Vector3d& pose, rex::Series series) {
      series.style = rex::SeriesStyle::kPoints;
      for (Eigen::Index k = 0; k < sight.scan.ranges.size(); ++k) {
        const Eigen::Vector2d end = endOf(pose, sight.scan, k);
        series.add(end[0], end[1]);
      }
      return series;
    };
    figure.series = {ends(sight.pose, rex::grading::wantedCurve("the scan, wanted")),
                     ends(got, rex::grading::wrongCurve("the scan, got"))};
    return Evidence{.figures = {figure}};
  });
  const auto mirrored = check.ask("Is the heading wrong?", (got - sight.pose).head<2>().norm() < .4);
  check.atMost("how far located is from the true position", (got - sight.pose).head<2>().norm(), .2, "m");
  check.nearAngle("heading of located", got[2], sight.pose[2], .1);
}
