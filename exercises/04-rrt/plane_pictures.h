#pragma once

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "exercise.h"
#include "plane_world.h"

// How trees are drawn. Used by show.cpp and by the grader.

/// A world with trees and a path in it.
struct Panel {
  std::string title;
  PlaneWorld world;
  std::vector<Tree> trees;
  Path path;
};

inline constexpr rex::Color kStone{0.35F, 0.37F, 0.42F}, kBlue{0.27F, 0.51F, 0.71F},
    kGreen{0.1F, 0.55F, 0.25F}, kOrange{0.9F, 0.45F, 0.05F}, kBlack{0, 0, 0};

inline void add(rex::Series& series, const Eigen::VectorXd& q, double shift) {
  series.add(q[0] + shift, q[1]);
}

/// One line through all edges of a tree, which goes down to each node and back up.
inline rex::Series outline(const Tree& tree, double shift, rex::Color color) {
  std::vector<std::vector<std::size_t>> children(tree.nodes.size());
  for (std::size_t i = 1; i < tree.nodes.size(); ++i)
    children[static_cast<std::size_t>(tree.parents[i])].push_back(i);
  rex::Series series{.size = 0.5, .color = color};
  for (std::size_t at = 0;;) {
    add(series, tree.nodes[at], shift);
    if (!children[at].empty()) {
      const std::size_t next = children[at].back();
      children[at].pop_back();
      at = next;
    } else if (at == 0) {
      return series;
    } else {
      at = static_cast<std::size_t>(tree.parents[at]);
    }
  }
}

inline void drawObstacles(rex::Figure& figure, const PlaneWorld& world, double shift) {
  for (const PlaneBox& box : world.boxes) {
    const double left = box.lower.x() + shift, right = box.upper.x() + shift;
    figure.regions.push_back({.x = {left, right, right, left},
                              .y = {box.lower.y(), box.lower.y(), box.upper.y(), box.upper.y()},
                              .color = kStone});
  }
  for (const PlaneDisc& disc : world.discs) {
    rex::Region round{.color = kStone};
    for (double angle = 0; angle < 2 * std::numbers::pi; angle += 0.05)
      round.add(disc.center.x() + shift + disc.radius * std::cos(angle),
                disc.center.y() + disc.radius * std::sin(angle));
    figure.regions.push_back(round);
  }
}

inline void plotPanels(const std::string& name, const std::string& title, const std::vector<Panel>& panels) {
  rex::Figure figure{.title = title,
                     .xLabel = panels.size() > 1 ? "x [m], shifted by 1.1 on the right" : "x [m]",
                     .yLabel = "y [m]",
                     .equalAxes = true,
                     .xRange = rex::AxisRange(-0.03, 1.1 * static_cast<double>(panels.size()) - 0.07),
                     .yRange = rex::AxisRange(-0.03, 1.1),
                     .width = 1000,
                     .height = 560};
  double shift = 0;
  for (const Panel& panel : panels) {
    drawObstacles(figure, panel.world, shift);
    figure.notes.push_back({panel.title, shift, 1.05});
    figure.series.push_back(
        {.x = {shift, shift + 1, shift + 1, shift, shift}, .y = {0, 0, 1, 1, 0}, .color = kBlack});
    for (std::size_t i = 0; i < panel.trees.size(); ++i)
      figure.series.push_back(outline(panel.trees[i], shift, i == 0 ? kBlue : kGreen));
    rex::Series path{.size = 2, .color = kOrange};
    for (const Eigen::VectorXd& q : panel.path) add(path, q, shift);
    if (!path.x.empty()) figure.series.push_back(path);
    shift += 1.1;
  }
  rex::plot(name, figure);
}
