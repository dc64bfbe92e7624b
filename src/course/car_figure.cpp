#include "course/car_figure.h"

#include <algorithm>

#include <fmt/format.h>

#include "course/car_marks_internal.h"
#include "estimation/covariance.h"
#include "render/figure.h"

namespace rex {
namespace {

Series seriesOf(const std::string& label, const Eigen::Matrix2Xd& points, const Color& color,
                SeriesStyle style = SeriesStyle::kLine) {
  Series series{.label = label, .style = style, .color = color};
  for (const auto& point : points.colwise()) series.add(point.x(), point.y());
  return series;
}

void addDots(Figure& figure, const char* label, const Eigen::Matrix2Xd& points, const Color& color,
             Marker marker, double size) {
  if (points.cols() == 0) return;
  Series series = seriesOf(label, points, color, SeriesStyle::kPoints);
  series.marker = marker;
  series.size = size;
  figure.series.push_back(std::move(series));
}

void addParticles(Figure& figure, const CarView& view) {
  const auto paled = [](float part, double strength) {
    return static_cast<float>(1 - strength * (1.0 - part));
  };
  const auto groups = internal::particleGroups(view);
  for (std::size_t g = 0; g < groups.size(); ++g) {
    const double strength = groups[g].strength;
    const Color color{paled(kEstimateColor.r, strength), paled(kEstimateColor.g, strength),
                      paled(kEstimateColor.b, strength)};
    Eigen::Matrix2Xd points(2, static_cast<Eigen::Index>(groups[g].poses.size()));
    for (Eigen::Index i = 0; i < points.cols(); ++i)
      points.col(i) = groups[g].poses[static_cast<std::size_t>(i)].head<2>();
    addDots(figure, g + 1 == groups.size() ? "particles" : "", points, color, Marker::kDot, 0.5);
  }
}

void addBeliefs(Figure& figure, const std::vector<PlanarGaussian>& beliefs, const char* name, double sigmas,
                const Color& color) {
  // A figure draws no ellipse without area: one too small to be seen is added.
  constexpr double kShare = 1e-8, kLeast = 1e-12;
  for (std::size_t i = 0; i < beliefs.size(); ++i) {
    Eigen::Matrix2d covariance = symmetrized(beliefs[i].covariance);
    covariance.diagonal().array() += kShare * covariance.trace() + kLeast;
    figure.ellipses.push_back({.label = i == 0 ? fmt::format("{}, {:g} sigma", name, sigmas) : "",
                               .mean = beliefs[i].mean,
                               .covariance = covariance,
                               .sigmas = sigmas,
                               .color = color});
  }
}

// Seen from above, with a pointed front.
Region carAt(const Eigen::Vector3d& pose, double scale, const char* label, const Color& color) {
  using internal::kCarLength, internal::kCarMiddle, internal::kCarWidth;
  constexpr double kBack = kCarMiddle - kCarLength / 2, kFront = kCarMiddle + kCarLength / 2;
  Region car{.label = label, .color = color};
  for (const auto& [ahead, left] : {std::pair{kBack, -kCarWidth / 2},
                                    {kFront - 0.8, -kCarWidth / 2},
                                    {kFront, 0.},
                                    {kFront - 0.8, kCarWidth / 2},
                                    {kBack, kCarWidth / 2}}) {
    const Eigen::Vector2d corner = internal::placeAt(pose, scale * ahead, scale * left);
    car.add(corner.x(), corner.y());
  }
  return car;
}

void addSightings(Figure& figure, const CarView& view) {
  if (view.sightings.cols() == 0) return;
  const Eigen::Vector3d& from = view.car ? *view.car : *view.estimate;
  Arrows arrows{.label = "seen now"};
  for (const auto& place : view.sightings.colwise()) {
    arrows.x.push_back(from.x());
    arrows.y.push_back(from.y());
    arrows.dx.push_back(place.x() - from.x());
    arrows.dy.push_back(place.y() - from.y());
  }
  figure.arrows.push_back(std::move(arrows));
}

}  // namespace

Figure figureOf(const CarView& view) {
  requireDrawable(view);
  Figure figure{.title = view.caption,
                .xLabel = "x [m]",
                .yLabel = "y [m]",
                .equalAxes = true,
                .legend = Legend::kOutside,
                .width = 900,
                .height = 600};
  std::ranges::replace(figure.title, '\n', ' ');
  if (view.map) {
    const Eigen::Matrix2d corners = internal::cornersOf(*view.map);
    figure.map = OccupancyCells{.xRange = {corners(0, 0), corners(0, 1)},
                                .yRange = {corners(1, 0), corners(1, 1)},
                                .occupancy = internal::probabilitiesOf(*view.map)};
  }
  addBeliefs(figure, view.landmarkBeliefs, "landmarks", view.sigmas, kLandmarkColor);
  addBeliefs(figure, view.poseBeliefs, "poses", view.sigmas, kEstimateColor);
  addSightings(figure, view);
  if (view.car) figure.regions.push_back(carAt(*view.car, view.carScale, "car now", kTruthColor));
  if (view.estimate)
    figure.regions.push_back(carAt(*view.estimate, view.carScale, "estimate now", kEstimateColor));
  addDots(figure, "scan", view.scan, kScanColor, Marker::kDot, 0.5);
  addParticles(figure, view);
  for (const Way& way : view.ways) {
    if (way.points.cols() == 0) continue;
    figure.series.push_back(seriesOf(way.name, way.points, way.color));
    figure.series.back().dashed = way.dashed;
    figure.series.back().size = way.width / Way().width;
  }
  addDots(figure, "landmarks", view.landmarks, kLandmarkColor, Marker::kTriangle, 1.5);
  return figure;
}

}  // namespace rex
