#pragma once

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "collision/motion_clearance.h"
#include "course/film.h"
#include "grading/evidence.h"
#include "plane_pictures.h"
#include "plane_problems.h"
#include "tree_checks.h"

// What the checks show when trees and paths are wrong.

/// A world in the plane, from above.
inline rex::Figure worldFigure(const std::string& title, const PlaneWorld& world) {
  rex::Figure figure = rex::planeFigure({.title = title,
                                         .xRange = rex::AxisRange(-0.03, 1.03),
                                         .yRange = rex::AxisRange(-0.03, 1.03),
                                         .legend = rex::Legend::kOutside,
                                         .width = 720,
                                         .height = 560});
  drawObstacles(figure, world, 0);
  return figure;
}

/// All edges of a sound tree as one thin line.
inline rex::Series edgesOf(const std::string& label, const Tree& tree) {
  rex::Series edges = outline(tree, 0, {0.6F, 0.65F, 0.7F});
  edges.label = label;
  return edges;
}

inline rex::Series dotsOf(const std::string& label, double size, const rex::Color& color,
                          const Path& points = {}) {
  return rex::dots(points, {.label = label, .size = size, .color = color});
}

/// A path in the plane beside the one it was made from; pieces that are not free are red.
inline rex::grading::Evidence shortenedSeen(const PlaneProblem& problem, const Path& given, const Path& got) {
  rex::Figure figure = worldFigure("The given path, and the shortened one", problem.world);
  figure.series = {rex::through(got, rex::grading::gotCurve("got")),
                   rex::through(given, rex::grading::wantedCurve("given"))};
  const EdgeTest isFree = freeIn(problem.world, 1e-9);
  std::string label = "not free";
  for (std::size_t i = 1; i < got.size(); ++i) {
    const Path piece{got[i - 1], got[i]};
    if (isFree(piece[0], piece[1])) continue;
    figure.series.push_back(rex::through(piece, rex::grading::wrongCurve(std::exchange(label, ""))));
  }
  return {.figures = {figure}};
}

/// A path in the plane beside the wanted one; both begin at a dot.
inline rex::grading::Evidence pathSeen(const Path& got, const Path& wanted) {
  rex::Figure figure = worldFigure("The path, which begins at the dot", {});
  const auto begin = [](const Path& path, const rex::Color& color) {
    return dotsOf("", 3, color, {path.front()});
  };
  if (!got.empty()) {
    figure.series = {rex::through(got, rex::grading::gotCurve("got")), begin(got, rex::grading::kGotColor)};
  }
  figure.series.push_back(rex::through(wanted, rex::grading::wantedCurve("wanted")));
  figure.series.push_back(begin(wanted, rex::grading::kWantedColor));
  const auto along = [](const Path& path, rex::Series curve) {
    for (const Eigen::VectorXd& q : path) curve.add(static_cast<double>(curve.x.size()), q[0]);
    return curve;
  };
  rex::Figure numbers{.title = "Along the path",
                      .xLabel = "number of the configuration",
                      .yLabel = "x [m]",
                      .legend = rex::Legend::kOutside,
                      .series = {along(got, rex::grading::gotCurve("got")),
                                 along(wanted, rex::grading::wantedCurve("wanted"))}};
  if (got.empty()) numbers.series.erase(numbers.series.begin());
  return {.figures = {figure, numbers}};
}

/// The step of a tree towards a target: from `parent` to q, if there is one.
struct PlaneEdge {
  int parent = -1;
  Eigen::VectorXd q;
};

/// A tree with the returned edge and the wanted one; a parent of -1 stands for none.
inline rex::grading::Evidence edgeSeen(const std::string& title, const PlaneWorld& world, const Tree& tree,
                                       const PlaneEdge& got, const PlaneEdge& wanted) {
  rex::Figure figure = worldFigure(title, world);
  figure.series = {edgesOf("tree", tree)};
  const int count = static_cast<int>(tree.nodes.size());
  const auto add = [&](const PlaneEdge& edge, rex::Series look) {
    if (edge.parent < 0 || edge.parent >= count || edge.q.size() != 2) {
      figure.title += "; " + look.label + ": none";
      return;
    }
    const Path ends{tree.nodes[static_cast<std::size_t>(edge.parent)], edge.q};
    figure.series.push_back(rex::through(ends, std::move(look)));
  };
  add(got, rex::grading::gotCurve("got"));
  add(wanted, rex::grading::wantedCurve("wanted"));
  return {.figures = {figure}};
}

/// Edges of two trees with the same nodes that differ in their parents, wrong costs, and a ring at a node.
inline rex::grading::Evidence rewiredSeen(const PlaneWorld& world, const Tree& got, const Tree& wanted,
                                          int node, std::size_t here) {
  rex::Figure figure = worldFigure("Rewiring: edges of the tree, and those that differ", world);
  figure.series = {edgesOf("tree, got", got),
                   dotsOf("the new node", 2.5, kBlack, {got.nodes[static_cast<std::size_t>(node)]})};
  const auto add = [&](const Tree& tree, std::size_t at, rex::Series look) {
    if (tree.parents[at] < 0) return;
    const Path ends{tree.nodes[at], tree.nodes[static_cast<std::size_t>(tree.parents[at])]};
    figure.series.push_back(rex::through(ends, std::move(look)));
  };
  std::string gotLabel = "got", wantedLabel = "wanted";
  const std::vector<double> costs = costsOf(got);
  Path wrong;
  for (std::size_t i = 1; i < got.nodes.size() && i < got.costs.size(); ++i) {
    if (got.parents[i] != wanted.parents[i]) {
      add(got, i, rex::grading::wrongCurve(std::exchange(gotLabel, "")));
      add(wanted, i, rex::grading::wantedCurve(std::exchange(wantedLabel, "")));
    } else if (std::abs(got.costs[i] - costs[i]) > 1e-9) {
      wrong.push_back(got.nodes[i]);
    }
  }
  if (!wrong.empty()) figure.series.push_back(dotsOf("wrong cost", 1, rex::grading::kWrongColor, wrong));
  if (here < got.nodes.size())
    figure.series.push_back(
        rex::grading::wrongPoint("the node in question", got.nodes[here][0], got.nodes[here][1]));
  return {.figures = {figure}};
}

/// Marks pieces of a path that are not free, and ends that are not those of the problem.
inline void markPath(rex::Figure& figure, const PlaneProblem& problem, const Path& path) {
  const EdgeTest isFree = freeIn(problem.world, 1e-9);
  std::string label = "not free";
  for (std::size_t i = 1; i < path.size(); ++i)
    if (!isFree(path[i - 1], path[i]))
      figure.series.push_back(
          rex::through(Path{path[i - 1], path[i]}, rex::grading::wrongCurve(std::exchange(label, ""))));
  label = "not where it should be";
  for (const auto& [q, wanted] : {std::pair{path.front(), problem.start}, {path.back(), problem.goal}})
    if (q != wanted) figure.series.push_back(rex::grading::wrongPoint(std::exchange(label, ""), q[0], q[1]));
}

/// Sound trees between start and goal with the path found in them, and the edge to node `here` of one of
/// them.
inline rex::grading::Evidence treesSeen(const PlaneProblem& problem, const std::vector<Tree>& trees,
                                        const Path& path, std::size_t which = 0, std::size_t here = 0) {
  rex::Figure figure = worldFigure("The tree, from start to goal", problem.world);
  if (problem.world.boxes.empty() && problem.world.discs.empty()) figure.xRange = figure.yRange = {};
  for (const Tree& tree : trees) figure.series.push_back(edgesOf(figure.series.empty() ? "tree" : "", tree));
  const bool isPath = std::all_of(path.begin(), path.end(), [](const auto& q) { return q.size() == 2; });
  if (isPath && !path.empty()) figure.series.push_back(rex::through(path, rex::grading::gotCurve("path")));
  figure.series.push_back(dotsOf("start and goal", 3, kBlack, {problem.start, problem.goal}));
  if (isPath && !path.empty()) markPath(figure, problem, path);
  if (which >= trees.size() || here == 0 || here >= trees[which].nodes.size()) return {.figures = {figure}};
  const Tree& tree = trees[which];
  const Path ends{tree.nodes[static_cast<std::size_t>(tree.parents[here])], tree.nodes[here]};
  figure.series.push_back(rex::through(ends, rex::grading::wrongCurve("the edge in question")));
  figure.series.push_back(rex::grading::wrongPoint("", ends[1][0], ends[1][1]));
  return {.figures = {figure}};
}

/// A sound tree, and edges to other parents that would save cost.
inline rex::grading::Evidence betterSeen(const PlaneProblem& problem, const Tree& tree, const Tree& better) {
  rex::Figure figure = worldFigure("The tree, and edges that would save cost", problem.world);
  figure.series = {edgesOf("tree", tree), dotsOf("start and goal", 3, kBlack, {problem.start, problem.goal})};
  std::string gotLabel = "got", wantedLabel = "shorter";
  constexpr std::size_t kMostSeries = 80;
  for (std::size_t i = 1; i < tree.nodes.size() && figure.series.size() < kMostSeries; ++i) {
    if (better.parents[i] == tree.parents[i]) continue;
    const auto edge = [&](const Tree& of) {
      return Path{of.nodes[i], of.nodes[static_cast<std::size_t>(of.parents[i])]};
    };
    figure.series.push_back(rex::through(edge(tree), rex::grading::wrongCurve(std::exchange(gotLabel, ""))));
    figure.series.push_back(
        rex::through(edge(better), rex::grading::wantedCurve(std::exchange(wantedLabel, ""))));
  }
  return {.figures = {figure}};
}

/// Nodes in the plane with a target, and two of them: the one that was returned, and the nearest.
inline rex::grading::Evidence nearestSeen(const std::vector<Eigen::VectorXd>& nodes,
                                          const Eigen::VectorXd& target, int got, int wanted) {
  if (target.size() != 2) return {};
  rex::Figure figure = rex::planeFigure({.title = "Nodes and a target", .legend = rex::Legend::kOutside});
  figure.series = {dotsOf("nodes", 1.5, {.5f, .5f, .5f}, nodes)};
  const auto line = [&](int node, const rex::Series& look) {
    if (node < 0 || node >= static_cast<int>(nodes.size())) return;
    figure.series.push_back(rex::through(Path{target, nodes[static_cast<std::size_t>(node)]}, look));
  };
  line(got, rex::grading::gotCurve("got"));
  line(wanted, rex::grading::wantedCurve("wanted"));
  figure.series.push_back(dotsOf("target", 2.5, kBlack, {target}));
  return {.figures = {figure}};
}

/// Targets in a box of three dimensions, which goes from 0 to 1.
inline rex::grading::Evidence drawsSeen(const Eigen::MatrixXd& others) {
  std::vector<rex::Figure> figures;
  for (const int other : {1, 2}) {
    rex::Series dots = dotsOf("got", .6, rex::grading::kGotColor);
    for (const auto& one : others.colwise()) dots.add(one[0], one[other]);
    figures.push_back(
        {.title = "Targets in their box",
         .xLabel = "coordinate 0: 0 at lower, 1 at upper",
         .yLabel = "coordinate " + std::to_string(other),
         .equalAxes = true,
         .series = {dots, rex::grading::wantedCurve("wanted: inside", {0, 1, 1, 0, 0}, {0, 0, 1, 1, 0})}});
  }
  return {.figures = figures};
}

/// The arm on its way along one edge: how far bodies are apart, and a film that opens where it is too little.
inline rex::grading::Evidence armEdgeSeen(const rex::Simulator& S, const Eigen::VectorXd& qa,
                                          const Eigen::VectorXd& qb) {
  constexpr int kPieces = 20;
  constexpr double kApart = 0.02;  // for an edge to be free
  const rex::ContactModel contacts(S.model());
  Path postures;
  rex::Series distances = rex::grading::gotCurve("got");
  std::size_t wrong = kPieces / 2;
  for (int i = kPieces; i >= 0; --i) {
    postures.emplace_back(qa + static_cast<double>(i) / kPieces * (qb - qa));
    distances.add(static_cast<double>(i) / kPieces,
                  rex::motionClearance(S.model(), contacts, postures.back(), postures.back(), 1e-4));
    if (distances.y.back() < kApart) wrong = static_cast<std::size_t>(std::max(i, 1));
  }
  std::reverse(postures.begin(), postures.end());
  rex::Figure figure{.title = "The edge in question",
                     .xLabel = "share of the edge",
                     .yLabel = "distance between bodies [m]",
                     .series = {distances}};
  figure.horizontalLines = {{.at = kApart, .label = "free: at least"}};
  const rex::Film film = rex::makeFilm(S, postures, {});
  return {.figures = {figure}, .film = film, .moment = film[wrong].time};
}

/// How far the configurations of a path are from q = 0, where it should begin, and from the goal.
inline rex::Figure endsSeen(const Path& path, const Eigen::VectorXd& goal) {
  rex::Series fromStart = rex::grading::gotCurve("from q = 0; wanted: 0 at the beginning"),
              fromGoal = rex::grading::wrongCurve("from the goal; wanted: 0 at the end");
  for (std::size_t i = 0; i < path.size(); ++i) {
    for (rex::Series* series : {&fromStart, &fromGoal}) series->x.push_back(static_cast<double>(i));
    fromStart.y.push_back(path[i].norm());
    fromGoal.y.push_back((path[i] - goal).norm());
  }
  return {.title = "How far the path is from its ends",
          .xLabel = "number of the configuration",
          .yLabel = "distance [rad]",
          .series = {fromStart, fromGoal}};
}

/// A film of a path of the arm, if it is one, beside the goal; opens at the first piece that is too long, has
/// length zero or is not free.
inline rex::grading::Evidence armPathSeen(const rex::Simulator& S, const Path& path,
                                          const Eigen::VectorXd& goal, double stepSize,
                                          const EdgeTest& isFree) {
  const auto fits = [&](const Eigen::VectorXd& q) { return q.size() == goal.size() && q.allFinite(); };
  if (path.empty() || !std::all_of(path.begin(), path.end(), fits)) return {};
  const rex::Film film = rex::makeFilm(S, path, {}), wanted = rex::makeFilm(S, Path{goal}, {});
  std::size_t wrong = path.size() - 1;
  rex::Series lengths = rex::grading::gotCurve("got");
  for (std::size_t i = path.size() - 1; i > 0; --i) {
    const double length = (path[i] - path[i - 1]).norm();
    if (length == 0 || length > stepSize + 1e-9 || !isFree(path[i - 1], path[i])) wrong = i;
    lengths.add(static_cast<double>(i), length);
  }
  rex::Figure figure{.title = "The pieces of the path",
                     .xLabel = "number of the piece",
                     .yLabel = "length [rad]",
                     .series = {lengths}};
  figure.horizontalLines = {{.at = stepSize, .label = "wanted: at most"}};
  figure.verticalLines = {rex::grading::wrongFrom(static_cast<double>(wrong))};
  if (path.front().norm() > 1e-9 || (path.back() - goal).norm() > 1e-9) figure = endsSeen(path, goal);
  return {.figures = {figure}, .film = rex::grading::withWanted(film, wanted), .moment = film[wrong].time};
}
