#pragma once

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "course/film.h"
#include "grading/evidence_parts.h"
#include "plane_pictures.h"
#include "plane_problems.h"
#include "tree_checks.h"

// What the checks show when trees and paths are wrong.

/// A world in the plane, from above.
inline rex::Figure figureOf(const std::string& title, const PlaneWorld& world) {
  rex::Figure figure{.title = title,
                     .xLabel = "x [m]",
                     .yLabel = "y [m]",
                     .equalAxes = true,
                     .xRange = rex::AxisRange(-0.03, 1.03),
                     .yRange = rex::AxisRange(-0.03, 1.03),
                     .legend = rex::Legend::kOutside,
                     .width = 720,
                     .height = 560};
  drawObstacles(figure, world, 0);
  return figure;
}

/// All edges of a sound tree as one thin line.
inline rex::Series edgesOf(const std::string& label, const Tree& tree) {
  rex::Series edges = outline(tree, 0, {0.6F, 0.65F, 0.7F});
  edges.label = label;
  return edges;
}

/// A path in the plane beside the one it was made from; pieces that are not free are red.
inline rex::grading::Evidence shortenedSeen(const PlaneProblem& problem, const Path& given, const Path& got) {
  rex::Figure figure = figureOf("The given path, and the shortened one", problem.world);
  figure.series = {rex::grading::through(got, rex::grading::gotCurve("got")),
                   rex::grading::through(given, rex::grading::wantedCurve("given"))};
  const EdgeTest isFree = freeIn(problem.world, 1e-9);
  std::string label = "not free";
  for (std::size_t i = 1; i < got.size(); ++i) {
    const Path piece{got[i - 1], got[i]};
    if (isFree(piece[0], piece[1])) continue;
    figure.series.push_back(rex::grading::through(piece, rex::grading::wrongCurve(std::exchange(label, ""))));
  }
  return {.figures = {figure}};
}

/// A path in the plane beside the wanted one; both begin at a dot.
inline rex::grading::Evidence pathSeen(const Path& got, const Path& wanted) {
  rex::Figure figure = figureOf("The path, which begins at the dot", {});
  const auto begin = [](const Path& path, const rex::Color& color) {
    return rex::grading::through(
        Path{path.front()},
        rex::Series{
            .style = rex::SeriesStyle::kPoints, .marker = rex::Marker::kDot, .size = 3, .color = color});
  };
  if (!got.empty()) {
    figure.series = {rex::grading::through(got, rex::grading::gotCurve("got")),
                     begin(got, rex::grading::kGotColor)};
  }
  figure.series.push_back(rex::grading::through(wanted, rex::grading::wantedCurve("wanted")));
  figure.series.push_back(begin(wanted, rex::grading::kWantedColor));
  return {.figures = {figure}};
}

/// The step of a tree towards a target: from `parent` to q, if there is one.
struct PlaneEdge {
  int parent = -1;
  Eigen::VectorXd q;
};

/// A tree with the returned edge and the wanted one; a parent of -1 stands for none.
inline rex::grading::Evidence edgeSeen(const std::string& title, const PlaneWorld& world, const Tree& tree,
                                       const PlaneEdge& got, const PlaneEdge& wanted) {
  rex::Figure figure = figureOf(title, world);
  figure.series = {edgesOf("tree", tree)};
  const int count = static_cast<int>(tree.nodes.size());
  const auto add = [&](const PlaneEdge& edge, rex::Series look) {
    if (edge.parent < 0 || edge.parent >= count || edge.q.size() != 2) {
      figure.title += "; " + look.label + ": none";
      return;
    }
    const Path ends{tree.nodes[static_cast<std::size_t>(edge.parent)], edge.q};
    figure.series.push_back(rex::grading::through(ends, std::move(look)));
  };
  add(got, rex::grading::gotCurve("got"));
  add(wanted, rex::grading::wantedCurve("wanted"));
  return {.figures = {figure}};
}

/// Edges of two trees with the same nodes that differ in their parents.
inline rex::grading::Evidence rewiredSeen(const PlaneWorld& world, const Tree& got, const Tree& wanted) {
  rex::Figure figure = figureOf("Rewiring: edges of the tree, and those that differ", world);
  figure.series = {edgesOf("tree, got", got)};
  const auto add = [&](const Tree& tree, std::size_t node, rex::Series look) {
    const Path ends{tree.nodes[node], tree.nodes[static_cast<std::size_t>(tree.parents[node])]};
    figure.series.push_back(rex::grading::through(ends, std::move(look)));
  };
  std::string gotLabel = "got", wantedLabel = "wanted", costLabel = "wrong cost";
  const std::vector<double> costs = costsOf(got);
  for (std::size_t i = 1; i < got.nodes.size() && i < got.costs.size(); ++i) {
    if (got.parents[i] != wanted.parents[i]) {
      add(got, i, rex::grading::wrongCurve(std::exchange(gotLabel, "")));
      add(wanted, i, rex::grading::wantedCurve(std::exchange(wantedLabel, "")));
    } else if (std::abs(got.costs[i] - costs[i]) > 1e-9) {
      figure.series.push_back(
          rex::grading::wrongPoint(std::exchange(costLabel, ""), got.nodes[i][0], got.nodes[i][1]));
    }
  }
  return {.figures = {figure}};
}

/// A sound tree between start and goal, with its wrong edges and costs marked.
inline rex::grading::Evidence treeSeen(const PlaneProblem& problem, const Tree& tree, double stepSize) {
  rex::Figure figure = figureOf("The tree from start to goal", problem.world);
  const rex::Series dots{.label = "start and goal",
                         .style = rex::SeriesStyle::kPoints,
                         .marker = rex::Marker::kDot,
                         .size = 3,
                         .color = kBlack};
  figure.series = {edgesOf("tree", tree), rex::grading::through(Path{problem.start, problem.goal}, dots)};
  const EdgeTest isFree = freeIn(problem.world);
  const std::vector<double> costs = costsOf(tree);
  std::string edgeLabel = "too long, or not free";
  rex::Series wrongCosts{.label = "wrong cost",
                         .style = rex::SeriesStyle::kPoints,
                         .marker = rex::Marker::kDot,
                         .size = .8,
                         .color = rex::grading::kWrongColor};
  Path wrong;
  for (std::size_t i = 1; i < tree.nodes.size(); ++i) {
    const Path ends{tree.nodes[static_cast<std::size_t>(tree.parents[i])], tree.nodes[i]};
    if ((ends[1] - ends[0]).norm() > stepSize + 1e-9 || !isFree(ends[0], ends[1]))
      figure.series.push_back(
          rex::grading::through(ends, rex::grading::wrongCurve(std::exchange(edgeLabel, ""))));
    if (i < tree.costs.size() && std::abs(tree.costs[i] - costs[i]) > 1e-9) wrong.push_back(ends[1]);
  }
  if (!wrong.empty()) figure.series.push_back(rex::grading::through(wrong, wrongCosts));
  return {.figures = {figure}};
}

/// A film of a path of the arm, if it is one, beside the goal; opens at the first step that is too long, has
/// length zero or is not free.
inline rex::grading::Evidence armPathSeen(const rex::Simulator& S, const Path& path,
                                          const Eigen::VectorXd& goal, double stepSize,
                                          const EdgeTest& isFree) {
  const auto fits = [&](const Eigen::VectorXd& q) { return q.size() == goal.size() && q.allFinite(); };
  if (path.empty() || !std::all_of(path.begin(), path.end(), fits)) return {};
  const rex::Film film = rex::filmOf(S, path, {}), wanted = rex::filmOf(S, Path{goal}, {});
  rex::Series lengths = rex::grading::gotCurve("got");
  std::size_t wrong = path.size() - 1;
  for (std::size_t i = path.size() - 1; i > 0; --i) {
    const double length = (path[i] - path[i - 1]).norm();
    if (length == 0 || length > stepSize + 1e-9 || !isFree(path[i - 1], path[i])) wrong = i;
  }
  for (std::size_t i = 1; i < path.size(); ++i) {
    lengths.x.push_back(static_cast<double>(i));
    lengths.y.push_back((path[i] - path[i - 1]).norm());
  }
  rex::Figure figure{.title = "The pieces of the path",
                     .xLabel = "number of the piece",
                     .yLabel = "length [rad]",
                     .series = {lengths}};
  figure.horizontalLines = {{.at = stepSize, .label = "wanted: at most"}};
  figure.verticalLines = {rex::grading::wrongFrom(static_cast<double>(wrong))};
  return {.figures = {figure}, .film = rex::grading::withWanted(film, wanted), .moment = film[wrong].time};
}
