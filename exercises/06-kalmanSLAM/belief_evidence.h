#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "car_runs.h"
#include "course/car_figure.h"
#include "course/car_pictures.h"
#include "grading/evidence_parts.h"

// What the checks show when a belief is wrong.

inline rex::Way wayOf(const std::string& name, const std::vector<Eigen::Vector3d>& poses) {
  rex::Way way{.name = name, .points = Eigen::Matrix2Xd(2, static_cast<Eigen::Index>(poses.size()))};
  for (Eigen::Index i = 0; i < way.points.cols(); ++i)
    way.points.col(i) = poses[static_cast<std::size_t>(i)].head<2>();
  return way;
}

inline std::vector<rex::PlanarGaussian> landmarksOf(const Belief& joint) {
  std::vector<rex::PlanarGaussian> places;
  for (Eigen::Index at = 3; at + 1 < joint.mean.size(); at += 2)
    places.push_back({joint.mean.segment<2>(at), joint.covariance.block<2, 2>(at, at)});
  return places;
}

/// A map built on a run, drawn over the true one.
inline rex::grading::Evidence mapSeen(const CarRun& run, const Belief& joint) {
  rex::Figure figure = rex::figureOf({.car = run.states.back(),
                                      .estimate = joint.mean.head<3>(),
                                      .landmarks = run.landmarks,
                                      .landmarkBeliefs = landmarksOf(joint),
                                      .ways = {wayOf("wanted: the car", run.states)}});
  figure.title = "The map: ellipses (got) and true positions (wanted)";
  return {.figures = {figure}};
}

/// A filter's beliefs of a run: one after each step.
struct TrackedRun {
  CarRun run{};
  std::vector<Belief> beliefs{};
  double error = -1;  ///< the greatest position error, m
};

/// A film of the car and its estimate, which opens where they are farthest from each other.
inline rex::grading::Evidence trackSeen(const TrackedRun& tracked) {
  const CarRun& run = tracked.run;
  rex::Film film;
  rex::Series error = rex::grading::gotCurve("got"),
              sigmas = rex::grading::wantedCurve("2 sigma of the filter");
  for (std::size_t t = 0; t < tracked.beliefs.size(); ++t) {
    const double time = run.car.tau * static_cast<double>(t + 1);
    const Belief& belief = tracked.beliefs[t];
    const Eigen::Matrix2d spread = belief.covariance.topLeftCorner<2, 2>();
    film.push_back({time, pictureOf(rex::CarView{.car = run.states[t + 1],
                                                 .estimate = belief.mean.head<3>(),
                                                 .landmarks = run.landmarks,
                                                 .poseBeliefs = {{belief.mean.head<2>(), spread}},
                                                 .caption = "solid: the car; pale: the estimate"})});
    for (rex::Series* series : {&error, &sigmas}) series->x.push_back(time);
    error.y.push_back((belief.mean.head<2>() - run.states[t + 1].head<2>()).norm());
    sigmas.y.push_back(2 * std::sqrt(spread.trace()));
  }
  if (film.empty()) return {};
  const auto worst = std::max_element(error.y.begin(), error.y.end()) - error.y.begin();
  const double moment = film[static_cast<std::size_t>(worst)].time;
  rex::Figure figure{.title = "Position error in the worst of the runs",
                     .xLabel = "time [s]",
                     .yLabel = "distance [m]",
                     .series = {error, sigmas}};
  figure.verticalLines = {rex::grading::wrongFrom(moment)};
  return {
      .figures = {figure}, .film = std::move(film), .view = rex::CarPictureOptions{}.view, .moment = moment};
}
