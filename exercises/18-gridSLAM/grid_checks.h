#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "grading/check.h"
#include "grading/evidence.h"
#include "interface.h"
#include "map_reference.h"

// Parts 1 and 2: grids.

using rex::grading::Check;
using rex::grading::Evidence;

inline constexpr double kTurn = 2 * 3.14159265358979323846;

// The values of a grid from above, between two limits.
inline rex::Figure gridFigure(const std::string& title, const Grid& grid, double low, double high,
                              const std::string& colorLabel) {
  const Eigen::Index width = grid.values.rows(), height = grid.values.cols();
  rex::Figure figure =
      rex::planeFigure({.title = title, .colorLabel = colorLabel, .colorRange = rex::AxisRange{low, high}});
  const Eigen::Vector2d end =
      grid.origin + grid.cell * Eigen::Vector2d(static_cast<double>(width), static_cast<double>(height));
  figure.heatMap = rex::HeatMap{.xRange = {grid.origin[0], end[0]},
                                .yRange = {grid.origin[1], end[1]},
                                .values = grid.values.transpose().cwiseMax(low).cwiseMin(high)};
  return figure;
}

// Two grids side by side. Marked in the first: the cell that differs most.
inline Evidence gridsOf(const Grid& shape, const Eigen::MatrixXd& got, const Eigen::MatrixXd& wanted,
                        const std::string& label, const std::vector<rex::Series>& on = {}) {
  if (got.rows() != wanted.rows() || got.cols() != wanted.cols() || !got.allFinite()) return {};
  const double low = wanted.minCoeff(), high = std::max(wanted.maxCoeff(), low + .1);
  Grid a = shape, b = shape;
  a.values = got;
  b.values = wanted;
  Evidence evidence{
      .figures = {gridFigure("got", a, low, high, label), gridFigure("wanted", b, low, high, label)}};
  Eigen::Index i = 0, j = 0;
  if ((got - wanted).cwiseAbs().maxCoeff(&i, &j) > 0) {
    const Eigen::Vector2d middle =
        shape.origin + shape.cell * Eigen::Vector2d(static_cast<double>(i) + .5, static_cast<double>(j) + .5);
    Grid difference = shape;
    difference.values = got - wanted;
    const double most = difference.values.cwiseAbs().maxCoeff();
    evidence.figures.push_back(gridFigure("got - wanted", difference, -most, most, label));
    for (const std::size_t k : {0u, 2u})
      evidence.figures[k].series.push_back(rex::grading::wrongPoint("differs most", middle[0], middle[1]));
  }
  for (rex::Figure& figure : evidence.figures)
    figure.series.insert(figure.series.end(), on.begin(), on.end());
  return evidence;
}

inline rex::Series raysOf(const Eigen::Vector3d& pose, const Scan& scan) {
  rex::Series series{.label = "rays", .color = rex::grading::kWantedColor};
  for (Eigen::Index k = 0; k < scan.ranges.size(); ++k) {
    const Eigen::Vector2d end = endOf(pose, scan, k);
    series.x.insert(series.x.end(), {pose[0], end[0], pose[0]});
    series.y.insert(series.y.end(), {pose[1], end[1], pose[1]});
  }
  return series;
}

inline void describe(Check& check, const Grid& grid, const Eigen::Vector3d& pose, const Scan& scan) {
  check.input("a grid, a pose and a scan", {{"origin", grid.origin},
                                            {"cell", grid.cell},
                                            {"values", grid.values},
                                            {"pose", pose},
                                            {"angles", scan.angles},
                                            {"ranges", scan.ranges},
                                            {"maxRange", scan.maxRange}});
}

inline Eigen::MatrixXd matrixOf(const std::vector<Eigen::Vector2i>& cells) {
  Eigen::MatrixXd matrix(2, static_cast<Eigen::Index>(cells.size()));
  for (std::size_t k = 0; k < cells.size(); ++k)
    matrix.col(static_cast<Eigen::Index>(k)) = cells[k].cast<double>();
  return matrix;
}

inline void findsCells(Check& check, Student& student, const Grid& grid, double beyond) {
  for (int k = 0; k < 4; ++k) {
    Eigen::Vector2d p = pointIn(grid, check.rng());
    if (k % 2 == 1)
      p -= beyond * grid.cell * Eigen::Vector2d(1 + check.rng().index(20), check.rng().index(20));
    check.input("a grid and a point", {{"origin", grid.origin}, {"cell", grid.cell}, {"p", p}});
    const Eigen::Vector2d share = (p - grid.origin) / grid.cell, wanted = share.array().floor();
    const auto cut = check.suspect("Is a negative number rounded towards zero? It has to be rounded down.",
                                   Eigen::Vector2d(share.cast<int>().cast<double>()));
    const auto near = check.suspect("Is the nearest corner taken? A cell begins at its lower left corner.",
                                    Eigen::Vector2d(share.array().round()));
    const auto at = check.suspect("Is the origin of the grid forgotten?",
                                  Eigen::Vector2d((p / grid.cell).array().floor()));
    const auto swapped =
        check.suspect("Are i and j swapped? The first number is along x.", Eigen::Vector2d(wanted.reverse()));
    check.near("cellAt", student.cellAt(grid, p).cast<double>(), wanted, 0);
  }
}

// A map of ones where the cells are.
inline Eigen::MatrixXd paintedOn(const Grid& grid, const std::vector<Eigen::Vector2i>& cells) {
  Eigen::MatrixXd painted = Eigen::MatrixXd::Zero(grid.values.rows(), grid.values.cols());
  for (const Eigen::Vector2i& cell : cells)
    if (cell.minCoeff() >= 0 && cell[0] < painted.rows() && cell[1] < painted.cols())
      painted(cell[0], cell[1]) = 1;
  return painted;
}

inline void followsSegment(Check& check, Student& student, const Grid& grid, const Eigen::Vector2d& from,
                           const Eigen::Vector2d& to) {
  check.input("a grid and a segment",
              {{"origin", grid.origin}, {"cell", grid.cell}, {"from", from}, {"to", to}});
  const std::vector<Eigen::Vector2i> all = student.cellsAlong(grid, from, to);
  std::vector<Eigen::Vector2i> wanted, optional, got;
  for (const Piece& piece : piecesOf(grid, from, to))
    (piece.length >= .01 ? wanted : optional).push_back(piece.cell);
  // A cell that is only just missed does no harm either.
  for (const double shift : {-.01, .01})
    for (const Eigen::Vector2d& aside : {Eigen::Vector2d(shift, 0), Eigen::Vector2d(0, shift)})
      for (const Piece& piece : piecesOf(grid, from + grid.cell * aside, to + grid.cell * aside))
        optional.push_back(piece.cell);
  const auto isIn = [](const std::vector<Eigen::Vector2i>& cells, const Eigen::Vector2i& cell) {
    return std::find(cells.begin(), cells.end(), cell) != cells.end();
  };
  for (const Eigen::Vector2i& cell : all)
    if (isIn(wanted, cell) || !isIn(optional, cell)) got.push_back(cell);
  bool jumps = false, backwards = got.size() > 1 && got.front() == wanted.back();
  for (std::size_t k = 0; k + 1 < got.size(); ++k)
    jumps = jumps || (got[k + 1] - got[k]).cwiseAbs().sum() == 2;
  const auto wrongWay = check.ask("Do the cells go from `to` to `from`?", backwards && wanted.size() > 1);
  const auto skips = check.ask(
      "Do cells follow each other diagonally? A segment from one to the other passes a third one.", jumps);
  const auto noEnd = check.ask("Is the cell of `to` missing?", !isIn(got, wanted.back()));
  const auto noStart = check.ask("Is the cell of `from` missing?", !isIn(got, wanted.front()));
  const auto shown = check.show([&] {
    const rex::Series segment{
        .label = "segment", .x = {from[0], to[0]}, .y = {from[1], to[1]}, .color = rex::grading::kWrongColor};
    return gridsOf(grid, paintedOn(grid, all), paintedOn(grid, wanted), "in the list", {segment});
  });
  check.near("cellsAlong", matrixOf(got), matrixOf(wanted), 0);
}

inline void updates(Check& check, Student& student, int rays, const CellEvidence& evidence) {
  Grid map = randomGrid(12, 10, check.rng());
  map.values = map.values.cwiseMax(-evidence.bound).cwiseMin(evidence.bound);
  const Eigen::Vector2d p = pointIn(map, check.rng());
  const Eigen::Vector3d pose(p[0], p[1], rounded(check.rng().uniform(-3, 3)));
  const Scan scan = randomScan(map, pose, rays, check.rng());
  describe(check, map, pose, scan);
  const Grid got = student.observed(map, pose, scan, evidence);
  const Eigen::MatrixXd wanted = mapAfter(map, pose, scan, evidence).values;
  check.shape("values of observed", got.values, 12, 10);
  const auto is = [&](const char* question, const Eigen::Vector3d& from, const Reading& reading) {
    return check.suspect(
        question, whereClear(mapAfter(map, from, scan, evidence, reading).values, map, pose, scan, evidence));
  };
  Scan mirrored = scan;
  mirrored.angles *= -1;
  const auto hits = is("Does a ray of maxRange end at a wall? It hit nothing.", pose, {.maxIsHit = true});
  const auto ignored = is("Are rays of maxRange left out? The cells before their ends are free.", pose,
                          {.maxIsIgnored = true});
  const auto each =
      is("Is something added for each ray? A cell is changed once by a scan.", pose, {.eachRayCounts = true});
  const auto last =
      is("Does a ray that passes undo what one that ends there has said?", pose, {.lastRayCounts = true});
  const auto unbounded = is("Are log odds not limited?", pose, {.isBounded = false});
  const auto forgets = is("Is the map before the scan forgotten?", pose, {.isAdded = false});
  const auto unturned = is("Is the heading of the robot forgotten?", {pose[0], pose[1], 0}, {});
  const auto turned = is("Is the heading of the robot subtracted?", {pose[0], pose[1], -pose[2]}, {});
  const auto mirror =
      check.suspect("Are angles of rays subtracted from the heading?",
                    whereClear(mapAfter(map, pose, mirrored, evidence).values, map, pose, scan, evidence));
  const auto nothing = check.suspect("Is the map never changed?", map.values);
  const Eigen::MatrixXd compared = whereClear(got.values, map, pose, scan, evidence);
  const auto shown =
      check.show([&] { return gridsOf(map, compared, wanted, "log odds", {raysOf(pose, scan)}); });
  check.near("values of observed", compared, wanted, 1e-9);
}

// Part 2.

inline void measuresDistances(Check& check, Student& student, int width, int height) {
  const Grid map = randomGrid(width, height, check.rng());
  const double reach = map.cell * (2.5 + .5 * check.rng().index(5));
  check.input("a map and a reach", {{"cell", map.cell}, {"values", map.values}, {"reach", reach}});
  const Grid got = student.wallDistances(map, reach);
  const Eigen::MatrixXd wanted = distancesTo(map, reach).values;
  check.shape("values of wallDistances", got.values, width, height);
  const auto by = [&](const char* question, const CellDistance& apart) {
    return check.suspect(question, distancesTo(map, reach, apart).values);
  };
  Grid single = map;
  single.cell = 1;
  const auto endless = check.suspect("Is `reach` forgotten?", distancesTo(map, 1e9).values);
  const auto cells =
      check.suspect("Are distances counted in cells?", distancesTo(single, reach / map.cell).values);
  const auto cellsAtMost =
      check.suspect("Are distances counted in cells?", distancesTo(single, reach).values);
  const auto blocks =
      by("Is the distance along x added to that along y?", [](double x, double y) { return x + y; });
  const auto king = by("Is it the larger of the distances along x and y?",
                       [](double x, double y) { return std::max(x, y); });
  const auto squares = by("Is the square root missing?", [](double x, double y) { return x * x + y * y; });
  const auto unknown =
      check.suspect("Do unknown cells count as walls? A cell is occupied if its log odds are above 0.",
                    distancesTo(
                        map, reach, [](double x, double y) { return std::sqrt(x * x + y * y); },
                        [](double odds) { return odds >= 0; })
                        .values);
  const auto free = check.suspect("Do free cells count as walls?",
                                  distancesTo(
                                      map, reach, [](double x, double y) { return std::sqrt(x * x + y * y); },
                                      [](double odds) { return odds < 0; })
                                      .values);
  const auto shown = check.show([&] { return gridsOf(map, got.values, wanted, "distance [m]"); });
  check.near("values of wallDistances", got.values, wanted, 1e-9, "m");
}

inline void interpolates(Check& check, Student& student, const Grid& grid) {
  for (int k = 0; k < 6; ++k) {
    Eigen::Vector2d p = pointIn(grid, check.rng());
    if (k == 4) p[0] = grid.origin[0] - grid.cell;
    if (k == 5) p[1] = grid.origin[1] + grid.cell * (static_cast<double>(grid.values.cols()) + 1.4);
    check.input("a grid and a point",
                {{"origin", grid.origin}, {"cell", grid.cell}, {"values", grid.values}, {"p", p}});
    const Eigen::Vector2d share = (p - grid.origin) / grid.cell;
    const double got = student.valueAt(grid, p), wanted = between(grid, p);
    const auto inside = [](double i, Eigen::Index size) {
      return std::clamp(static_cast<Eigen::Index>(std::floor(i)), Eigen::Index{0}, size - 1);
    };
    const auto one = [](double value) -> Eigen::MatrixXd { return Eigen::MatrixXd::Constant(1, 1, value); };
    const auto step = check.suspect(
        "Is it the value of the cell? Between the centres of cells it changes bilinearly.",
        one(grid.values(inside(share[0], grid.values.rows()), inside(share[1], grid.values.cols()))));
    const auto corner = check.suspect("Are values at the corners of cells? They are at their centres.",
                                      one(between(grid, p, 0)));
    check.near("valueAt", one(got), one(wanted), 1e-9);
  }
}

inline void rates(Check& check, Student& student, int rays) {
  const Grid map = randomGrid(14, 12, check.rng());
  const Grid distances = distancesTo(map, 3 * map.cell);
  const Eigen::Vector2d p = pointIn(map, check.rng());
  const Eigen::Vector3d pose(p[0], p[1], rounded(check.rng().uniform(-3, 3)));
  Scan scan = randomScan(map, pose, rays, check.rng());
  // A single end tells few mistakes apart.
  while ((scan.ranges.array() < scan.maxRange).count() < 2) scan = randomScan(map, pose, rays, check.rng());
  const double deviation = .05 * (1 + check.rng().index(6));
  describe(check, distances, pose, scan);
  const double got = student.fit(distances, pose, scan, deviation),
               wanted = fitOf(distances, pose, scan, deviation);
  const auto one = [](double value) -> Eigen::MatrixXd { return Eigen::MatrixXd::Constant(1, 1, value); };
  Scan all = scan, cut = scan, mirrored = scan, degrees = scan;
  degrees.angles *= kTurn / 360;
  all.maxRange = cut.maxRange = 10 * scan.maxRange;
  cut.ranges = cut.ranges.cwiseMin(scan.maxRange);
  mirrored.angles *= -1;
  double sum = 0, linear = 0;
  int hits = 0;
  for (Eigen::Index k = 0; k < scan.ranges.size(); ++k) {
    if (scan.ranges[k] >= scan.maxRange) continue;
    const double d = between(distances, endOf(pose, scan, k));
    sum += d * d;
    linear += d;
    ++hits;
  }
  const auto max = check.suspect("Do rays count that hit nothing? They end at no wall.",
                                 one(fitOf(distances, pose, all, deviation)));
  const auto maxCut = check.suspect("Do rays count that hit nothing? They end at no wall.",
                                    one(fitOf(distances, pose, cut, deviation)));
  const auto sign = check.suspect("Is it the more likely, the farther rays end from walls?", one(-wanted));
  const auto half = check.suspect("Is the factor 2 missing?", one(2 * wanted));
  const auto square = check.suspect("Is `deviation` not squared?", one(-sum / (2 * deviation)));
  const auto flat = check.suspect("Are distances not squared?", one(-linear / (2 * deviation * deviation)));
  const auto mean = check.suspect("Is it the mean over all rays? It is their sum.", one(wanted / hits));
  const auto meanOfAll = check.suspect("Is it the mean over all rays? It is their sum.", one(wanted / rays));
  const auto converted =
      check.suspect("Are angles converted from degrees? They are radians.",
                    one(fitOf(distances, {pose[0], pose[1], pose[2] * kTurn / 360}, degrees, deviation)));
  const auto unturned = check.suspect("Is the heading of the robot forgotten?",
                                      one(fitOf(distances, {pose[0], pose[1], 0}, scan, deviation)));
  const auto turned = check.suspect("Is the heading of the robot subtracted?",
                                    one(fitOf(distances, {pose[0], pose[1], -pose[2]}, scan, deviation)));
  const auto mirror = check.suspect("Are angles of rays subtracted from the heading?",
                                    one(fitOf(distances, pose, mirrored, deviation)));
  const auto shown = check.show([&] {
    rex::Figure figure = gridFigure("distances, and where rays end that hit something", distances, 0,
                                    3 * distances.cell, "distance [m]");
    rex::Series ends{.label = "ends of rays", .style = rex::SeriesStyle::kPoints};
    for (Eigen::Index k = 0; k < scan.ranges.size(); ++k) {
      if (scan.ranges[k] >= scan.maxRange) continue;
      ends.add(endOf(pose, scan, k)[0], endOf(pose, scan, k)[1]);
    }
    figure.series = {ends, rex::grading::wrongPoint("robot", pose[0], pose[1])};
    return Evidence{.figures = {figure}};
  });
  check.near("fit", one(got), one(wanted), 1e-9 * (1 + std::abs(wanted)));
}
