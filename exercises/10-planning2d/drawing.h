#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "exercise.h"

// Maps and yards as figures, and a map as a scene: for show.cpp and the checks.

inline const rex::Color kWall{0.35f, 0.37f, 0.42f}, kGray{0.6f, 0.6f, 0.6f}, kRed{0.84f, 0.37f, 0},
    kBlack{0, 0, 0};

inline rex::Region rectangle(const Eigen::Vector2d& lower, const Eigen::Vector2d& upper) {
  return {.x = {lower.x(), upper.x(), upper.x(), lower.x()},
          .y = {lower.y(), lower.y(), upper.y(), upper.y()},
          .color = kWall};
}

// Walls of a map as few rectangles: runs of blocked cells side by side.
inline std::vector<Block> wallsOf(const CellMap& map) {
  std::vector<Block> walls;
  for (int y = 0; y < map.height; ++y)
    for (int x = 0, first = 0; x < map.width; first = ++x) {
      while (x < map.width && !map.isFree({x, y})) ++x;
      if (x > first) walls.push_back({Eigen::Vector2d(first, y), Eigen::Vector2d(x, y + 1)});
    }
  return walls;
}

inline std::vector<rex::Region> drawn(const std::vector<Block>& blocks) {
  std::vector<rex::Region> regions;
  for (const Block& block : blocks) regions.push_back(rectangle(block.lower, block.upper));
  return regions;
}

inline rex::Figure planOf(const std::string& title, const Eigen::Vector2d& size,
                          const std::vector<Block>& blocks) {
  return rex::planeFigure({.title = title,
                           .xRange = rex::AxisRange{0, size.x()},
                           .yRange = rex::AxisRange{0, size.y()},
                           .legend = rex::Legend::kOutside,
                           .regions = drawn(blocks)});
}

inline rex::Figure planOf(const std::string& title, const CellMap& map) {
  return planOf(title, Eigen::Vector2d(map.width, map.height), wallsOf(map));
}

inline Eigen::Vector2d centerOf(MapCell cell) { return {cell.x + 0.5, cell.y + 0.5}; }

// Adds a line, or what there is of it.
inline void addLine(rex::Figure& figure, const std::vector<Eigen::Vector2d>& points,
                    const rex::Series& look) {
  if (!points.empty()) figure.series.push_back(rex::through(points, look));
}

inline std::vector<Eigen::Vector2d> centersOf(const std::vector<MapCell>& cells) {
  std::vector<Eigen::Vector2d> centers;
  for (const MapCell cell : cells) centers.push_back(centerOf(cell));
  return centers;
}

inline std::vector<Eigen::Vector2d> centersOf(const CellMap& map, const std::vector<std::size_t>& places) {
  std::vector<Eigen::Vector2d> centers;
  for (const std::size_t place : places) centers.push_back(centerOf(map.cellAt(place)));
  return centers;
}

// The numbers of all cells as colours, as far as they are finite and not below `least`.
inline void addNumbers(rex::Figure& figure, const CellMap& map, const std::string& label,
                       const std::vector<double>& numbers, double least) {
  rex::Series cells{.style = rex::SeriesStyle::kPoints, .marker = rex::Marker::kSquare, .size = 3.1};
  for (std::size_t place = 0; place < numbers.size(); ++place) {
    const Eigen::Vector2d center = centerOf(map.cellAt(place));
    if (!map.isFree(map.cellAt(place)) || !std::isfinite(numbers[place]) || numbers[place] < least) continue;
    cells.x.push_back(center.x());
    cells.y.push_back(center.y());
    cells.values.push_back(numbers[place]);
  }
  if (cells.values.empty()) return;
  figure.colorLabel = label;
  figure.series.push_back(cells);
}

inline void addEnds(rex::Figure& figure, const Eigen::Vector2d& start, const Eigen::Vector2d& goal) {
  const rex::Series look{
      .style = rex::SeriesStyle::kPoints, .marker = rex::Marker::kDot, .size = 2.5, .color = kBlack};
  addLine(figure, {start, goal}, look);
  figure.notes = {{"start", start.x() + 0.1, start.y() + 0.4}, {"goal", goal.x() + 0.1, goal.y() + 0.4}};
}

// A map as a scene: walls of boxes, and a disc that drives.
inline rex::Simulator sceneOf(const CellMap& map, MapCell start, MapCell goal) {
  const auto at = [](double x, double y, double z) {
    return "t(" + std::to_string(x) + " " + std::to_string(y) + " " + std::to_string(z) + ")";
  };
  const auto box = [](double x, double y, double z) {
    return " type=ST_box size=[" + std::to_string(x) + " " + std::to_string(y) + " " + std::to_string(z) +
           "]";
  };
  const Eigen::Vector2d s = centerOf(start), g = centerOf(goal);
  std::string text = "body floor { X=<T " + at(map.width / 2., map.height / 2., -0.05) + ">" +
                     box(map.width, map.height, 0.1) + " color=[.82 .82 .80] fixed }\n";
  for (const Block& wall : wallsOf(map)) {
    const Eigen::Vector2d center = (wall.lower + wall.upper) / 2, size = wall.upper - wall.lower;
    text += "body wall { X=<T " + at(center.x(), center.y(), 0.25) + ">" + box(size.x(), size.y(), 0.5) +
            " color=[.25 .35 .60] fixed }\n";
  }
  text += "body goal { X=<T " + at(g.x(), g.y(), 0.01) + "> type=ST_cylinder size=[0 0 0.02 0.45]" +
          " color=[.85 .10 .10] fixed }\nbody base { X=<T " + at(s.x(), s.y(), 0.25) + "> fixed }\n" +
          "body robot { type=ST_cylinder size=[0 0 0.5 0.4] color=[.90 .58 .18] }\n" +
          "joint drive (base robot) { type=transXY }\n";
  return rex::Simulator(rex::SimulatorDescription{.sceneName = "map.ors", .sceneText = text, .q = {}});
}

// All connected arcs as one line that follows each of them there and back.
inline void walkArcs(const Network& roadmap, std::size_t node, std::vector<bool>& isSeen,
                     std::vector<std::size_t>& line) {
  isSeen[node] = true;
  line.push_back(node);
  for (const Arc& arc : roadmap[node]) {
    if (isSeen[arc.to])
      line.push_back(arc.to);
    else
      walkArcs(roadmap, arc.to, isSeen, line);
    line.push_back(node);
  }
}
