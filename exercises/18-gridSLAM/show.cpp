#include "show.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <string>

#include "buildings.h"
#include "course/car_pictures.h"
#include "course/car_view.h"
#include "estimation/occupancy_map.h"

using namespace rex;

namespace {

constexpr int kParticles = 12;

OccupancyMap drawable(const Grid& grid) {
  OccupancyMap map(static_cast<int>(grid.values.rows()), static_cast<int>(grid.values.cols()), grid.cell,
                   grid.origin);
  for (int i = 0; i < map.width(); ++i)
    for (int j = 0; j < map.height(); ++j) map.setLogOdds(i, j, grid.values(i, j));
  return map;
}

// Where the rays of a scan end that hit something.
Eigen::Matrix2Xd endsOf(const Eigen::Vector3d& pose, const Scan& scan) {
  Eigen::Matrix2Xd ends(2, scan.ranges.size());
  Eigen::Index count = 0;
  for (Eigen::Index k = 0; k < scan.ranges.size(); ++k) {
    if (scan.ranges[k] >= scan.maxRange) continue;
    const double angle = pose[2] + scan.angles[k];
    ends.col(count++) = pose.head<2>() + scan.ranges[k] * Eigen::Vector2d(std::cos(angle), std::sin(angle));
  }
  return ends.leftCols(count);
}

HeatMap heatMapFrom(const Grid& grid) {
  const Eigen::Vector2d end =
      grid.origin + grid.cell * Eigen::Vector2d(static_cast<double>(grid.values.rows()),
                                                static_cast<double>(grid.values.cols()));
  return {.xRange = {grid.origin[0], end[0]},
          .yRange = {grid.origin[1], end[1]},
          .values = grid.values.transpose()};
}

Figure seenFromAbove(const std::string& title) {
  return planeFigure({.title = title, .width = 700, .height = 600});
}

// The map that scans draw if these are the poses.
Grid mapAlong(const Office& office, const std::vector<Eigen::Vector3d>& path) {
  Grid map = office.empty;
  for (std::size_t t = 0; t < path.size(); ++t)
    map = observed(map, path[t], office.log.scans[t], CellEvidence{});
  return map;
}

bool drawsSomething(const Office& office) {
  return !observed(office.empty, office.path[0], office.log.scans[0], CellEvidence{}).values.isZero(0);
}

bool rateSomething(const Office& office) {
  const Grid distances = wallDistances(office.truth, Settings{}.reach);
  return fit(distances, office.path[0] + Eigen::Vector3d(.3, .3, 0), office.log.scans[0], .15) != 0;
}

void plotMap(const std::string& name, const std::string& title, const Office& office, const Grid& map,
             const std::vector<Eigen::Vector3d>& path, const std::string& label) {
  const double overlap = compareMaps(drawable(map), drawable(office.truth)).overlap;
  char text[200];
  std::snprintf(text, sizeof text, "%s: off by %.2f m, overlap of walls %.2f", title.c_str(),
                pathError(path, office.path), overlap);
  plot(name, carFigure({.map = drawable(map),
                        .paths = {{.name = "true path",
                                   .points = pathPoints(office.path),
                                   .color = Color{.85f, .1f, .1f},
                                   .dashed = true},
                                  {.name = label, .points = pathPoints(path), .color = kEstimateColor}},
                        .caption = text}));
}

Series curveOf(const std::string& label, const std::vector<double>& sizes) {
  Series series{.label = label, .y = sizes};
  for (std::size_t t = 0; t < sizes.size(); ++t) series.x.push_back(static_cast<double>(t + 1));
  return series;
}

// Step after step, as mapped() does it.
void filmMapping(const Office& office, const Settings& settings) {
  Rng rng(7);
  std::vector<Particle> particles(kParticles, Particle{{office.log.start}, office.empty, 0});
  for (Particle& particle : particles)
    particle.map = observed(office.empty, office.log.start, office.log.scans[0], settings.evidence);
  std::vector<CarView> views;
  for (std::size_t t = 0; t < office.log.motions.size(); ++t) {
    particles = slamStep(particles, office.log.motions[t], office.log.scans[t + 1], settings, rng);
    const Eigen::VectorXd weights = weightsOf(particles);
    Eigen::Index best = 0;
    weights.maxCoeff(&best);
    const Particle& first = particles[static_cast<std::size_t>(best)];
    CarView view{.car = office.path[t + 1],
                 .carScale = .2,
                 .map = drawable(first.map),
                 .weights = weights,
                 .scan = endsOf(first.path.back(), office.log.scans[t + 1]),
                 .caption = "step " + std::to_string(t + 1)};
    view.particles.resize(3, kParticles);
    for (int k = 0; k < kParticles; ++k) {
      const Particle& particle = particles[static_cast<std::size_t>(k)];
      view.particles.col(k) = particle.path.back();
      view.paths.push_back({.points = pathPoints(particle.path), .color = kEstimateColor, .width = 1});
    }
    if (t % 2 == 0) views.push_back(view);
    if (effectiveSize(weights) < settings.threshold * kParticles) particles = resampled(particles, rng);
  }
  writeFilm(carFilm(views, 2), "mapping", {.view = {0, -6, 12}, .speed = 16});
}

}  // namespace

Office officeOfShow() {
  Rng rng(3);
  const Building building = randomBuilding(rng);
  // Around the block once, and along its first side once more.
  const double a = 2.4, b = 9.6;
  const Tour tour =
      tourOf(building, posesAlong({{a, a}, {b, a}, {b, b}, {a, b}, {a, a}, {b, a}}, .4, .4), rng);
  return {emptyGrid(), gridOf(building), tour.truth, tour.log};
}

void showScan(const Office& office) {
  if (!drawsSomething(office)) return nothingYet("a scan");
  const Grid once = observed(office.empty, office.path[0], office.log.scans[0], CellEvidence{});
  plot("scan", carFigure({.car = office.path[0],
                          .carScale = .2,
                          .map = drawable(once),
                          .scan = endsOf(office.path[0], office.log.scans[0]),
                          .caption = "What one scan says: free, occupied, unknown"}));
  plotMap("known", "All poses known", office, mapAlong(office, office.path), office.path, "path");
}

void showFit(const Office& office) {
  if (!rateSomething(office)) return nothingYet("the fit");
  const Grid distances = wallDistances(office.truth, Settings{}.reach);
  const std::size_t t = 30;
  const Scan& scan = office.log.scans[t];
  const Eigen::Vector3d pose = office.path[t], off = pose + Eigen::Vector3d(.3, -.4, .1);
  Figure map = seenFromAbove("Distance from the nearest wall");
  map.colorLabel = "distance [m]";
  map.heatMap = heatMapFrom(distances);
  map.series = {dots(endsOf(pose, scan),
                     {.label = "a scan from its true pose", .size = .9, .color = Color{.9f, .1f, .1f}}),
                dots(endsOf(off, scan),
                     {.label = "from half a metre off", .size = .9, .color = Color{.95f, .5f, .75f}})};
  map.legend = Legend::kOutside;
  plot("distances", map);
  Grid around{pose.head<2>() - Eigen::Vector2d(.6, .6), .03, Eigen::MatrixXd(40, 40)};
  for (int i = 0; i < 40; ++i)
    for (int j = 0; j < 40; ++j)
      around.values(i, j) = fit(distances, pose + Eigen::Vector3d(.03 * (i - 19.5), .03 * (j - 19.5), 0),
                                scan, Settings{}.deviation);
  Figure hill = seenFromAbove("How well the scan fits, with the true heading");
  hill.colorLabel = "fit";
  hill.heatMap = heatMapFrom(around);
  hill.heatMap->contours = 12;
  hill.series = {dots(pose.head<2>(), {.label = "true pose", .size = 2, .color = kDeadReckoningColor})};
  plot("fit", hill);
}

void showMatches(const Office& office) {
  if (!rateSomething(office)) return nothingYet("matches");
  const Grid distances = wallDistances(office.truth, Settings{}.reach);
  const std::size_t t = 30;
  const Eigen::Vector3d pose = office.path[t];
  Figure figure = seenFromAbove("Guesses up to 0.25 m and 0.15 rad off, and their matches");
  figure.legend = Legend::kOutside;
  Rng rng(1);
  Eigen::Matrix2Xd from(2, 60), to(2, 60);
  for (int k = 0; k < 60; ++k) {
    const Eigen::Vector3d guess =
        pose + Eigen::Vector3d(rng.uniform(-.25, .25), rng.uniform(-.25, .25), rng.uniform(-.15, .15));
    from.col(k) = guess.head<2>();
    to.col(k) = matched(distances, office.log.scans[t], Settings{}.deviation, guess, {.3, .2}).head<2>();
    figure.series.push_back(
        {.x = {from(0, k), to(0, k)}, .y = {from(1, k), to(1, k)}, .color = Color{.8f, .8f, .8f}});
  }
  figure.series.push_back(dots(from, {.label = "guesses", .size = .6, .color = kDeadReckoningColor}));
  figure.series.push_back(dots(to, {.label = "matches", .size = .8, .color = kEstimateColor}));
  figure.series.push_back(dots(pose.head<2>(), {.label = "true pose", .size = 1.5, .color = kTruthColor}));
  plot("matches", figure);
}

void showMaps(const Office& office) {
  Rng rng(7);
  Settings settings;
  const Mapped slam = mapped(office.log, office.empty, settings, kParticles, rng);
  if (slam.effectiveSizes.empty() || slam.path.size() != office.path.size()) return nothingYet("maps");
  const std::vector<Eigen::Vector3d> odometry = reckoned(office.log);
  plotMap("odometry", "Odometry", office, mapAlong(office, odometry), odometry, "path");
  plotMap("slam", "12 particles", office, slam.map, slam.path, "path");
  settings.matches = false;
  Rng other(7);
  const Mapped unmatched = mapped(office.log, office.empty, settings, kParticles, other);
  plot("sizes", {.title = "Effective sizes of 12 particles",
                 .xLabel = "step",
                 .yLabel = "effective size",
                 .yRange = AxisRange{0, 13},
                 .legend = Legend::kOutside,
                 .series = {curveOf("with matches", slam.effectiveSizes),
                            curveOf("motion alone", unmatched.effectiveSizes)},
                 .horizontalLines = {{.at = settings.threshold * kParticles, .label = "threshold"}}});
  settings.matches = true;
  filmMapping(office, settings);
}

void showAnywhere(const Office& office) {
  if (!rateSomething(office)) return nothingYet("anywhere");
  const Scan& scan = office.log.scans[30];
  const Grid distances = wallDistances(office.truth, 2 * Settings{}.reach);
  Grid best = office.truth;
  double least = 0;
  for (Eigen::Index i = 0; i < best.values.rows(); ++i)
    for (Eigen::Index j = 0; j < best.values.cols(); ++j) {
      double& value = best.values(i, j);
      if (value > 0) continue;
      value = -std::numeric_limits<double>::infinity();
      for (int k = 0; k < 24; ++k)
        value = std::max(value, fit(distances,
                                    {best.cell * (static_cast<double>(i) + .5),
                                     best.cell * (static_cast<double>(j) + .5), .2618 * k},
                                    scan, .3));
      least = std::min(least, value);
    }
  best.values = (office.truth.values.array() > 0).select(least, best.values);
  const Eigen::Vector3d found = located(office.truth, scan, {});
  Figure figure = seenFromAbove("A scan from anywhere: how well it fits with its best heading");
  figure.colorLabel = "fit";
  figure.heatMap = heatMapFrom(best);
  figure.legend = Legend::kOutside;
  figure.series = {
      dots(endsOf(found, scan),
           {.label = "the scan, from located()", .size = .6, .color = kDeadReckoningColor}),
      dots(found.head<2>(), {.label = "located()", .size = 2, .color = kDeadReckoningColor}),
      dots(office.path[30].head<2>(), {.label = "true position", .size = 1.2, .color = kTruthColor})};
  plot("anywhere", figure);
}
