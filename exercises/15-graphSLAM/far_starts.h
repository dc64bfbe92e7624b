#pragma once

#include "graph_checks.h"
#include "graph_mistakes.h"

// Starts from which plain steps go astray.

using BothEnds = Eigen::Matrix<double, 6, 1>;

inline Eigen::Vector3d errorBetween(const BothEnds& ends, const Eigen::Vector3d& z) {
  return turnedWrongly(z, turnedWrongly(ends.head<3>(), ends.tail<3>(), 1), 1);
}

/// What to add to the numbers of all poses but the first: (H + damping) dx = -b, by differences of each edge.
inline Eigen::VectorXd dampedStep(const PoseMap& map, double damping) {
  const auto size = 3 * static_cast<Eigen::Index>(map.poses.size());
  std::vector<rex::MatrixEntry> H;
  Eigen::VectorXd b = Eigen::VectorXd::Zero(size);
  for (const MeasuredEdge& by : map.edges) {
    BothEnds ends;
    ends << map.poses[static_cast<std::size_t>(by.from)], map.poses[static_cast<std::size_t>(by.to)];
    Eigen::Matrix<double, 3, 6> J;
    for (int k = 0; k < 6; ++k) {
      constexpr double kStep = 1e-6;
      const BothEnds change = kStep * BothEnds::Unit(k);
      Eigen::Vector3d d = errorBetween(ends + change, by.motion) - errorBetween(ends - change, by.motion);
      d[2] = byTurns(d[2]);
      J.col(k) = d / (2 * kStep);
    }
    const Eigen::Matrix<double, 6, 6> block = J.transpose() * by.information * J;
    const BothEnds slope = J.transpose() * by.information * errorBetween(ends, by.motion);
    const auto number = [&](int k) { return k < 3 ? 3 * by.from + k : 3 * by.to + k - 3; };
    for (int row = 0; row < 6; ++row) {
      b[number(row)] += slope[row];
      for (int column = 0; column < 6; ++column)
        if (number(row) > 2 && number(column) > 2)
          H.push_back({number(row) - 3, number(column) - 3, block(row, column)});
    }
  }
  for (int k = 0; k < size - 3; ++k) H.push_back({k, k, damping});
  Eigen::VectorXd step = Eigen::VectorXd::Zero(size);
  step.tail(size - 3) = rex::solveSparse(H, -b.tail(size - 3));
  return step;
}

inline PoseMap stepped(PoseMap map, const Eigen::VectorXd& by) {
  Eigen::Index at = 0;
  for (Eigen::Vector3d& pose : map.poses) pose += by.segment<3>(3 * at++);
  return map;
}

/// Whether a step without damping makes the cost rise before it is near the least.
inline bool goesAstray(PoseMap map, double least) {
  double cost = trueCost(map);
  for (int k = 0; k < 15; ++k) {
    map = stepped(map, dampedStep(map, 1e-9));
    const double before = cost;
    cost = trueCost(map);
    if (before < 1.01 * least) return false;
    if (cost > 1.001 * before) return true;
  }
  return false;
}

/// How Levenberg and Marquardt's damping changes: divided by `down` after a step that lowers the cost, none
/// below `floor`, and multiplied by `up` in place of one that does not.
struct Damping {
  double start = 1, up = 10, down = 10, floor = 1e-9;
};

/// Whether such steps find the least cost, in 100 trials.
inline bool findsTheLeast(PoseMap map, double least, const Damping& rule) {
  double cost = trueCost(map), damping = rule.start;
  for (int trial = 0; trial < 100 && cost > least * (1 + 1e-7); ++trial) {
    const PoseMap next = stepped(map, dampedStep(map, damping));
    const double after = trueCost(next);
    if (after < cost) {
      map = next;
      cost = after;
      damping = damping / rule.down < rule.floor ? 0 : damping / rule.down;
    } else {
      damping = std::max(rule.floor, rule.up * damping);
    }
  }
  return cost <= least * (1 + 1e-7);
}

/// Any reasonable way of damping finds the least cost.
inline bool isWithinReach(const PoseMap& map, double least) {
  constexpr Damping kRules[] = {{1e-4, 8, 5, 1e-9},   {1, 10, 10, 1e-9}, {1e4, 3, 3, 1e-9},
                                {1e-3, 10, 10, 1e-9}, {10, 2, 3, 1e-9},  {0, 8, 4, 1}};
  for (const Damping& rule : kRules)
    if (!findsTheLeast(map, least, rule)) return false;
  return true;
}

/// A walk, and its map with poses far away. Positions are measured ten times as well as headings, so that
/// plain steps turn poses too far.
inline PoseMap mapFarAway(rex::Rng& rng, StreetWalk& walk) {
  for (;;) {
    walk = streetWalk(rng, 50, 0.05);
    const Eigen::Vector3d deviations(0.01, 0.01, 0.1);
    for (MeasuredEdge& edge : walk.map.edges) {
      const Eigen::Vector3d e = deviations.cwiseProduct(rng.normalVector(3));
      edge.motion = onward(relative(walk.truth[static_cast<std::size_t>(edge.from)],
                                    walk.truth[static_cast<std::size_t>(edge.to)]),
                           e);
      edge.information = deviations.cwiseAbs2().cwiseInverse().asDiagonal();
    }
    walk.map.poses = odometryOf(walk.map);
    PoseMap map = walk.map;
    map.poses = walk.truth;
    for (std::size_t k = 1; k < map.poses.size(); ++k)
      map.poses[k] += Eigen::Vector3d(rng.normal(), rng.normal(), 0.5 * rng.normal());
    const double least = trueCost({bestPoses(walk.map), walk.map.edges});
    if (goesAstray(map, least) && isWithinReach(map, least)) return map;
  }
}
