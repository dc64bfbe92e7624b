#include "show.h"

#include <algorithm>
#include <cmath>
#include <iostream>
#include <numbers>

#include "peg_problem.h"
#include "plane_pictures.h"
#include "planning/phase_space.h"
#include "planning/rrt.h"

using namespace rex;

namespace {

std::string text(double x) { return std::to_string(x).substr(0, 5); }

// The tree of part 2 after all targets, grown with any test of edges.
Tree grow(const Eigen::VectorXd& root, const SearchSettings& settings, const EdgeTest& edgeFree) {
  Rng rng(1);
  Tree tree{.nodes = {root}, .parents = {-1}};
  for (int left = settings.maxSamples; left > 0; --left) {
    const Eigen::VectorXd target = drawTarget(settings, root, rng);
    const std::optional<NewNode> grown = rrtStep(tree, target, settings.stepSize, edgeFree);
    if (!grown) continue;
    tree.nodes.push_back(grown->q);
    tree.parents.push_back(grown->parent);
  }
  return tree;
}

// The positions of the peg along the edges of a tree, from node to node.
std::vector<std::vector<Eigen::Vector3d>> pegEdges(const Tree& tree) {
  Simulator S("pegInAHole.ors");
  std::vector<Eigen::Vector3d> places;
  std::vector<std::vector<Eigen::Vector3d>> edges;
  for (std::size_t i = 0; i < tree.nodes.size(); ++i) {
    S.setJointAngles(tree.nodes[i]);
    places.push_back(S.kinematicsPos("peg"));
    if (i > 0) edges.push_back({places[static_cast<std::size_t>(tree.parents[i])], places[i]});
  }
  return edges;
}

// Moves along a path in joint space, with 40 postures per radian.
void filmPath(const std::string& name, const std::string& caption, const Path& path) {
  if (path.empty()) {
    std::cout << "no film " << name << ".mp4: there is no path yet\n";
    return;
  }
  Simulator S("pegInAHole.ors");
  for (std::size_t i = 1; i < path.size(); ++i) {
    const double steps = std::ceil(40 * (path[i] - path[i - 1]).norm());
    for (double k = 1; k <= steps; ++k) S.setJointAngles(path[i - 1] + k / steps * (path[i] - path[i - 1]));
  }
  const PictureOptions look{.caption = caption, .traces = {"peg"}, .view = {1, -1, 0.7}};
  writeVideo(S, name, look);
  writeContactSheet(S, name + "_sheet", look);
  writeReplay(S, name, look);
}

const PlaneWorld kOneDisc{.discs = {{{0.5, 0.5}, 0.25}}};
const Eigen::Vector2d kLeft(0.1, 0.4), kRight(0.9, 0.55);
constexpr double kShortest = 0.944047, kGamma = 1.5;

// The length of the path of the library's RRT*; 2 if there is none.
double lengthByLibrary(const RrtStarOptions& options, std::uint64_t seed = 1) {
  const PathProblem problem{
      .space = Space::box(Eigen::Vector2d(0, 0), Eigen::Vector2d(1, 1)),
      .allValid = eachColumn([](const Eigen::VectorXd& q) { return wayIsFree(kOneDisc, q, q); }),
      .start = kLeft,
      .goal = kRight};
  Rng rng(seed);
  const PathResult result = growRrtStar(problem, options, rng);
  return result.status == PathStatus::kFound ? result.length : 2;
}

// With steps of 0.3, so that the radius of the exponent limits what is near.
void plotExponents() {
  Figure figure{.title = "RRT* of the library around a disc, mean of 10 seeds",
                .xLabel = "samples",
                .yLabel = "length above that of the shortest path [m]",
                .logX = true,
                .logY = true};
  for (const int extra : {0, 1}) {
    Series series{.label = extra == 0 ? "(log n / n)^(1/d)" : "(log n / n)^(1/(d+1))",
                  .style = SeriesStyle::kLinesPoints};
    for (int n = 250; n <= 8000; n *= 2) {
      double mean = 0;
      for (std::uint64_t seed = 1; seed <= 10; ++seed)
        mean += lengthByLibrary({.growth = {.stepSize = 0.3, .maxSamples = n},
                                 .gamma = kGamma,
                                 .exponent = 1. / (2 + extra),
                                 .isInformed = false},
                                seed) /
                10;
      series.add(n, mean - kShortest);
    }
    figure.series.push_back(series);
  }
  plot("exponents", figure);
}

}  // namespace

void showHand(double l1, double l2) {
  Rng rng(1);
  std::vector<double> radii, r, density;
  Series hands{.style = SeriesStyle::kPoints, .marker = Marker::kDot, .size = 0.5};
  for (int i = 0; i < 20000; ++i) {
    const double first = rng.uniform(-std::numbers::pi, std::numbers::pi);
    const double both = first + rng.uniform(-std::numbers::pi, std::numbers::pi);
    const Eigen::Vector2d p(l1 * std::cos(first) + l2 * std::cos(both),
                            l1 * std::sin(first) + l2 * std::sin(both));
    radii.push_back(p.norm());
    if (i % 4 != 0) continue;
    add(hands, p, 0);
    hands.values.push_back(std::min(handDensity(p, l1, l2), 1.5));
  }
  for (double at = 0.002; at < 1.1; at += 0.004) {
    r.push_back(at);
    density.push_back(std::min(radiusDensity(at, l1, l2), 6.));
  }
  Histogram sampled = normalized(sampleHistogram(radii, 80));
  sampled.label = "20000 random postures";
  plot("hand", {.title = "How far the hand of a two-link arm is from the shoulder",
                .xLabel = "distance r [m]",
                .yLabel = "density [1/m]",
                .yRange = AxisRange(0, 6),
                .legend = Legend::kOutside,
                .series = {{.label = "p(r)", .x = r, .y = density, .size = 1.5, .color = kOrange}},
                .histograms = {sampled}});
  plot("hand_plane", planeFigure({.title = "The position of the hand",
                                  .colorLabel = "density [1/m^2], at most 1.5",
                                  .colorRange = AxisRange(0, 1.5),
                                  .series = {hands},
                                  .width = 640,
                                  .height = 560}));
}

void showEdges() {
  const EdgeTest edgeFree = freeIn(kThinWalls);
  const EdgeTest nodeFree = [&](const Eigen::VectorXd&, const Eigen::VectorXd& qb) {
    return edgeFree(qb, qb);
  };
  const SearchSettings settings = inThePlane(0.06, 0, 500);
  plotPanels("edges", "500 targets, thin walls",
             {{"only nodes are tested", kThinWalls, {grow(kLowerLeft, settings, nodeFree)}, {}},
              {"edges are tested", kThinWalls, {grow(kLowerLeft, settings, edgeFree)}, {}}});
}

void showSearches(const TreeSearch& backward, const TwoTreeSearch& both) {
  plotPanels("searches", "From the lower left to the upper right",
             {{"backward", kThinWalls, {backward.tree}, backward.path},
              {"from both sides", kThinWalls, {both.fromStart, both.fromGoal}, both.path}});
}

void showShortened(const Path& path, const Path& better) {
  plotPanels("shortened", "The same path, shortened",
             {{"length " + text(lengthOf(path)), kThinWalls, {}, path},
              {"length " + text(lengthOf(better)), kThinWalls, {}, better}});
}

void showArm() {
  Simulator S("pegInAHole.ors");
  const EdgeTest edgeFree = freeForArm(S);
  Rng rng(1);
  TreeSearch backward;
  TwoTreeSearch both;
  for (int i = 0; i < kArmTries && backward.path.empty(); ++i)
    backward = growBackward(kZero, kInTheHole, kArmSettings, edgeFree, rng);
  for (int i = 0; i < kArmTries && both.path.empty(); ++i)
    both = growBoth(kZero, kInTheHole, kArmSettings, edgeFree, rng);
  const auto draw = [&](const std::string& name, const std::string& caption, const Tree& tree) {
    S.setJointAngles(tree.nodes[0]);
    writePicture(S, name, {.caption = caption, .paths = pegEdges(tree), .view = {1, -1, 0.7}});
  };
  draw("arm_backward.png", "The peg in the tree that grows out of the hole", backward.tree);
  draw("arm_both.png", "The peg in the tree from q = 0", both.fromStart);
  const Path better = both.path.empty() ? both.path : shortened(both.path, edgeFree, rng);
  const auto nodes = [](const Tree& tree) { return static_cast<double>(tree.nodes.size()); };
  print("nodes: backward, from the start, from the goal",
        Eigen::RowVector3d(nodes(backward.tree), nodes(both.fromStart), nodes(both.fromGoal)));
  print("lengths: backward, from both sides, the latter shortened",
        Eigen::RowVector3d(lengthOf(backward.path), lengthOf(both.path), lengthOf(better)));
  filmPath("path", "The path from both sides, as it was found", both.path);
  filmPath("shortened_path", "The same path, shortened", better);
}

void showDistances(const Eigen::Vector2d& from, double T) {
  const auto distance = [&](double q, double v) { return std::sqrt(effort(from, {q, v}, T)); };
  HeatMap map = sampledHeatMap(distance, {-2, 6}, {-3, 5}, 120, 120);
  map.contours = 10;
  std::vector<Series> motions;
  for (const Eigen::Vector2d& to :
       {Eigen::Vector2d(-1, 1), Eigen::Vector2d(-1, -2), Eigen::Vector2d(4, -1), Eigen::Vector2d(5, 4)}) {
    Series yours{.size = 1.5, .color = kOrange}, library{.dashed = true, .color = kBlack};
    for (double t = 0.02; t <= T + 1e-9; t += 0.02) {
      add(yours, phaseStep({from}, to, T, std::min(t, T)).x, 0);
      add(library, leastEffortState(from, to, T, std::min(t, T)), 0);
    }
    motions.push_back(yours);
    motions.push_back(library);
  }
  plot("effort", {.title = "Distance from (0, 1) in phase space, T = 2 s, and motions (dashed: library)",
                  .xLabel = "position [m]",
                  .yLabel = "velocity [m/s]",
                  .colorLabel = "square root of the least effort [N s^(1/2)]",
                  .colorRange = AxisRange(0, 10),
                  .legend = Legend::kNone,
                  .series = motions,
                  .heatMap = map,
                  .width = 760,
                  .height = 600});
}

void showPhaseTree(const Eigen::Vector2d& from, double T) {
  Rng rng(1);
  std::vector<Eigen::Vector2d> states{from};
  Tree tree{.nodes = {from}, .parents = {-1}};
  for (int i = 0; i < 600; ++i) {
    const Eigen::Vector2d target(rng.uniform(-3, 3), rng.uniform(-3, 3));
    const PhaseNode node = phaseStep(states, target, T, 0.15);
    if (node.parent < 0) break;
    states.push_back(node.x);
    tree.nodes.emplace_back(node.x);
    tree.parents.push_back(node.parent);
  }
  plot("phase_tree", {.title = "A tree in phase space: its directions depend on the velocity",
                      .xLabel = "position [m]",
                      .yLabel = "velocity [m/s]",
                      .series = {outline(tree, 0, kBlue)}});
}

void showStar() {
  const EdgeTest edgeFree = freeIn(kOneDisc);
  const SearchSettings settings = inThePlane(0.1, 0.05, 2000);
  std::vector<Series> costs;
  StarSearch star;
  for (const int seed : {3, 2, 1}) {
    Rng rng(static_cast<std::uint64_t>(seed));
    star = growStar(kLeft, kRight, settings, kGamma, edgeFree, rng);
    Series series{.label = "yours, seed " + std::to_string(seed)};
    for (std::size_t i = 0; i < star.best.size(); ++i) {
      if (!std::isfinite(star.best[i])) continue;
      series.add(static_cast<double>(i + 1), star.best[i]);
    }
    if (!series.x.empty()) costs.push_back(series);
  }
  Series library{.label = "library", .dashed = true, .color = kBlack};
  for (int n = 200; n <= settings.maxSamples; n += 100)
    library.add(n, lengthByLibrary({.growth = {.stepSize = 0.1, .maxSamples = n}, .gamma = kGamma}));
  costs.push_back(library);
  plot("costs", {.title = "Around a disc with RRT*",
                 .xLabel = "samples",
                 .yLabel = "length of the path [m]",
                 .xRange = AxisRange(0, settings.maxSamples),
                 .series = costs,
                 .horizontalLines = {{kShortest, "shortest path"}}});
  Rng rng(1);
  const Tree plain = grow(kLeft, settings, edgeFree);
  const Path best = star.goal < 0 ? Path() : wayFromRoot(star.tree, star.goal);
  const Path first = wayFromRoot(plain, nearestNode(plain.nodes, kRight));
  plotPanels("star", "RRT and RRT*, 2000 samples each",
             {{"RRT, length " + text(lengthOf(first)), kOneDisc, {plain}, first},
              {"RRT*, length " + text(lengthOf(best)), kOneDisc, {star.tree}, best}});
  plotExponents();
}
