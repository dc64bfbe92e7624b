#pragma once

#include <string>
#include <utility>
#include <vector>

#include "car_runs.h"
#include "course/car_pictures.h"
#include "course/car_view.h"
#include "grading/evidence.h"

// What the checks show when a belief is wrong.

inline std::vector<rex::PlanarGaussian> landmarksOf(const Belief& joint) {
  std::vector<rex::PlanarGaussian> places;
  for (Eigen::Index at = 3; at + 1 < joint.mean.size(); at += 2)
    places.push_back({joint.mean.segment<2>(at), joint.covariance.block<2, 2>(at, at)});
  return places;
}

/// What is measured of several runs, in each of them, with the limits of the mean.
inline rex::Figure overRuns(const std::string& title, const std::string& unit,
                            const std::vector<double>& values, const std::vector<rex::Guide>& limits) {
  rex::Series series = rex::grading::gotCurve("got", {}, values);
  for (std::size_t i = 0; i < values.size(); ++i) series.x.push_back(static_cast<double>(i + 1));
  series.style = rex::SeriesStyle::kPoints;
  series.marker = rex::Marker::kDot;
  series.size = 2;
  return {.title = title, .xLabel = "run", .yLabel = unit, .series = {series}, .horizontalLines = limits};
}

/// A map built on a run, drawn over the true one.
inline rex::Figure mapSeen(const CarRun& run, const Belief& joint) {
  rex::Figure figure =
      rex::carFigure({.car = run.states.back(),
                      .estimate = joint.mean.head<3>(),
                      .landmarks = run.landmarks,
                      .landmarkBeliefs = landmarksOf(joint),
                      .paths = {{.name = "wanted: the car", .points = rex::pathPoints(run.states)}}});
  figure.title = "A map: ellipses (got) and true positions (wanted)";
  return figure;
}

/// A filter's beliefs of a run: one after each step.
struct TrackedRun {
  CarRun run{};
  std::vector<Belief> beliefs{};
  double error = -1;  ///< the greatest position error, m
};

/// A film of the car and its estimate in the worst of several runs, which opens where they are farthest from
/// each other. Beside it `figure` with values of all runs, one per step.
inline rex::grading::Evidence trackSeen(const TrackedRun& worst, rex::Figure figure,
                                        const Eigen::VectorXd& values) {
  const CarRun& run = worst.run;
  rex::Film film;
  rex::Series curve = rex::grading::gotCurve("got");
  double largest = -1, moment = 0;
  for (std::size_t t = 0; t < worst.beliefs.size(); ++t) {
    const double time = run.car.tau * static_cast<double>(t + 1);
    const Belief& belief = worst.beliefs[t];
    const Eigen::Matrix2d spread = belief.covariance.topLeftCorner<2, 2>();
    film.push_back({time, carPicture(rex::CarView{.car = run.states[t + 1],
                                                  .estimate = belief.mean.head<3>(),
                                                  .landmarks = run.landmarks,
                                                  .poseBeliefs = {{belief.mean.head<2>(), spread}},
                                                  .caption = "the worst run; solid: the car; pale: the "
                                                             "estimate"})});
    curve.add(static_cast<double>(t + 1), values[static_cast<Eigen::Index>(t)]);
    const double error = (belief.mean - run.states[t + 1]).head(2).norm();
    if (error <= largest) continue;
    largest = error;
    moment = time;
  }
  figure.xLabel = "step";
  figure.series = {curve};
  return {.figures = {figure}, .film = std::move(film), .view = rex::kFromAbove, .moment = moment};
}
