#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "course/course.h"

// The functions you complete in main.cpp. A configuration q has d numbers: the joint angles of an arm (in the
// checks turned by a rotation, which preserves distances and straight lines) or a position in the plane. Its
// distance from another is the length |qa - qb| of their difference. Slides are cited as chapter:number.

using Path = std::vector<Eigen::VectorXd>;  // configurations, one after the other

/// Whether the straight line from qa to qb, both ends included, is free of collision. It is passed to you and
/// knows the world. Your queries are recorded, and trees may only have edges that you asked about.
using EdgeTest = std::function<bool(const Eigen::VectorXd& qa, const Eigen::VectorXd& qb)>;

/// A tree: the parent of node i is node parents[i]; node 0 is the root, with parent -1. Only the trees of
/// part 7 have costs: costs[i] is the length of the path from the root to node i along the edges.
struct Tree {
  std::vector<Eigen::VectorXd> nodes{};
  std::vector<int> parents{};
  std::vector<double> costs{};
};

/// How trees grow. Random targets lie in the box from lower to upper (d numbers each); there are at most
/// maxSamples targets.
struct SearchSettings {
  Eigen::VectorXd lower, upper;
  double stepSize = 0.1;  ///< alpha
  double goalBias = 0.1;  ///< beta
  int maxSamples = 1000;
};

// Part 1, the position of the hand (12.7.1 a). A planar arm has two links of l1 and l2 metres; each of its
// two angles is uniform in [-pi, pi).

/// The density [1/m] of the distance r > 0 [m] of the hand from the shoulder; zero where the hand cannot be.
/// It is not tested where it is infinite or has only a limit.
double radiusDensity(double r, double l1, double l2);

/// The density [1/m^2] of the position p [m] of the hand in the plane, with the shoulder at 0. As above.
double handDensity(const Eigen::Vector2d& p, double l1, double l2);

// Part 2, one step of an RRT (4:39 and 4:40).

/// The number of the node nearest to `target`. There is at least one node.
int nearestNode(const std::vector<Eigen::VectorXd>& nodes, const Eigen::VectorXd& target);

/// The point stepSize along the straight line from `from` to `target`; `target` itself if it is not farther
/// away than that, even if it equals `from`.
Eigen::VectorXd stepTowards(const Eigen::VectorXd& from, const Eigen::VectorXd& target, double stepSize);

/// `aim` with probability goalBias, otherwise a uniform sample of the box of the settings.
Eigen::VectorXd drawTarget(const SearchSettings& settings, const Eigen::VectorXd& aim, rex::Rng& rng);

struct NewNode {
  Eigen::VectorXd q{};
  int parent = -1;
};

/// One step of the tree from its nearest node towards `target`: the new node, or nothing if the edge to it is
/// not free.
std::optional<NewNode> rrtStep(const Tree& tree, const Eigen::VectorXd& target, double stepSize,
                               const EdgeTest& edgeFree);

// Part 3, growing backward from the goal (12.7.1 b).

/// The configurations on the path from the root to that node, both included.
Path wayFromRoot(const Tree& tree, int node);

/// A tree and the path found in it, empty if there is none.
struct TreeSearch {
  Tree tree{};
  Path path{};
};

/// Grows a tree from its root `goal` by rrtStep() towards drawTarget(), which aims at `start`. As soon as a
/// new node is at most stepSize from `start`, with a free edge between them, the path is complete: `start`,
/// that node, ..., `goal`. The number of nodes must reflect the goalBias. After maxSamples targets the path
/// is empty.
TreeSearch growBackward(const Eigen::VectorXd& start, const Eigen::VectorXd& goal,
                        const SearchSettings& settings, const EdgeTest& edgeFree, rex::Rng& rng);

// Part 4, search from both sides (12.7.1 c, 4:42).

/// The path from the root of one tree to its node a, and on from node b of the other tree to its root. If a
/// and b are the same configuration, the path contains it once.
Path joinedPath(const Tree& fromStart, int a, const Tree& fromGoal, int b);

struct TwoTreeSearch {
  Tree fromStart{}, fromGoal{};
  Path path{};
};

/// Two trees, with the roots `start` and `goal`. They take turns: one takes a step towards a random target in
/// the box, and its new node is the target of the other, which takes one step, or as many as it can.
/// goalBias has no effect. The path is complete when a node of one is at most stepSize from a node of the
/// other, with a free edge between them. It is empty after maxSamples random targets.
TwoTreeSearch growBoth(const Eigen::VectorXd& start, const Eigen::VectorXd& goal,
                       const SearchSettings& settings, const EdgeTest& edgeFree, rex::Rng& rng);

// Part 5, a better path (12.7.1 d).

/// A path between the same ends, never longer than `path` and free of collision. The excess of RRT paths over
/// the shortest path shrinks by more than half, on average, and by nine tenths if the straight line is free.
/// `path` has at least two configurations, and its edges are free. Any method counts.
Path shortened(const Path& path, const EdgeTest& edgeFree, rex::Rng& rng);

// Part 6, distance in phase space (12.7.2). A point of 1 kg on a line has the state (position [m],
// velocity [m/s]); the force u(t) [N] brings it from one state to another in exactly T seconds, with the
// least effort, which is the integral of u(t)^2. All results are exact up to 1e-8 of the largest numbers that
// they are computed from.

/// The least effort [N^2 s].
double effort(const Eigen::Vector2d& from, const Eigen::Vector2d& to, double T);

/// The force u(t) [N] of that motion, 0 <= t <= T.
double forceAt(const Eigen::Vector2d& from, const Eigen::Vector2d& to, double T, double t);

struct PhaseNode {
  Eigen::Vector2d x = Eigen::Vector2d::Zero();
  int parent = -1;
};

/// One step of a tree in phase space: the first tau seconds (0 < tau <= T) of the motion to `target` in T
/// seconds, from the state that needs the least effort for it. Returns the state that is reached, and the
/// number of the state it started in.
PhaseNode phaseStep(const std::vector<Eigen::Vector2d>& states, const Eigen::Vector2d& target, double T,
                    double tau);

// Part 7, RRT* (4:45, corrected).

struct ParentChoice {
  int parent = -1;
  double cost = 0;  ///< of the new node
};

/// The node among `near` from which q is reached at the least cost from the root, over a free edge; nothing
/// if no edge is free.
std::optional<ParentChoice> bestParent(const Tree& tree, const std::vector<int>& near,
                                       const Eigen::VectorXd& q, const EdgeTest& edgeFree);

/// The tree after `node` has become the parent of each node of `near` that is reached at less cost through
/// it, over a free edge. The costs of all nodes are updated.
Tree rewired(Tree tree, const std::vector<int>& near, int node, const EdgeTest& edgeFree);

struct StarSearch {
  Tree tree{};
  int goal = -1;               ///< the node that is the goal; -1: not reached
  std::vector<double> best{};  ///< the cost of the goal after each sample, infinity before it is reached
};

/// An RRT* from its root `start`, which uses all maxSamples targets. They aim at `goal` with goalBias until a
/// step ends there and makes it a node, and never after that. A new node is found by a step from the nearest
/// node; it takes the best parent among the near nodes, and the near nodes are rewired. Of n nodes, those are
/// near that are at most stepSize and at most gamma (log(n) / n)^(1/d) away, and the nearest node.
StarSearch growStar(const Eigen::VectorXd& start, const Eigen::VectorXd& goal, const SearchSettings& settings,
                    double gamma, const EdgeTest& edgeFree, rex::Rng& rng);
