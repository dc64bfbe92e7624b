#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "drawing.h"
#include "exercise.h"
#include "grading/check.h"
#include "grading/evidence_parts.h"
#include "interface.h"
#include "maps.h"
#include "planning/bug.h"
#include "planning/grid_search.h"

// The checks of parts 1, 2 and 5: maps, and what is known about ways on them.

inline rex::GridMap gridMapOf(const CellMap& map) {
  rex::GridMap grid(map.width, map.height);
  for (std::size_t place = 0; place < map.blocked.size(); ++place) {
    const MapCell cell = map.cellAt(place);
    grid.setBlocked({cell.x, cell.y}, map.blocked[place] != 0);
  }
  return grid;
}

inline std::vector<double> distancesOn(const CellMap& map, MapCell from, rex::Connectivity connectivity) {
  return rex::gridDistances(gridMapOf(map), {from.x, from.y}, connectivity);
}

inline MapCell randomFreeCell(const CellMap& map, rex::Rng& rng) {
  while (true) {
    const MapCell cell{rng.index(map.width), rng.index(map.height)};
    if (map.isFree(cell)) return cell;
  }
}

inline void block(CellMap& map, MapCell cell) {
  if (map.isFree(cell)) map.blocked[map.placeOf(cell)] = 1;
}

// Walls that turn corners, and single cells; some walls lean on the border.
inline CellMap randomMap(rex::Rng& rng, int width, int height) {
  CellMap map = mapOf(std::vector<std::string>(static_cast<std::size_t>(height),
                                               std::string(static_cast<std::size_t>(width), '.')));
  for (int wall = 0; wall < 4; ++wall) {
    MapCell cell{rng.index(width), rng.index(height)};
    for (int piece = 0; piece < 4; ++piece) {
      const int step = rng.index(2) == 0 ? 1 : -1;
      for (int length = 3 + rng.index(6); length > 0; --length) {
        block(map, cell);
        (piece % 2 == 0 ? cell.x : cell.y) += step;
      }
    }
  }
  for (int i = 0; i < width * height / 30; ++i) block(map, {rng.index(width), rng.index(height)});
  return map;
}

// A closed wall around a rectangle of cells with that middle.
inline void enclose(CellMap& map, MapCell middle, int reach) {
  for (int i = -reach; i <= reach; ++i)
    for (const int side : {-reach, reach}) {
      block(map, {middle.x + i, middle.y + side});
      block(map, {middle.x + side, middle.y + i});
    }
}

// The number of sides that an obstacle shares with free cells, stored at each of its cells. Obstacles that
// touch at a corner are one, and all that touch the border are one with it. A frame is added around the
// map.
class Obstacles {
 public:
  explicit Obstacles(const CellMap& map) : map_(map) {
    const auto cells = static_cast<std::size_t>((map.width + 2) * (map.height + 2));
    obstacleOf_.assign(cells, -1);
    for (int y = -1; y <= map.height; ++y)
      for (int x = -1; x <= map.width; ++x)
        if (!map.isFree({x, y}) && obstacleAt({x, y}) < 0) collect({x, y});
  }

  int sidesAt(MapCell cell) const { return sides_[static_cast<std::size_t>(obstacleOf_[placeOf(cell)])]; }

 private:
  bool isInFrame(MapCell cell) const {
    return -1 <= cell.x && cell.x <= map_.width && -1 <= cell.y && cell.y <= map_.height;
  }
  std::size_t placeOf(MapCell cell) const {
    return static_cast<std::size_t>((cell.y + 1) * (map_.width + 2) + cell.x + 1);
  }
  int obstacleAt(MapCell cell) const { return obstacleOf_[placeOf(cell)]; }

  void collect(MapCell first) {
    int sides = 0;
    std::vector<MapCell> open{first};
    obstacleOf_[placeOf(first)] = static_cast<int>(sides_.size());
    while (!open.empty()) {
      const MapCell at = open.back();
      open.pop_back();
      for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx) {
          const MapCell next{at.x + dx, at.y + dy};
          if (map_.isFree(next)) sides += dx == 0 || dy == 0 ? 1 : 0;
          if (!isInFrame(next) || map_.isFree(next) || obstacleAt(next) >= 0) continue;
          obstacleOf_[placeOf(next)] = static_cast<int>(sides_.size());
          open.push_back(next);
        }
    }
    sides_.push_back(sides);
  }

  const CellMap& map_;
  std::vector<int> obstacleOf_, sides_;
};

// Lumelsky and Stepanov's bound, in cells: the m-line and, for each time that it enters an obstacle, one
// circuit around that. Half the crossings with the border of an obstacle enter it: this is D + sum n p / 2.
// A circuit along p sides of cells takes p + 4 steps: two at a convex corner, none at a concave one, and
// there are four more convex ones.
inline double bugBound(const CellMap& map, const std::vector<MapCell>& line) {
  const Obstacles obstacles(map);
  double bound = static_cast<double>(line.size()) - 1;
  for (std::size_t i = 1; i < line.size(); ++i)
    if (map.isFree(line[i - 1]) && !map.isFree(line[i])) bound += obstacles.sidesAt(line[i]) + 4;
  return bound;
}

// The network that cellNetwork() asks for.
inline Network networkOf(const CellMap& map) {
  Network network(map.blocked.size());
  for (std::size_t place = 0; place < network.size(); ++place) {
    const MapCell at = map.cellAt(place);
    for (int i = 0; i < 9; ++i) {
      const MapCell next{at.x + i % 3 - 1, at.y + i / 3 - 1};
      const bool hasRoom = map.isFree({next.x, at.y}) && map.isFree({at.x, next.y});
      if (i == 4 || !map.isFree(at) || !map.isFree(next) || !hasRoom) continue;
      network[place].push_back({map.placeOf(next), std::hypot(next.x - at.x, next.y - at.y)});
    }
  }
  return network;
}

inline bool touchesObstacle(const CellMap& map, MapCell cell) {
  for (int y = cell.y - 1; y <= cell.y + 1; ++y)
    for (int x = cell.x - 1; x <= cell.x + 1; ++x)
      if (!map.isFree({x, y})) return true;
  return false;
}

// In double precision, since answers may be any integers.
inline double columnsBetween(MapCell a, MapCell b) { return std::abs(1. * a.x - b.x); }
inline double rowsBetween(MapCell a, MapCell b) { return std::abs(1. * a.y - b.y); }
inline bool isBeside(MapCell a, MapCell b) { return columnsBetween(a, b) + rowsBetween(a, b) == 1; }
inline bool touches(MapCell a, MapCell b) { return columnsBetween(a, b) <= 1 && rowsBetween(a, b) <= 1; }

// A style for points in figures.
inline rex::Series dots(const std::string& label, const rex::Color& color, double size,
                        rex::Marker marker = rex::Marker::kDot) {
  return {.label = label, .style = rex::SeriesStyle::kPoints, .marker = marker, .size = size, .color = color};
}

// The way of a bug beside that of the library's bug, up to where it went wrong if that is known.
inline rex::grading::Evidence bugSeen(const CellMap& map, const std::vector<MapCell>& line,
                                      const std::vector<MapCell>& trail, const std::vector<MapCell>& asked) {
  rex::Figure figure = planOf("The way of the bug", map);
  std::vector<MapCell> wanted;
  for (const rex::GridCell cell :
       rex::bug2(gridMapOf(map), {line.front().x, line.front().y}, {line.back().x, line.back().y}).cells)
    wanted.push_back({cell.x, cell.y});
  addLine(figure, centersOf(line), {.label = "m-line", .size = 1, .color = kGray});
  if (trail.empty()) addLine(figure, centersOf(asked), dots("cells asked for", kGray, .8));
  addLine(figure, centersOf(trail), rex::grading::gotCurve("got"));
  addLine(figure, centersOf(wanted), rex::grading::wantedCurve("wanted, or as long"));
  addEnds(figure, centerOf(line.front()), centerOf(line.back()));
  std::string label = "blocked, a leap, or astray";
  for (std::size_t i = 0; i < trail.size(); ++i) {
    const bool isOnLine = std::find(line.begin(), line.end(), trail[i]) != line.end();
    const bool isWrong = !map.isFree(trail[i]) || (i > 0 && !isBeside(trail[i], trail[i - 1])) ||
                         (!isOnLine && !touchesObstacle(map, trail[i]));
    if (!isWrong) continue;
    const Eigen::Vector2d at = centerOf(trail[i]);
    figure.series.push_back(rex::grading::wrongPoint(std::exchange(label, ""), at.x(), at.y()));
  }
  return {.figures = {figure}};
}

// A bug that runs in circles is stopped by the limit on its questions: a correct one needs at most four
// answers per step, and gets forty.
inline void bugObeys(rex::grading::Check& check, Student& student, const CellMap& map, MapCell start,
                     MapCell goal) {
  const std::vector<MapCell> line = straightCells(start, goal);
  const double bound = bugBound(map, line);
  std::vector<MapCell> asked;
  BugTrail trail;
  const auto shown = check.show([&] { return bugSeen(map, line, trail.cells, asked); });
  trail = student.bugTwo(line, [&](MapCell cell) {
    check.that("isFree is asked only about cells that touch the trail",
               -1 <= cell.x && cell.x <= map.width && -1 <= cell.y && cell.y <= map.height);
    asked.push_back(cell);
    check.atMost("number of calls of isFree", static_cast<double>(asked.size()), 40 * (bound + 10));
    return map.isFree(cell);
  });
  const std::vector<MapCell>& cells = trail.cells;
  check.that("the trail begins at the start", !cells.empty() && cells.front() == start);
  for (std::size_t i = 0; i < cells.size(); ++i) {
    check.that("each cell of the trail is free", map.isFree(cells[i]));
    if (i > 0)
      check.that("each cell of the trail is beside the one before", isBeside(cells[i], cells[i - 1]));
    check.that("the bug leaves the m-line only along obstacles",
               std::find(line.begin(), line.end(), cells[i]) != line.end() || touchesObstacle(map, cells[i]));
  }
  const bool isReachable =
      std::isfinite(distancesOn(map, start, rex::Connectivity::kFour)[map.placeOf(goal)]);
  if (isReachable) {
    check.that("the goal can be reached, and is", trail.reached && cells.back() == goal);
  } else {
    check.that("the goal cannot be reached, and the bug says so", !trail.reached);
  }
  check.atMost("steps", static_cast<double>(cells.size()) - 1, bound);
  for (const MapCell cell : asked)
    check.that("isFree is asked only about cells that touch the trail",
               std::any_of(cells.begin(), cells.end(), [&](MapCell at) { return touches(at, cell); }));
}

// Points in a square of 1 m, joined if they are near each other; some may be isolated.
struct RandomNetwork {
  std::vector<Eigen::Vector2d> places;
  Network network;
};

// Arcs are longer than the straight line, by up to `detour`.
inline RandomNetwork randomNetwork(rex::Rng& rng, int nodes, double reach, double detour) {
  RandomNetwork made;
  for (int i = 0; i < nodes; ++i) made.places.emplace_back(rng.uniformVector(2, 0, 1));
  made.network.resize(made.places.size());
  for (std::size_t i = 0; i < made.places.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const double straight = (made.places[i] - made.places[j]).norm();
      if (straight > reach) continue;
      const double length = straight * rng.uniform(1, 1 + detour);
      made.network[i].push_back({j, length});
      made.network[j].push_back({i, length});
    }
  return made;
}

// Bellman-Ford: as simple as it is slow.
inline std::vector<double> slowDistances(const Network& network, std::size_t from) {
  std::vector<double> distances(network.size(), std::numeric_limits<double>::infinity());
  distances.at(from) = 0;
  for (bool isChanging = true; isChanging;) {
    isChanging = false;
    for (std::size_t node = 0; node < network.size(); ++node)
      for (const Arc& arc : network[node])
        if (distances[node] + arc.length < distances[arc.to] - 1e-12) {
          distances[arc.to] = distances[node] + arc.length;
          isChanging = true;
        }
  }
  return distances;
}

inline void distancesAgree(rex::grading::Check& check, const std::vector<double>& got,
                           const std::vector<double>& wanted) {
  check.that("there is a distance for each node", got.size() == wanted.size());
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    if (std::isfinite(wanted[i]))
      check.near("distance", got[i], wanted[i], 1e-9, "m");
    else
      check.that("the distance is infinite if no way leads there", got[i] == wanted[i]);
  }
}

// Checks that this is a way of that length along arcs between two nodes, or empty if the length is
// infinite.
inline void isWay(rex::grading::Check& check, const Network& network, const std::vector<std::size_t>& way,
                  std::size_t from, std::size_t to, double length) {
  if (!std::isfinite(length)) return check.that("the way is empty if there is none", way.empty());
  check.that("the way begins and ends where it should",
             !way.empty() && way.front() == from && way.back() == to);
  double sum = 0;
  for (std::size_t i = 1; i < way.size(); ++i) {
    const std::vector<Arc>& arcs = network[way[i - 1]];
    const auto arc = std::find_if(arcs.begin(), arcs.end(), [&](const Arc& a) { return a.to == way[i]; });
    check.that("each step of the way is an arc", arc != arcs.end());
    sum += arc->length;
  }
  check.near("length of the way", sum, length, 1e-9, "m");
}
