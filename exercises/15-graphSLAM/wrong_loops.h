#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "graph_checks.h"
#include "map_evidence.h"

// Part 6: walks with loops that are wrong.

/// A motion's error: metres, radians.
inline std::pair<double, double> missOf(const Eigen::Vector3d& got, const Eigen::Vector3d& wanted) {
  return {std::hypot(got[0] - wanted[0], got[1] - wanted[1]), std::abs(byTurns(got[2] - wanted[2]))};
}

/// Wrong loops join poses that are metres apart, as if they were one place. Neither measurements nor indices
/// of poses give them away: they have the same rotations and noise as right ones, and span the same numbers
/// of steps, because a walk comes by again after 20, 30, 40, ... of them.
inline void addWrongLoops(rex::Rng& rng, StreetWalk& walk, double share) {
  std::vector<MeasuredEdge> right;
  for (const MeasuredEdge& edge : walk.map.edges)
    if (edge.isLoop) right.push_back(edge);
  const auto loops = static_cast<int>(right.size()), poses = static_cast<int>(walk.truth.size());
  const auto truth = [&](int k) { return walk.truth[static_cast<std::size_t>(k)]; };
  const int count = std::max(1, static_cast<int>(share / (1 - share) * loops));
  for (int k = 0; k < count;) {
    const int i = rng.index(poses), j = rng.index(poses);
    if (std::abs(i - j) < 20 || (i - j) % 10 != 0 || missOf(truth(i), truth(j)).first < 3) continue;
    const MeasuredEdge& like = right[static_cast<std::size_t>(rng.index(loops))];
    const Eigen::Vector3d turn(0, 0, truth(like.to)[2] - truth(like.from)[2]),
        deviations = like.information.diagonal().cwiseInverse().cwiseSqrt();
    walk.map.edges.push_back(
        {i, j, onward(turn, deviations.cwiseProduct(rng.normalVector(3))), like.information, true});
    ++k;
  }
  // The position of an edge in the list does not show whether it is right.
  std::vector<MeasuredEdge> edges, mixed;
  for (const MeasuredEdge& edge : walk.map.edges) (edge.isLoop ? mixed : edges).push_back(edge);
  for (std::size_t k = mixed.size(); k > 1; --k)
    std::swap(mixed[k - 1], mixed[static_cast<std::size_t>(rng.index(static_cast<int>(k)))]);
  edges.insert(edges.end(), mixed.begin(), mixed.end());
  walk.map.edges = std::move(edges);
}

/// Whether odometry drifts so far that no bound on the distance between the ends of a loop keeps the right
/// loops and drops the wrong ones.
inline bool isBeyondOdometry(const StreetWalk& walk, const Poses& best) {
  return std::ranges::none_of(std::array{2., 3., 4.5}, [&](double bound) {
    PoseMap near = walk.map;
    std::erase_if(near.edges, [&](const MeasuredEdge& edge) {
      const auto pose = [&](int k) { return walk.map.poses[static_cast<std::size_t>(k)]; };
      return edge.isLoop && missOf(pose(edge.from), pose(edge.to)).first > bound;
    });
    return apart(bestPoses(near), best) < 0.1;
  });
}

/// A walk with wrong loops, and its poses without them.
struct Misled {
  StreetWalk walk;
  Poses best;
};

inline Misled misledWalk(rex::Rng& rng, double noise, double share) {
  for (;;) {
    StreetWalk walk = streetWalk(rng, 120, noise);
    const Poses best = bestPoses(walk.map);
    addWrongLoops(rng, walk, share);
    if (isBeyondOdometry(walk, best)) return {walk, best};
  }
}

/// What could have led to wrong poses, if anything.
inline std::string questionAboutLoops(const JudgedWalk& judged) {
  const PoseMap& map = judged.walk.map;
  if (apart(judged.got, map.poses) < 1e-6) return "Do the poses stay as odometry has them?";
  // A few steps from there change nothing.
  const auto isBestOf = [&](const PoseMap& edges) {
    rex::PlanarPoseGraph graph = graphOf({judged.got, edges.edges});
    rex::optimize(graph, {.chordalStart = false, .maxIterations = 3});
    return (graph.poses - graphOf({judged.got, {}}).poses).topRows(2).lpNorm<Eigen::Infinity>() < 0.01;
  };
  if (isBestOf(map)) return "Are all loops trusted? A wrong one should count for little.";
  for (const double bound : {1., 1.5, 2., 3., 4., 5., 6.}) {
    PoseMap near = map;
    std::erase_if(near.edges, [&](const MeasuredEdge& edge) {
      const auto pose = [&](int k) { return map.poses[static_cast<std::size_t>(k)]; };
      return edge.isLoop && missOf(pose(edge.from), pose(edge.to)).first > bound;
    });
    if (isBestOf(near))
      return "Are loops dropped if their ends are far apart by odometry? It drifts so far that right ones "
             "are lost.";
  }
  return "";
}
