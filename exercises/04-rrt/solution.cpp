#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "exercise.h"
#include "peg_problem.h"
#include "plane_pictures.h"
#include "planning/phase_space.h"
#include "planning/rrt.h"

using namespace rex;

double radiusDensity(double r, double l1, double l2) {
  // <solution radiusDensity>
  // r^2 = l1^2 + l2^2 + 2 l1 l2 cos(angle of the second joint), and that angle is uniform: the density of r
  // is 1/pi over |dr / dangle|, for the angle and its negative lead to the same r.
  const double cosine = (r * r - l1 * l1 - l2 * l2) / (2 * l1 * l2);
  if (std::abs(cosine) >= 1) return 0;
  return r / (std::numbers::pi * l1 * l2 * std::sqrt(1 - cosine * cosine));
  // <todo>
  //| // TODO: which angle of the second joint gives r, and how fast does r change with it?
  //| return 0;
  // </solution>
}

double handDensity(const Eigen::Vector2d& p, double l1, double l2) {
  // <solution handDensity>
  return radiusDensity(p.norm(), l1, l2) / (2 * std::numbers::pi * p.norm());
  // <todo>
  //| // TODO: the first joint turns the hand to all sides alike. Over which length is p(r) spread?
  //| return 0;
  // </solution>
}

int nearestNode(const std::vector<Eigen::VectorXd>& nodes, const Eigen::VectorXd& target) {
  int nearest = 0;
  // <solution nearestNode>
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const double distance2 = (nodes[i] - target).squaredNorm();
    if (distance2 >= least) continue;
    least = distance2;
    nearest = static_cast<int>(i);
  }
  // <todo>
  //| // TODO: look at all of them.
  // </solution>
  return nearest;
}

Eigen::VectorXd stepTowards(const Eigen::VectorXd& from, const Eigen::VectorXd& target, double stepSize) {
  // <solution stepTowards>
  const double distance = (target - from).norm();
  if (distance <= stepSize) return target;
  return from + stepSize / distance * (target - from);
  // <todo>
  //| // TODO: line 5 of slide 4:39, but never beyond the target.
  //| return from;
  // </solution>
}

Eigen::VectorXd drawTarget(const SearchSettings& settings, const Eigen::VectorXd& aim, Rng& rng) {
  // <solution drawTarget>
  if (rng.uniform() < settings.goalBias) return aim;
  Eigen::VectorXd target = settings.lower;
  for (Eigen::Index i = 0; i < target.size(); ++i)
    target[i] = rng.uniform(settings.lower[i], settings.upper[i]);
  return target;
  // <todo>
  //| // TODO: lines 3 and 4 of slide 4:40. rng.uniform() is uniform in [0, 1), rng.uniform(a, b) in [a, b).
  //| return Eigen::VectorXd::Zero(aim.size());
  // </solution>
}

std::optional<NewNode> rrtStep(const Tree& tree, const Eigen::VectorXd& target, double stepSize,
                               const EdgeTest& edgeFree) {
  // <solution rrtStep>
  const int nearest = nearestNode(tree.nodes, target);
  const Eigen::VectorXd& from = tree.nodes[static_cast<std::size_t>(nearest)];
  const Eigen::VectorXd q = stepTowards(from, target, stepSize);
  if (!edgeFree(from, q)) return {};
  return NewNode{q, nearest};
  // <todo>
  //| // TODO: lines 4 to 6 of slide 4:39. What has to be free: the new node, or more?
  //| return {};
  // </solution>
}

Path wayFromRoot(const Tree& tree, int node) {
  Path path;
  // <solution wayFromRoot>
  for (int i = node; i >= 0; i = tree.parents[static_cast<std::size_t>(i)])
    path.push_back(tree.nodes[static_cast<std::size_t>(i)]);
  std::reverse(path.begin(), path.end());
  // <todo>
  //| // TODO: parents lead from a node to the root. In which order is the path wanted?
  // </solution>
  return path;
}

TreeSearch growBackward(const Eigen::VectorXd& start, const Eigen::VectorXd& goal,
                        const SearchSettings& settings, const EdgeTest& edgeFree, Rng& rng) {
  TreeSearch search;
  search.tree.nodes = {goal};
  search.tree.parents = {-1};
  // <solution growBackward>
  Tree& tree = search.tree;
  for (int i = 0; i < settings.maxSamples; ++i) {
    const std::optional<NewNode> made =
        rrtStep(tree, drawTarget(settings, start, rng), settings.stepSize, edgeFree);
    if (!made) continue;
    tree.nodes.push_back(made->q);
    tree.parents.push_back(made->parent);
    if ((made->q - start).norm() > settings.stepSize || !edgeFree(made->q, start)) continue;
    search.path = wayFromRoot(tree, static_cast<int>(tree.nodes.size()) - 1);
    search.path.push_back(start);
    std::reverse(search.path.begin(), search.path.end());
    break;
  }
  // <todo>
  //| // TODO: add the nodes that rrtStep() gives until one is so near the start that a step would join them.
  //| // Who is the root here, and which way round is the path?
  // </solution>
  return search;
}

Path joinedPath(const Tree& fromStart, int a, const Tree& fromGoal, int b) {
  Path path;
  // <solution joinedPath>
  path = wayFromRoot(fromStart, a);
  Path rest = wayFromRoot(fromGoal, b);
  if (rest.back() == path.back()) rest.pop_back();
  path.insert(path.end(), rest.rbegin(), rest.rend());
  // <todo>
  //| // TODO: two ways from roots. Which of them is turned round, and when is a node there twice?
  // </solution>
  return path;
}

TwoTreeSearch growBoth(const Eigen::VectorXd& start, const Eigen::VectorXd& goal,
                       const SearchSettings& settings, const EdgeTest& edgeFree, Rng& rng) {
  TwoTreeSearch search;
  search.fromStart.nodes = {start};
  search.fromStart.parents = {-1};
  search.fromGoal.nodes = {goal};
  search.fromGoal.parents = {-1};
  // <solution growBoth>
  SearchSettings unbiased = settings;
  unbiased.goalBias = 0;
  const auto grow = [&](Tree& tree, const Eigen::VectorXd& target) {
    const std::optional<NewNode> made = rrtStep(tree, target, settings.stepSize, edgeFree);
    if (!made) return false;
    tree.nodes.push_back(made->q);
    tree.parents.push_back(made->parent);
    return true;
  };
  for (int i = 0; i < settings.maxSamples; ++i) {
    Tree& one = i % 2 == 0 ? search.fromStart : search.fromGoal;
    Tree& other = i % 2 == 0 ? search.fromGoal : search.fromStart;
    if (!grow(one, drawTarget(unbiased, start, rng))) continue;
    const Eigen::VectorXd met = one.nodes.back();
    while (grow(other, met))
      if (other.nodes.back() == met) {
        search.path = joinedPath(search.fromStart, static_cast<int>(search.fromStart.nodes.size()) - 1,
                                 search.fromGoal, static_cast<int>(search.fromGoal.nodes.size()) - 1);
        return search;
      }
  }
  // <todo>
  //| // TODO: let one tree take a random step, and the other go for the new node. Do they meet? Then swap.
  // </solution>
  return search;
}

Path shortened(const Path& path, const EdgeTest& edgeFree, Rng& rng) {
  Path better = path;
  // <solution shortened>
  // Between two random places of the path, nodes or not, goes a straight way where it is free.
  for (int round = 0; round < 200; ++round) {
    const auto place = [&](double at, std::size_t& edge) -> Eigen::VectorXd {
      edge = static_cast<std::size_t>(at);
      return better[edge] + (at - static_cast<double>(edge)) * (better[edge + 1] - better[edge]);
    };
    const double edges = static_cast<double>(better.size()) - 1;
    const double one = rng.uniform(0, edges), other = rng.uniform(0, edges);
    std::size_t i = 0, j = 0;
    const Eigen::VectorXd a = place(std::min(one, other), i), b = place(std::max(one, other), j);
    if (i == j || !edgeFree(a, b)) continue;
    better.erase(better.begin() + static_cast<long>(i) + 1, better.begin() + static_cast<long>(j) + 1);
    better.insert(better.begin() + static_cast<long>(i) + 1, {a, b});
  }
  // <todo>
  //| // TODO: where does the path make a detour that a straight way would not?
  // </solution>
  return better;
}

double effort(const Eigen::Vector2d& from, const Eigen::Vector2d& to, double T) {
  // <solution effort>
  // d^T G^-1 d, where d is what the drift from + T v leaves to be done, and G is the integral of b b^T with
  // b = (T - t, 1): how a push at time t moves the end.
  const double position = to[0] - from[0] - T * from[1], velocity = to[1] - from[1];
  return 12 * position * position / (T * T * T) - 12 * position * velocity / (T * T) +
         4 * velocity * velocity / T;
  // <todo>
  //| // TODO: what is missing at the end if nothing pushes? Which u(t) makes up for it with the least effort?
  //| return 0;
  // </solution>
}

double forceAt(const Eigen::Vector2d& from, const Eigen::Vector2d& to, double T, double t) {
  // <solution forceAt>
  const double position = to[0] - from[0] - T * from[1], velocity = to[1] - from[1];
  const double slope = 12 / (T * T * T) * position - 6 / (T * T) * velocity;
  const double last = 4 / T * velocity - 6 / (T * T) * position;
  return slope * (T - t) + last;
  // <todo>
  //| // TODO: the best force changes linearly in time. Position and velocity at T give its two numbers.
  //| return 0;
  // </solution>
}

PhaseNode phaseStep(const std::vector<Eigen::Vector2d>& states, const Eigen::Vector2d& target, double T,
                    double tau) {
  PhaseNode node;
  // <solution phaseStep>
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < states.size(); ++i) {
    const double needed = effort(states[i], target, T);
    if (needed >= least) continue;
    least = needed;
    node.parent = static_cast<int>(i);
  }
  // A force that changes linearly: the velocity is a parabola, the position a cubic.
  const Eigen::Vector2d& x = states[static_cast<std::size_t>(node.parent)];
  const double u = forceAt(x, target, T, 0), change = (forceAt(x, target, T, T) - u) / T;
  node.x = {x[0] + tau * x[1] + tau * tau / 2 * u + tau * tau * tau / 6 * change,
            x[1] + tau * u + tau * tau / 2 * change};
  // <todo>
  //| // TODO: from which state is the effort least? Where is the point after tau seconds under that force?
  // </solution>
  return node;
}

std::optional<ParentChoice> bestParent(const Tree& tree, const std::vector<int>& near,
                                       const Eigen::VectorXd& q, const EdgeTest& edgeFree) {
  std::optional<ParentChoice> best;
  // <solution bestParent>
  for (const int i : near) {
    const auto k = static_cast<std::size_t>(i);
    const double cost = tree.costs[k] + (tree.nodes[k] - q).norm();
    // The edge is asked last: that is what takes time.
    if ((!best || cost < best->cost) && edgeFree(tree.nodes[k], q)) best = ParentChoice{i, cost};
  }
  // <todo>
  //| // TODO: lines 6 to 12 of slide 4:45. Which cost does the next candidate have to beat?
  // </solution>
  return best;
}

Tree rewired(Tree tree, const std::vector<int>& near, int node, const EdgeTest& edgeFree) {
  // <solution rewired>
  std::vector<bool> moved(tree.nodes.size(), false);
  const auto n = static_cast<std::size_t>(node);
  bool any = false;
  for (const int i : near) {
    const auto k = static_cast<std::size_t>(i);
    const double cost = tree.costs[n] + (tree.nodes[k] - tree.nodes[n]).norm();
    if (cost >= tree.costs[k] || !edgeFree(tree.nodes[n], tree.nodes[k])) continue;
    tree.parents[k] = node;
    any = true;
  }
  if (!any) return tree;
  // Whoever moved takes along all that hangs on it: from the new node down, costs are counted afresh.
  std::vector<std::vector<std::size_t>> below(tree.nodes.size());
  for (std::size_t i = 0; i < tree.parents.size(); ++i)
    if (tree.parents[i] >= 0) below[static_cast<std::size_t>(tree.parents[i])].push_back(i);
  for (std::vector<std::size_t> waiting{n}; !waiting.empty();) {
    const std::size_t at = waiting.back();
    waiting.pop_back();
    for (const std::size_t child : below[at]) {
      tree.costs[child] = tree.costs[at] + (tree.nodes[child] - tree.nodes[at]).norm();
      waiting.push_back(child);
    }
  }
  // <todo>
  //| // TODO: lines 15 to 20 of slide 4:45. What else becomes cheaper when a node does?
  // </solution>
  return tree;
}

StarSearch growStar(const Eigen::VectorXd& start, const Eigen::VectorXd& goal, const SearchSettings& settings,
                    double gamma, const EdgeTest& edgeFree, Rng& rng) {
  StarSearch search;
  search.tree = {.nodes = {start}, .parents = {-1}, .costs = {0}};
  // <solution growStar>
  Tree& tree = search.tree;
  SearchSettings now = settings;
  for (int i = 0; i < settings.maxSamples; ++i) {
    const Eigen::VectorXd target = drawTarget(now, goal, rng);
    const int nearest = nearestNode(tree.nodes, target);
    const Eigen::VectorXd from = tree.nodes[static_cast<std::size_t>(nearest)];
    const Eigen::VectorXd q = stepTowards(from, target, settings.stepSize);
    const double n = static_cast<double>(tree.nodes.size());
    const double reach =
        std::min(settings.stepSize, gamma * std::pow(std::log(n) / n, 1. / static_cast<double>(q.size())));
    std::vector<int> near{nearest};
    for (int k = 0; k < static_cast<int>(tree.nodes.size()); ++k)
      if (k != nearest && (tree.nodes[static_cast<std::size_t>(k)] - q).norm() <= reach) near.push_back(k);
    if (const std::optional<ParentChoice> choice = bestParent(tree, near, q, edgeFree)) {
      const int node = static_cast<int>(tree.nodes.size());
      tree.nodes.push_back(q);
      tree.parents.push_back(choice->parent);
      tree.costs.push_back(choice->cost);
      tree = rewired(std::move(tree), near, node, edgeFree);
      if (search.goal < 0 && q == goal) {
        search.goal = node;
        now.goalBias = 0;
      }
    }
    search.best.push_back(search.goal < 0 ? std::numeric_limits<double>::infinity()
                                          : tree.costs[static_cast<std::size_t>(search.goal)]);
  }
  // <todo>
  //| // TODO: as an RRT, but each new node takes its best parent, and then rewires what is near.
  // </solution>
  return search;
}

// From here on everything is given: all parts one after another, with pictures. Change it as you like.

namespace {

std::string text(double x) { return std::to_string(x).substr(0, 5); }

// Part 1.
void showHand() {
  const double l1 = 0.6, l2 = 0.4;
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
  Histogram sampled = normalized(histogramOf(radii, 80));
  sampled.label = "20000 random postures";
  plot("hand", {.title = "How far the hand of a two-link arm is from the shoulder",
                .xLabel = "distance r [m]",
                .yLabel = "density [1/m]",
                .yRange = AxisRange(0, 6),
                .legend = Legend::kOutside,
                .series = {{.label = "p(r)", .x = r, .y = density, .size = 1.5, .color = kOrange}},
                .histograms = {sampled}});
  plot("hand_plane", {.title = "Where the hand is",
                      .xLabel = "x [m]",
                      .yLabel = "y [m]",
                      .colorLabel = "density [1/m^2], at most 1.5",
                      .equalAxes = true,
                      .colorRange = AxisRange(0, 1.5),
                      .series = {hands},
                      .width = 640,
                      .height = 560});
}

// Part 2: the tree of n targets, by any test of edges.
Tree grow(const Eigen::VectorXd& root, const SearchSettings& settings, const EdgeTest& edgeFree) {
  Rng rng(1);
  Tree tree{.nodes = {root}, .parents = {-1}};
  for (int i = 0; i < settings.maxSamples; ++i) {
    if (const auto made = rrtStep(tree, drawTarget(settings, root, rng), settings.stepSize, edgeFree)) {
      tree.nodes.push_back(made->q);
      tree.parents.push_back(made->parent);
    }
  }
  return tree;
}

void showSteps() {
  const EdgeTest edgeFree = freeIn(kThinWalls);
  const EdgeTest nodeFree = [&](const Eigen::VectorXd&, const Eigen::VectorXd& qb) {
    return edgeFree(qb, qb);
  };
  const SearchSettings settings = inThePlane(0.06, 0, 500);
  plotPanels("edges", "500 targets, thin walls",
             {{"only nodes are tested", kThinWalls, {grow(kLowerLeft, settings, nodeFree)}, {}},
              {"edges are tested", kThinWalls, {grow(kLowerLeft, settings, edgeFree)}, {}}});
}

// Parts 3 to 5 in the plane.
void showSearches() {
  const EdgeTest edgeFree = freeIn(kThinWalls);
  const SearchSettings settings = inThePlane(0.06, 0.1, 5000);
  Rng rng(4);
  const TreeSearch backward = growBackward(kLowerLeft, kUpperRight, settings, edgeFree, rng);
  const TwoTreeSearch both = growBoth(kLowerLeft, kUpperRight, settings, edgeFree, rng);
  plotPanels("searches", "From the lower left to the upper right",
             {{"backward", kThinWalls, {backward.tree}, backward.path},
              {"from both sides", kThinWalls, {both.fromStart, both.fromGoal}, both.path}});
  if (both.path.empty()) return;
  const Path better = shortened(both.path, edgeFree, rng);
  plotPanels("shortened", "The same path, shortened",
             {{"length " + text(lengthOf(both.path)), kThinWalls, {}, both.path},
              {"length " + text(lengthOf(better)), kThinWalls, {}, better}});
}

// Where the peg goes along the edges of a tree, from node to node.
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

// Moves along a path in joint space, with 40 postures to the radian.
void filmPath(const std::string& name, const std::string& caption, const Path& path) {
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

// Parts 3 to 5 with the arm.
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
  print("lengths: backward, from both sides, that shortened",
        Eigen::RowVector3d(lengthOf(backward.path), lengthOf(both.path), lengthOf(better)));
  filmPath("path", "The path from both sides, as it was found", both.path);
  filmPath("shortened_path", "The same path, shortened", better);
}

// Part 6. state(to, t): where the library's motion from (0, 1) is after t of 2 seconds.
void showPhaseSpace(Eigen::Vector2d (*state)(const Eigen::Vector2d& to, double t)) {
  const Eigen::Vector2d x0(0, 1);
  const double T = 2;
  const auto distance = [&](double q, double v) { return std::sqrt(effort(x0, {q, v}, T)); };
  HeatMap map = heatMapOf(distance, {-2, 6}, {-3, 5}, 120, 120);
  map.contours = 10;
  std::vector<Series> motions;
  for (const Eigen::Vector2d& to :
       {Eigen::Vector2d(-1, 1), Eigen::Vector2d(-1, -2), Eigen::Vector2d(4, -1), Eigen::Vector2d(5, 4)}) {
    Series yours{.size = 1.5, .color = kOrange}, library{.dashed = true, .color = kBlack};
    for (double t = 0.02; t <= T + 1e-9; t += 0.02) {
      add(yours, phaseStep({x0}, to, T, std::min(t, T)).x, 0);
      add(library, state(to, std::min(t, T)), 0);
    }
    motions.push_back(yours);
    motions.push_back(library);
  }
  plot("effort", {.title = "Distance from (0, 1) in phase space, T = 2 s, and ways (dashed: library's)",
                  .xLabel = "position [m]",
                  .yLabel = "velocity [m/s]",
                  .colorLabel = "root of the least effort [N s^(1/2)]",
                  .colorRange = AxisRange(0, 10),
                  .legend = Legend::kNone,
                  .series = motions,
                  .heatMap = map,
                  .width = 760,
                  .height = 600});
  Rng rng(1);
  std::vector<Eigen::Vector2d> states{x0};
  Tree tree{.nodes = {x0}, .parents = {-1}};
  for (int i = 0; i < 600; ++i) {
    const Eigen::Vector2d target(rng.uniform(-3, 3), rng.uniform(-3, 3));
    const PhaseNode node = phaseStep(states, target, T, 0.15);
    if (node.parent < 0) break;
    states.push_back(node.x);
    tree.nodes.emplace_back(node.x);
    tree.parents.push_back(node.parent);
  }
  plot("phase_tree", {.title = "A tree in phase space: where it may go depends on how fast it is",
                      .xLabel = "position [m]",
                      .yLabel = "velocity [m/s]",
                      .series = {outline(tree, 0, kBlue)}});
}

// Part 7. The shortest way touches the disc on two lines and follows its edge between them.
const PlaneWorld kOneDisc{.discs = {{{0.5, 0.5}, 0.25}}};
const Eigen::Vector2d kLeft(0.1, 0.4), kRight(0.9, 0.55);
constexpr double kShortest = 0.944047, kGamma = 1.5;

// cost(n): of the library's RRT* after n samples.
void showStar(const std::function<double(int n)>& cost) {
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
      series.x.push_back(static_cast<double>(i + 1));
      series.y.push_back(star.best[i]);
    }
    if (!series.x.empty()) costs.push_back(series);
  }
  Series library{.label = "library", .dashed = true, .color = kBlack};
  for (int n = 200; n <= settings.maxSamples; n += 100) {
    library.x.push_back(n);
    library.y.push_back(cost(n));
  }
  costs.push_back(library);
  plot("costs", {.title = "Around a disc with RRT*",
                 .xLabel = "samples",
                 .yLabel = "length of the path [m]",
                 .xRange = AxisRange(0, settings.maxSamples),
                 .series = costs,
                 .horizontalLines = {{kShortest, "shortest way"}}});
  Rng rng(1);
  const Tree plain = grow(kLeft, settings, edgeFree);
  const Path best = star.goal < 0 ? Path() : wayFromRoot(star.tree, star.goal);
  const Path first = wayFromRoot(plain, nearestNode(plain.nodes, kRight));
  plotPanels("star", "RRT and RRT*, 2000 samples each",
             {{"RRT, length " + text(lengthOf(first)), kOneDisc, {plain}, first},
              {"RRT*, length " + text(lengthOf(best)), kOneDisc, {star.tree}, best}});
}

}  // namespace

int main() {
  showHand();
  showSteps();
  showSearches();
  showArm();

  // Once your own functions work, they lie on the library's, or beside them.
  showPhaseSpace([](const Eigen::Vector2d& to, double t) { return leastEffortState({0, 1}, to, 2, t); });
  const PathProblem problem{
      .space = Space::box(Eigen::Vector2d(0, 0), Eigen::Vector2d(1, 1)),
      .allValid = eachColumn([](const Eigen::VectorXd& q) { return wayIsFree(kOneDisc, q, q); }),
      .start = kLeft,
      .goal = kRight};
  showStar([&](int n) {
    Rng rng(1);
    const RrtOptions growth{.stepSize = 0.1, .goalBias = 0.05, .maxSamples = n};
    const PathResult result = growRrtStar(problem, {.growth = growth, .gamma = kGamma}, rng);
    return result.status == PathStatus::kFound ? result.length : 2;
  });
}
