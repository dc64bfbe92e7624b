#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "exercise.h"
#include "plane_world.h"
#include "show.h"

using namespace rex;

double radiusDensity(double r, double l1, double l2) {
  // TODO: which angle of the second joint gives r, and how fast does r change with it?
  return 0;
}

double handDensity(const Eigen::Vector2d& p, double l1, double l2) {
  // TODO: the first joint turns the hand to all sides alike. Over which length is p(r) spread?
  return 0;
}

int nearestNode(const std::vector<Eigen::VectorXd>& nodes, const Eigen::VectorXd& target) {
  int nearest = 0;
  // TODO: look at all of them.
  return nearest;
}

Eigen::VectorXd stepTowards(const Eigen::VectorXd& from, const Eigen::VectorXd& target, double stepSize) {
  // TODO: line 5 of slide 4:39, but never beyond the target.
  return from;
}

Eigen::VectorXd drawTarget(const SearchSettings& settings, const Eigen::VectorXd& aim, Rng& rng) {
  // TODO: lines 3 and 4 of slide 4:40. rng.uniform() is uniform in [0, 1), rng.uniform(a, b) in [a, b).
  return Eigen::VectorXd::Zero(aim.size());
}

std::optional<NewNode> rrtStep(const Tree& tree, const Eigen::VectorXd& target, double stepSize,
                               const EdgeTest& edgeFree) {
  // TODO: lines 4 to 6 of slide 4:39. What has to be free: the new node, or more?
  return {};
}

Path wayFromRoot(const Tree& tree, int node) {
  Path path;
  // TODO: parents lead from a node to the root. In which order is the path wanted?
  return path;
}

TreeSearch growBackward(const Eigen::VectorXd& start, const Eigen::VectorXd& goal,
                        const SearchSettings& settings, const EdgeTest& edgeFree, Rng& rng) {
  TreeSearch search;
  search.tree.nodes = {goal};
  search.tree.parents = {-1};
  // TODO: add the nodes that rrtStep() gives until one is so near the start that a step would join them.
  // Who is the root here, and which way round is the path?
  return search;
}

Path joinedPath(const Tree& fromStart, int a, const Tree& fromGoal, int b) {
  Path path;
  // TODO: two paths, each from a root. Which one is reversed, and when is a node there twice?
  return path;
}

TwoTreeSearch growBoth(const Eigen::VectorXd& start, const Eigen::VectorXd& goal,
                       const SearchSettings& settings, const EdgeTest& edgeFree, Rng& rng) {
  TwoTreeSearch search;
  search.fromStart.nodes = {start};
  search.fromStart.parents = {-1};
  search.fromGoal.nodes = {goal};
  search.fromGoal.parents = {-1};
  // TODO: let one tree take a random step, and the other go for the new node. Do they meet? Then swap.
  return search;
}

Path shortened(const Path& path, const EdgeTest& edgeFree, Rng& rng) {
  Path better = path;
  // TODO: where does the path make a detour that a straight way would not?
  return better;
}

double effort(const Eigen::Vector2d& from, const Eigen::Vector2d& to, double T) {
  // TODO: what is missing at the end if nothing pushes? Which u(t) makes up for it with the least effort?
  return 0;
}

double forceAt(const Eigen::Vector2d& from, const Eigen::Vector2d& to, double T, double t) {
  // TODO: the best force changes linearly in time. Position and velocity at T give its two numbers.
  return 0;
}

PhaseNode phaseStep(const std::vector<Eigen::Vector2d>& states, const Eigen::Vector2d& target, double T,
                    double tau) {
  PhaseNode node;
  // TODO: from which state is the effort least? Where is the point after tau seconds under that force?
  return node;
}

std::optional<ParentChoice> bestParent(const Tree& tree, const std::vector<int>& near,
                                       const Eigen::VectorXd& q, const EdgeTest& edgeFree) {
  std::optional<ParentChoice> best;
  // TODO: lines 6 to 12 of slide 4:45. Which cost does the next candidate have to beat?
  return best;
}

Tree rewired(Tree tree, const std::vector<int>& near, int node, const EdgeTest& edgeFree) {
  // TODO: lines 15 to 20 of slide 4:45. What else becomes cheaper when a node does?
  return tree;
}

StarSearch growStar(const Eigen::VectorXd& start, const Eigen::VectorXd& goal, const SearchSettings& settings,
                    double gamma, const EdgeTest& edgeFree, Rng& rng) {
  StarSearch search;
  search.tree = {.nodes = {start}, .parents = {-1}, .costs = {0}};
  // TODO: as an RRT, but each new node takes its best parent, and then rewires what is near.
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
