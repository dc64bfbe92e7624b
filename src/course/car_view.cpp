#include "course/car_view.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/error.h"
#include "base/require.h"
#include "course/car_view_internal.h"
#include "estimation/gaussian.h"
#include "render/figure.h"

namespace rex {

Eigen::Matrix2Xd pathPoints(const std::vector<Eigen::Vector3d>& poses) {
  Eigen::Matrix2Xd points(2, static_cast<Eigen::Index>(poses.size()));
  for (Eigen::Index i = 0; i < points.cols(); ++i)
    points.col(i) = poses[static_cast<std::size_t>(i)].head<2>();
  return points;
}

}  // namespace rex

namespace rex::internal {

std::vector<ParticleGroup> particleGroups(const CarView& view) {
  constexpr Eigen::Index kMost = 3000;
  constexpr int kGroups = 4;
  const Eigen::Index count = view.particles.cols(), shown = std::min(count, kMost);
  const double heaviest = view.weights.size() > 0 ? view.weights.maxCoeff() : 0;
  std::array<ParticleGroup, kGroups> groups;
  for (Eigen::Index k = 0; k < shown; ++k) {
    const Eigen::Index i = k * count / shown;
    const double share = heaviest > 0 ? view.weights[i] / heaviest : 1;
    const int group = std::clamp(static_cast<int>(std::ceil(share * kGroups)) - 1, 0, kGroups - 1);
    groups[static_cast<std::size_t>(group)].poses.emplace_back(view.particles.col(i));
  }
  std::vector<ParticleGroup> result;
  for (int g = 0; g < kGroups; ++g) {
    ParticleGroup& group = groups[static_cast<std::size_t>(g)];
    group.strength = (g + 1.0) / kGroups;
    if (!group.poses.empty()) result.push_back(std::move(group));
  }
  return result;
}

Eigen::Matrix2Xd outlineOf(const PlanarGaussian& belief, double sigmas) {
  constexpr int kSides = 72;
  const Eigen::Matrix2d root = covarianceRoot(belief.covariance);
  Eigen::Matrix2Xd corners(2, kSides + 1);
  for (int i = 0; i <= kSides; ++i) {
    const double angle = 2 * std::numbers::pi * (i % kSides) / kSides;
    corners.col(i) = belief.mean + sigmas * (root * Eigen::Vector2d(std::cos(angle), std::sin(angle)));
  }
  return corners;
}

Eigen::Vector2d placeAt(const Eigen::Vector3d& pose, double ahead, double left) {
  const double c = std::cos(pose[2]), s = std::sin(pose[2]);
  return {pose[0] + c * ahead - s * left, pose[1] + s * ahead + c * left};
}

}  // namespace rex::internal

namespace rex {
namespace {

constexpr double kFarthest = 1e9;  // metres, as in a Picture
constexpr double kWidest = 50;

void requireNumbers(const std::string& what, const VectorArg& numbers) {
  requireFinite(what, numbers);
  for (Eigen::Index i = 0; i < numbers.size(); ++i)
    if (std::abs(numbers[i]) > kFarthest)
      throw Error({.what = fmt::format("{}: number {}", what, i),
                   .found = fmt::format("{:g}", numbers[i]),
                   .wanted = fmt::format("at most {:g}", kFarthest)});
}

void requireColumns(const std::string& what, const MatrixArg& columns) {
  if (columns.size() == 0 || columns.cwiseAbs().maxCoeff<Eigen::PropagateNaN>() <= kFarthest) return;
  for (Eigen::Index i = 0; i < columns.cols(); ++i)
    requireNumbers(fmt::format("{} {}", what, i), columns.col(i));
}

void requireBeliefs(const char* what, const std::vector<PlanarGaussian>& beliefs) {
  for (std::size_t i = 0; i < beliefs.size(); ++i) {
    const std::string name = fmt::format("{} {}", what, i);
    requireNumbers(name, beliefs[i].mean);
    requireCovariance(name, beliefs[i].covariance, 2);
    requireNumbers(name + ", deviations", beliefs[i].covariance.diagonal().cwiseMax(0).cwiseSqrt());
  }
}

}  // namespace

void requireDrawable(const CarView& view) {
  if (view.car) requireNumbers("car", *view.car);
  if (view.estimate) requireNumbers("estimate of the car", *view.estimate);
  requireColumns("landmark", view.landmarks);
  requireColumns("particle", view.particles);
  requireColumns("sighting", view.sightings);
  requireColumns("dot of the scan", view.scan);
  for (const DrawnPath& path : view.paths) {
    requireColumns("path '" + path.name + "', point", path.points);
    if (!(path.width > 0 && path.width <= kWidest))
      throw Error({.what = "path '" + path.name + "', width",
                   .found = fmt::format("{:g}", path.width),
                   .wanted = fmt::format("more than 0, at most {:g} pixels", kWidest)});
  }
  if (view.weights.size() > 0) {
    requireSize("weights of particles", view.weights.size(), view.particles.cols());
    requireNotNegative("weights of particles", view.weights);
    requireNumbers("weights of particles", view.weights);
  }
  requireBeliefs("belief of a pose", view.poseBeliefs);
  requireBeliefs("belief of a landmark", view.landmarkBeliefs);
  requirePositive("sigmas", view.sigmas);
  requirePositive("scale of the car", view.carScale);
  if (view.sightings.cols() > 0 && !view.car && !view.estimate)
    throw Error({.what = "sightings", .found = "no car and no estimate", .wanted = "one that sees them"});
}

namespace {

void addDots(Figure& figure, const char* label, const Eigen::Matrix2Xd& points, const Color& color,
             Marker marker, double size) {
  if (points.cols() > 0)
    figure.series.push_back(dots(points, {.label = label, .marker = marker, .size = size, .color = color}));
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
    addDots(figure, g + 1 == groups.size() ? "particles" : "", pathPoints(groups[g].poses), color,
            Marker::kDot, 0.5);
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
  for (const auto& place : view.sightings.colwise()) arrows.add(from.head<2>(), place - from.head<2>());
  figure.arrows.push_back(std::move(arrows));
}

}  // namespace

Figure carFigure(const CarView& view) {
  requireDrawable(view);
  Figure figure =
      planeFigure({.title = view.caption, .legend = Legend::kOutside, .width = 900, .height = 600});
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
  if (view.car) figure.regions.push_back(carAt(*view.car, view.carScale, "now", kTruthColor));
  if (view.estimate)
    figure.regions.push_back(carAt(*view.estimate, view.carScale, "estimate now", kEstimateColor));
  addDots(figure, "scan", view.scan, kScanColor, Marker::kDot, 0.5);
  addParticles(figure, view);
  for (const DrawnPath& path : view.paths) {
    if (path.points.cols() == 0) continue;
    figure.series.push_back(through(path.points, {.label = path.name,
                                                  .size = path.width / DrawnPath().width,
                                                  .dashed = path.dashed,
                                                  .color = path.color}));
  }
  addDots(figure, "landmarks", view.landmarks, kLandmarkColor, Marker::kTriangle, 1.5);
  return figure;
}

}  // namespace rex

namespace rex::internal {
namespace {

constexpr double kWallHeight = 0.4, kFloorHeight = 0.02;  // metres

// Free cells are nearly white, unknown ones grey, occupied ones dark.
float brightnessOf(double probability) {
  constexpr double kFree = 0.98, kUnknown = 0.78, kOccupied = 0.24;
  return static_cast<float>(probability < 0.5 ? kFree + 2 * probability * (kUnknown - kFree)
                                              : kUnknown + (2 * probability - 1) * (kOccupied - kUnknown));
}

// The cells in a few shades, as rectangles: of one shade, as wide as they are in a row, over equal rows.
Solid floorOf(const OccupancyMap& map) {
  constexpr int kShades = 9;
  using Columns = std::pair<int, int>;  // [first, last)
  using Rows = std::pair<int, int>;
  std::vector<Eigen::Vector3f> positions;
  std::vector<TriangleMesh::Triangle> triangles;
  std::vector<TriangleMesh::Part> parts;
  const auto add = [&](const Columns& x, const Rows& y) {
    const auto first = static_cast<std::uint32_t>(positions.size());
    for (const auto& [i, j] :
         {std::pair{x.first, y.first}, {x.second, y.first}, {x.second, y.second}, {x.first, y.second}})
      positions.push_back((map.cellSize() * Eigen::Vector3d(i, j, 0)).cast<float>());
    triangles.insert(triangles.end(), {{first, first + 1, first + 2}, {first, first + 2, first + 3}});
  };
  std::array<std::vector<std::pair<Columns, Rows>>, kShades> done;
  std::array<std::map<Columns, Rows>, kShades> open;
  const auto shadeAt = [&](int x, int y) {
    return static_cast<std::size_t>(std::lround((kShades - 1) * map.probability(x, y)));
  };
  for (int y = 0; y < map.height(); ++y)
    for (int x = 0; x < map.width();) {
      const int first = x;
      const std::size_t shade = shadeAt(x, y);
      while (x < map.width() && shadeAt(x, y) == shade) ++x;
      const auto [above, isNew] = open[shade].try_emplace({first, x}, y, y + 1);
      if (isNew) continue;
      if (above->second.second < y) done[shade].push_back(*above), above->second.first = y;
      above->second.second = y + 1;
    }
  for (std::size_t shade = 0; shade < kShades; ++shade) {
    const std::size_t before = triangles.size();
    for (const auto& [columns, rows] : done[shade]) add(columns, rows);
    for (const auto& [columns, rows] : open[shade]) add(columns, rows);
    const float brightness = brightnessOf(static_cast<double>(shade) / (kShades - 1));
    if (triangles.size() > before)
      parts.push_back({.color = Eigen::Vector4f(brightness, brightness, brightness, 1),
                       .firstTriangle = static_cast<std::uint32_t>(before),
                       .triangleCount = static_cast<std::uint32_t>(triangles.size() - before)});
  }
  const std::vector<Eigen::Vector3f> normals(positions.size(), Eigen::Vector3f::UnitZ());
  return {{.type = ShapeType::kMesh, .mesh = TriangleMesh(positions, normals, triangles, std::move(parts))},
          translation(map.origin().x(), map.origin().y(), kFloorHeight),
          {1, 1, 1},
          "floor"};
}

// The sides and the top of a box from `low` to `high`.
void addBlock(const Eigen::Vector3f& low, const Eigen::Vector3f& high,
              std::vector<Eigen::Vector3f>& positions, std::vector<Eigen::Vector3f>& normals,
              std::vector<TriangleMesh::Triangle>& triangles) {
  for (int face = 0; face < 5; ++face) {
    const int axis = face / 2;
    const bool isHigh = face % 2 == 1 || axis == 2;
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    const auto first = static_cast<std::uint32_t>(positions.size());
    for (const auto& [a, b] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}}) {
      Eigen::Vector3f corner;
      corner[axis] = isHigh ? high[axis] : low[axis];
      corner[u] = a == 1 ? high[u] : low[u];
      corner[v] = b == 1 ? high[v] : low[v];
      positions.push_back(corner);
      normals.push_back((isHigh ? 1 : -1) * Eigen::Vector3f::Unit(axis));
    }
    if (isHigh)
      triangles.insert(triangles.end(), {{first, first + 1, first + 2}, {first, first + 2, first + 3}});
    else
      triangles.insert(triangles.end(), {{first, first + 2, first + 1}, {first, first + 3, first + 2}});
  }
}

}  // namespace

Eigen::Matrix2d cornersOf(const OccupancyMap& map) {
  Eigen::Matrix2d corners;
  corners << map.origin(), map.origin() + map.cellSize() * Eigen::Vector2d(map.width(), map.height());
  return corners;
}

Eigen::MatrixXd probabilitiesOf(const OccupancyMap& map) {
  Eigen::MatrixXd probabilities(map.height(), map.width());
  for (int y = 0; y < map.height(); ++y)
    for (int x = 0; x < map.width(); ++x) probabilities(y, x) = map.probability(x, y);
  return probabilities;
}

std::vector<Solid> wallSolids(const OccupancyMap& map) {
  std::vector<Eigen::Vector3f> positions, normals;
  std::vector<TriangleMesh::Triangle> triangles;
  const auto corner = [&](int x, int y, double z) {
    const Eigen::Vector2d at = map.origin() + map.cellSize() * Eigen::Vector2d(x, y);
    return Eigen::Vector3d(at.x(), at.y(), z).cast<float>().eval();
  };
  for (int y = 0; y < map.height(); ++y)
    for (int x = 0; x < map.width(); ++x) {
      const int first = x;  // neighbours in a row make one block
      while (map.isOccupied(x, y)) ++x;
      if (x > first)
        addBlock(corner(first, y, 0), corner(x, y + 1, kWallHeight), positions, normals, triangles);
    }
  std::vector<Solid> solids{floorOf(map)};
  if (!triangles.empty())
    solids.push_back({{.type = ShapeType::kMesh, .mesh = TriangleMesh(positions, normals, triangles)},
                      {},
                      {0.36f, 0.38f, 0.43f},
                      "walls"});
  return solids;
}

}  // namespace rex::internal
