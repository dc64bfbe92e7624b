#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "drawing.h"
#include "exercise.h"
#include "grading/check.h"
#include "grading/evidence.h"
#include "interface.h"
#include "maps.h"
#include "planning/grid_map.h"

// The checks of parts 2 and 5: maps and networks, and what is known about ways on them.

/// Requires it; if it does not hold, the input also says where.
inline void holdsWhere(rex::grading::Check& check, std::string_view property, bool holds,
                       const std::string& where) {
  if (!holds) check.input(check.input() + ", " + where);
  check.that(property, holds);
}

inline std::string nameOf(MapCell cell) { return fmt::format("({}, {})", cell.x, cell.y); }

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

// While `here` is the node whose distance is being checked, dijkstra() agrees with what is wanted.
inline void distancesAgree(rex::grading::Check& check, const Network& network, const std::vector<double>& got,
                           const std::vector<double>& wanted, std::size_t from, std::size_t& here) {
  check.near("number of distances of dijkstra", static_cast<double>(got.size()),
             static_cast<double>(wanted.size()), 0);
  Network counting = network;
  for (std::vector<Arc>& arcs : counting)
    for (Arc& arc : arcs) arc.length = 1;
  const std::vector<double> counts = slowDistances(counting, from);
  const std::string input = check.input();
  for (here = 0; here < wanted.size(); ++here) {
    check.input(fmt::format("{}, from node {} to node {}", input, from, here));
    const auto isCount = check.ask("Are arcs counted instead of adding up their lengths?",
                                   got[here] != wanted[here] && got[here] == counts[here]);
    if (std::isfinite(wanted[here]))
      check.near("distance of dijkstra to a node", got[here], wanted[here], 1e-9, "m");
    else
      check.that("the distance of dijkstra is infinite if no way leads to the node",
                 got[here] == wanted[here]);
  }
}

// Checks that a function returned a way of that length along arcs between two nodes, or nothing if the
// length is infinite.
inline void isWay(rex::grading::Check& check, const std::string& function, const Network& network,
                  const std::vector<std::size_t>& way, std::size_t from, std::size_t to, double length) {
  if (!std::isfinite(length))
    return check.that("the way of " + function + " is empty if there is none", way.empty());
  check.atLeast("number of nodes in the way of " + function, static_cast<double>(way.size()), 1);
  check.near("first node in the way of " + function, static_cast<double>(way.front()),
             static_cast<double>(from), 0);
  check.near("last node in the way of " + function, static_cast<double>(way.back()), static_cast<double>(to),
             0);
  double sum = 0;
  for (std::size_t i = 1; i < way.size(); ++i) {
    const std::vector<Arc>& arcs = network[way[i - 1]];
    const auto arc = std::find_if(arcs.begin(), arcs.end(), [&](const Arc& a) { return a.to == way[i]; });
    holdsWhere(check, "each step in the way of " + function + " is an arc", arc != arcs.end(),
               fmt::format("from node {} to node {}", way[i - 1], way[i]));
    sum += arc->length;
  }
  check.near("length of the way of " + function, sum, length, 1e-9, "m");
}
