#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "exercise.h"
#include "plane_world.h"
#include "show.h"
// <solution headers>
// What a mistake in wrong.cpp takes from the library.
// <todo>
// </solution>

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
  //| // TODO: two paths, each from a root. Which one is reversed, and when is a node there twice?
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

// What follows is given: the parts of the exercise one after another. show.cpp draws the pictures.
int main() {
  // Part 1: an arm with links of 0.6 m and 0.4 m, in 20000 random postures.
  showHand(0.6, 0.4);

  // Part 2: two trees that spend 500 targets each between thin walls.
  showEdges();

  // Parts 3 to 5: between the same walls, from the lower left to the upper right, with steps of 0.06.
  const EdgeTest edgeFree = freeIn(kThinWalls);
  const SearchSettings settings = inThePlane(0.06, 0.1, 5000);
  Rng rng(4);
  const TreeSearch backward = growBackward(kLowerLeft, kUpperRight, settings, edgeFree, rng);
  const TwoTreeSearch both = growBoth(kLowerLeft, kUpperRight, settings, edgeFree, rng);
  showSearches(backward, both);
  if (!both.path.empty()) showShortened(both.path, shortened(both.path, edgeFree, rng));

  // The same with an arm, from q = 0 into the hole of exercise 02.
  showArm();

  // Part 6: distances from a point at 0 m that moves with 1 m/s, for motions of 2 s.
  showDistances({0, 1}, 2);
  showPhaseTree({0, 1}, 2);

  // Part 7: 2000 samples around a disc, where the shortest path is known.
  showStar();
}
