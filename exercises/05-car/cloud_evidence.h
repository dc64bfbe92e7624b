#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "course/car_pictures.h"
#include "course/car_view.h"
#include "drives.h"
#include "grading/evidence.h"
#include "render/figure_builders.h"

// What the checks show when a cloud of particles is wrong, or when a filter has lost its car.

/// A filter's clouds and their means, step by step.
struct TrackRecord {
  std::vector<Cloud> clouds{};
  std::vector<Eigen::Vector3d> means{};
};

/// A quantity after each step of a drive, against its limit on average.
struct Course {
  std::string title{}, unit{};
  std::vector<double> values{};
  double limit = 0;
};

/// The car, and the estimate with its ellipse, beside the quantity that failed. The film opens where that is
/// first more than twice as large as it may be on average, or else where it is largest.
inline rex::grading::Evidence trackSeen(const CarWorld& world, const Driven& driven,
                                        const TrackRecord& record, const Course& course) {
  const std::size_t count = record.means.size();
  if (count == 0 || course.values.size() != count) return {};
  rex::Series value = rex::grading::gotCurve("got");
  rex::Film film;
  for (std::size_t t = 0; t < count; ++t) {
    const double time = world.tau * static_cast<double>(t + 1);
    const Eigen::Matrix3d spread = covarianceAround(record.clouds[t], record.means[t]);
    const rex::CarView view{.car = driven.truth[t],
                            .estimate = record.means[t],
                            .landmarks = world.landmarks,
                            .poseBeliefs = {{record.means[t].head<2>(), spread.topLeftCorner<2, 2>()}},
                            .caption = "solid: the car; pale: the estimate"};
    film.push_back({time, carPicture(view)});
    value.add(time, course.values[t]);
  }
  auto lost =
      std::find_if(value.y.begin(), value.y.end(), [&](double far) { return far > 2 * course.limit; });
  if (lost == value.y.end()) lost = std::max_element(value.y.begin(), value.y.end());
  const double moment = film[static_cast<std::size_t>(lost - value.y.begin())].time;
  const rex::Figure map =
      rex::carFigure({.landmarks = world.landmarks,
                      .paths = {{.name = "wanted: the car", .points = rex::pathPoints(driven.truth)},
                                {.name = "got: the estimate",
                                 .points = rex::pathPoints(record.means),
                                 .color = rex::kEstimateColor}},
                      .caption = "The car and its estimate"});
  rex::Figure values{
      .title = course.title, .xLabel = "time [s]", .yLabel = "difference " + course.unit, .series = {value}};
  values.horizontalLines = {{.at = course.limit, .label = "wanted: root mean square at most"}};
  values.verticalLines = {rex::grading::wrongFrom(moment)};
  return {.figures = {values, map}, .film = std::move(film), .view = rex::kFromAbove, .moment = moment};
}

inline rex::Series dotsOf(const std::string& label, double size, const rex::Color& color,
                          rex::Marker marker = rex::Marker::kDot) {
  return {.label = label, .style = rex::SeriesStyle::kPoints, .marker = marker, .size = size, .color = color};
}

/// With the numbers in rows `x` and `y` of each column.
inline rex::Series dotsAt(const Eigen::MatrixXd& columns, int x, int y, rex::Series dots) {
  for (Eigen::Index k = 0; k < columns.cols(); ++k) dots.add(columns(x, k), columns(y, k));
  return dots;
}

/// Pairs of noise, and the ellipse that 95 % of them should lie in.
inline rex::Figure pairsSeen(const std::string& title, const rex::Series& pairs, double noise,
                             const std::string& xLabel, const std::string& yLabel) {
  rex::Figure figure{
      .title = title, .xLabel = xLabel, .yLabel = yLabel, .equalAxes = true, .series = {pairs}};
  figure.ellipses = {{.label = "wanted: 95 % inside",
                      .covariance = noise * noise * Eigen::Matrix2d::Identity(),
                      .sigmas = 2.45,
                      .color = rex::grading::kWantedColor}};
  return figure;
}

/// Noise of x, y and heading, a particle in each column.
inline rex::grading::Evidence noiseSeen(const Eigen::MatrixXd& d, double noise) {
  const rex::Series look = dotsOf("got", .8, rex::grading::kGotColor);
  return {
      .figures = {pairsSeen("Noise of the particles", dotsAt(d, 0, 1, look), noise, "in x [m]", "in y [m]"),
                  pairsSeen("Noise of the particles", dotsAt(d, 0, 2, look), noise, "in x [m]",
                            "in the heading [rad]")}};
}

/// How far each particle is from where it would be without noise, and from where it was.
inline rex::grading::Evidence movesSeen(const Eigen::MatrixXd& before, const Eigen::MatrixXd& after,
                                        const Eigen::MatrixXd& still) {
  rex::Series way = dotsOf("got: distance from its pose before", .8, rex::grading::kGotColor),
              wanted = dotsOf("wanted, without noise", .5, rex::grading::kWantedColor),
              wrong =
                  dotsOf("without any motion or noise", 3, rex::grading::kWrongColor, rex::Marker::kCircle);
  for (Eigen::Index k = 0; k < before.cols(); ++k) {
    const double number = static_cast<double>(k), far = (after.col(k) - before.col(k)).norm();
    const bool isWrong = far == 0 || (after.col(k) - still.col(k)).isZero(1e-9);
    for (rex::Series* series : {&way, &wanted, isWrong ? &wrong : nullptr})
      if (series != nullptr) series->x.push_back(number);
    way.y.push_back(far);
    wanted.y.push_back((still.col(k) - before.col(k)).norm());
    if (isWrong) wrong.y.push_back(far);
  }
  return {.figures = {{.title = "How far the particles move",
                       .xLabel = "number of the particle",
                       .yLabel = "length of (x, y, heading) after - before",
                       .legend = rex::Legend::kOutside,
                       .series = {way, wanted, wrong}}}};
}

inline rex::grading::Evidence neighboursSeen(const Eigen::MatrixXd& d, double noise) {
  rex::Series pairs = dotsOf("got", .8, rex::grading::kGotColor);
  for (Eigen::Index k = 1; k < d.cols(); ++k) pairs.add(d(0, k - 1), d(0, k));
  return {.figures = {pairsSeen("Noise of neighbours", pairs, noise, "of a particle in x [m]",
                                "of the next particle in x [m]")}};
}

/// All numbers of the noise as a histogram beside the density that they should have.
inline rex::grading::Evidence densitySeen(const Eigen::MatrixXd& d, double noise) {
  rex::Histogram bars = normalized(rex::sampleHistogram({d.data(), d.data() + d.size()}, 40));
  bars.label = "got";
  rex::Series density = rex::grading::wantedCurve("wanted");
  for (double at = -4; at <= 4; at += .05)
    density.add(at * noise, std::exp(-at * at / 2) / (std::sqrt(2 * M_PI) * noise));
  return {.figures = {{.title = "Noise of the particles",
                       .xLabel = "noise of x, y [m] and heading [rad]",
                       .yLabel = "density",
                       .series = {density},
                       .histograms = {bars}}}};
}

/// The poses of a car before a step, and after it beside the wanted one, as arrows.
inline rex::grading::Evidence stepSeen(const Eigen::Vector3d& before, const Eigen::Vector3d& got,
                                       const Eigen::Vector3d& wanted) {
  rex::Figure figure = rex::planeFigure({.title = "A step of the car, from the dot"});
  const auto hand = [](const Eigen::Vector3d& pose, const rex::Series& look) {
    const Eigen::Vector2d ahead(std::cos(pose[2]), std::sin(pose[2]));
    return rex::through({pose.head<2>(), pose.head<2>() + .3 * ahead}, look);
  };
  figure.series = {rex::through(before, dotsOf("", 2, {.5f, .5f, .5f})),
                   hand(before, {.label = "before", .color = rex::Color{.5f, .5f, .5f}}),
                   rex::through(got, dotsOf("", 2, rex::grading::kGotColor)),
                   hand(got, rex::grading::gotCurve("got")),
                   rex::through(wanted, dotsOf("", 2, rex::grading::kWantedColor, rex::Marker::kCircle)),
                   hand(wanted, rex::grading::wantedCurve("wanted"))};
  return {.figures = {figure}};
}

/// Landmarks in the frame of the car, as a stacked vector; with `isPolar` from distances and bearings.
inline rex::grading::Evidence viewSeen(const Eigen::VectorXd& got, const Eigen::VectorXd& wanted,
                                       bool isPolar) {
  if (got.size() != wanted.size()) return {};
  const auto dots = [&](const Eigen::VectorXd& y, rex::Series look) {
    for (Eigen::Index i = 0; i + 1 < y.size(); i += 2)
      look.add(isPolar ? y[i] * std::cos(y[i + 1]) : y[i], isPolar ? y[i] * std::sin(y[i + 1]) : y[i + 1]);
    return look;
  };
  rex::Figure figure{
      .title = isPolar ? "Landmarks by their distances and bearings" : "Landmarks as the car sees them",
      .xLabel = "ahead [m]",
      .yLabel = "left [m]",
      .equalAxes = true,
      .legend = rex::Legend::kOutside,
      .series = {dots(got, dotsOf("got", 2, rex::grading::kGotColor)),
                 dots(wanted, dotsOf("wanted", 2, rex::grading::kWantedColor, rex::Marker::kCircle))}};
  figure.arrows = {
      {.label = "the car, at (0, 0)", .x = {0}, .y = {0}, .dx = {1}, .dy = {0}, .color = rex::kTruthColor}};
  return {.figures = {figure}};
}

/// A weight for each particle, beside the wanted ones.
inline rex::grading::Evidence weightsSeen(const std::string& title, const Eigen::VectorXd& got,
                                          const Eigen::VectorXd& wanted) {
  rex::Series due = dotsOf("wanted", 1.5, rex::grading::kWantedColor, rex::Marker::kCircle);
  rex::Series mine = dotsOf("got", 1.5, rex::grading::kGotColor);
  due.y.assign(wanted.begin(), wanted.end());
  mine.y.assign(got.begin(), got.end());
  return {
      .figures = {
          {.title = title, .xLabel = "number of the particle", .yLabel = "weight", .series = {mine, due}}}};
}

/// Particles after a step from four poses, and where copies of these should be.
inline rex::grading::Evidence heapsSeen(const Eigen::MatrixXd& got, const Eigen::MatrixXd& before,
                                        const Eigen::MatrixXd& wanted) {
  const auto dots = [](const Eigen::MatrixXd& states, const rex::Series& look) {
    return dotsAt(states, 0, 1, look);
  };
  return {.figures = {{.title = "The particles after filterStep",
                       .xLabel = "x [m]",
                       .yLabel = "y [m]",
                       .legend = rex::Legend::kOutside,
                       .series = {dots(before, dotsOf("before", 1.5, {.5f, .5f, .5f}, rex::Marker::kCross)),
                                  dots(got, dotsOf("got", 1.5, rex::grading::kGotColor)),
                                  dots(wanted, dotsOf("wanted around these", 2.5, rex::grading::kWantedColor,
                                                      rex::Marker::kCircle))}}}};
}

/// Particles after a step, and where the particles from before would be, without noise, by their weights: as
/// positions, or `withHeadings`.
inline rex::grading::Evidence cloudsSeen(const Eigen::VectorXd& weights, const Eigen::MatrixXd& due,
                                         const Eigen::MatrixXd& got, bool withHeadings) {
  const auto dots = [&](const Eigen::MatrixXd& states, rex::Series look) {
    look = dotsAt(states, 0, withHeadings ? 2 : 1, look);
    if (withHeadings)
      for (double& heading : look.y) heading = rex::wrapAngle(heading);
    return look;
  };
  rex::Series moved =
      dots(due, dotsOf("before, moved, with the weight as colour", 1.5, rex::grading::kWantedColor));
  moved.values.assign(weights.begin(), weights.end());
  return {.figures = {{.title = "The particles of filterStep",
                       .xLabel = "x [m]",
                       .yLabel = withHeadings ? "heading [rad]" : "y [m]",
                       .colorLabel = "weight before",
                       .colorRange = rex::AxisRange{0, std::max(weights.maxCoeff(), 1e-9)},
                       .legend = rex::Legend::kOutside,
                       .series = {moved, dots(got, dotsOf("got", 1.2, rex::grading::kGotColor,
                                                          rex::Marker::kCircle))}}}};
}

/// Rows: 1 if the first particle has children, -1 if not, and the noise of one of those.
inline rex::grading::Evidence drawsSeen(const Eigen::MatrixXd& pairs) {
  return {.figures = {{.title = "Noise and children in filterStep",
                       .xLabel = "1: the first particle has a child, -1: it has none",
                       .yLabel = "noise in x / dynamicsNoise",
                       .series = {dotsAt(pairs, 0, 1, dotsOf("got", 1, rex::grading::kGotColor))}}}};
}

/// A cloud with the mean pose that was returned, and the wanted one.
inline rex::grading::Evidence meanSeen(const Cloud& cloud, const Eigen::Vector3d& got,
                                       const Eigen::Vector3d& wanted) {
  rex::Figure figure = rex::planeFigure({.title = "The particles, and their mean"});
  rex::Arrows arrows{.label = "particles"};
  for (const auto& pose : cloud.states.colwise())
    arrows.add(pose.head<2>(), .3 * Eigen::Vector2d(std::cos(pose[2]), std::sin(pose[2])));
  const auto hand = [](const Eigen::Vector3d& pose, const rex::Series& look) {
    const Eigen::Vector2d ahead(std::cos(pose[2]), std::sin(pose[2]));
    return rex::through({pose.head<2>(), pose.head<2>() + ahead}, look);
  };
  figure.arrows = {arrows};
  figure.series = {hand(got, rex::grading::gotCurve("got: position and heading")),
                   hand(wanted, rex::grading::wantedCurve("wanted"))};
  return {.figures = {figure}};
}
