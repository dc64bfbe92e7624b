#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "course/car_figure.h"
#include "course/car_pictures.h"
#include "drives.h"
#include "grading/evidence_parts.h"

// What the checks show when a cloud of particles is wrong, or when a filter has lost its car.

/// A filter's clouds and their means, step by step.
struct TrackRecord {
  std::vector<Cloud> clouds{};
  std::vector<Eigen::Vector3d> means{};
};

inline rex::Way wayOf(const std::string& name, const std::vector<Eigen::Vector3d>& poses,
                      const rex::Color& color) {
  rex::Way way{
      .name = name, .points = Eigen::Matrix2Xd(2, static_cast<Eigen::Index>(poses.size())), .color = color};
  for (Eigen::Index i = 0; i < way.points.cols(); ++i)
    way.points.col(i) = poses[static_cast<std::size_t>(i)].head<2>();
  return way;
}

/// The car, and the estimate with its ellipse. The film opens where they are first more than twice as far
/// apart as they may be on average, or else where they are farthest apart.
inline rex::grading::Evidence trackSeen(const CarWorld& world, const Driven& driven,
                                        const TrackRecord& record, double limit) {
  const std::size_t count = record.means.size();
  if (count == 0) return {};
  rex::Series error = rex::grading::gotCurve("got");
  rex::Film film;
  for (std::size_t t = 0; t < count; ++t) {
    const double time = world.tau * static_cast<double>(t + 1);
    const Eigen::Matrix3d spread = covarianceAround(record.clouds[t], record.means[t]);
    const rex::CarView view{.car = driven.truth[t],
                            .estimate = record.means[t],
                            .landmarks = world.landmarks,
                            .poseBeliefs = {{record.means[t].head<2>(), spread.topLeftCorner<2, 2>()}},
                            .caption = "solid: the car; pale: the estimate"};
    film.push_back({time, pictureOf(view)});
    error.x.push_back(time);
    error.y.push_back((record.means[t] - driven.truth[t]).head<2>().norm());
  }
  auto lost = std::find_if(error.y.begin(), error.y.end(), [&](double far) { return far > 2 * limit; });
  if (lost == error.y.end()) lost = std::max_element(error.y.begin(), error.y.end());
  const double moment = film[static_cast<std::size_t>(lost - error.y.begin())].time;
  rex::Figure map = rex::figureOf({.landmarks = world.landmarks,
                                   .ways = {wayOf("wanted: the car", driven.truth, rex::kTruthColor),
                                            wayOf("got: the estimate", record.means, rex::kEstimateColor)}});
  map.title = "The car and its estimate";
  rex::Figure errors{
      .title = "Position error", .xLabel = "time [s]", .yLabel = "distance [m]", .series = {error}};
  errors.horizontalLines = {{.at = limit, .label = "wanted: root mean square at most"}};
  errors.verticalLines = {rex::grading::wrongFrom(moment)};
  return {.figures = {map, errors},
          .film = std::move(film),
          .view = rex::CarPictureOptions{}.view,
          .moment = moment};
}

/// Noise in standard deviations, one column per particle; the first two entries are drawn.
inline rex::grading::Evidence noiseSeen(const Eigen::MatrixXd& d) {
  rex::Series dots = rex::grading::through(d.colwise(), rex::Series{.label = "got",
                                                                    .style = rex::SeriesStyle::kPoints,
                                                                    .marker = rex::Marker::kDot,
                                                                    .size = .8,
                                                                    .color = rex::grading::kGotColor});
  rex::Figure figure{.title = "Noise of the particles",
                     .xLabel = "in x, standard deviations",
                     .yLabel = "in y, standard deviations",
                     .equalAxes = true,
                     .series = {dots}};
  figure.ellipses = {{.label = "wanted: 95 % inside", .sigmas = 2.45, .color = rex::grading::kWantedColor}};
  return {.figures = {figure}};
}

/// Landmarks in the frame of the car, as a stacked vector.
inline rex::grading::Evidence viewSeen(const Eigen::VectorXd& got, const Eigen::VectorXd& wanted) {
  if (got.size() != wanted.size()) return {};
  const auto dots = [](const char* label, const Eigen::VectorXd& y, rex::Marker marker, rex::Color color) {
    const rex::Series look{
        .label = label, .style = rex::SeriesStyle::kPoints, .marker = marker, .size = 2, .color = color};
    return rex::grading::through(y.reshaped(2, y.size() / 2).colwise(), look);
  };
  return {.figures = {{.title = "Landmarks as the car sees them; it stands at (0, 0)",
                       .xLabel = "ahead [m]",
                       .yLabel = "left [m]",
                       .equalAxes = true,
                       .series = {dots("got", got, rex::Marker::kDot, rex::grading::kGotColor),
                                  dots("wanted", wanted, rex::Marker::kCircle, rex::grading::kWantedColor),
                                  {.label = "car",
                                   .x = {0},
                                   .y = {0},
                                   .style = rex::SeriesStyle::kPoints,
                                   .marker = rex::Marker::kTriangle,
                                   .size = 2}}}}};
}

/// A cloud with the mean pose that was returned, and the wanted one.
inline rex::grading::Evidence meanSeen(const Cloud& cloud, const Eigen::Vector3d& got,
                                       const Eigen::Vector3d& wanted) {
  rex::Figure figure{
      .title = "The particles, and their mean", .xLabel = "x [m]", .yLabel = "y [m]", .equalAxes = true};
  rex::Arrows arrows{.label = "particles"};
  for (const auto& pose : cloud.states.colwise()) {
    arrows.x.push_back(pose[0]);
    arrows.y.push_back(pose[1]);
    arrows.dx.push_back(.3 * std::cos(pose[2]));
    arrows.dy.push_back(.3 * std::sin(pose[2]));
  }
  const auto hand = [](const Eigen::Vector3d& pose, const rex::Series& look) {
    const Eigen::Vector2d ahead(std::cos(pose[2]), std::sin(pose[2]));
    const std::vector<Eigen::Vector2d> ends{pose.head<2>(), pose.head<2>() + ahead};
    return rex::grading::through(ends, look);
  };
  figure.arrows = {arrows};
  figure.series = {hand(got, rex::grading::gotCurve("got: position and heading")),
                   hand(wanted, rex::grading::wantedCurve("wanted"))};
  return {.figures = {figure}};
}
