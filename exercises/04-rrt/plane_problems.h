#pragma once

#include <cmath>

#include "base/rng.h"
#include "exercise.h"
#include "plane_world.h"
#include "planning/rrt.h"

// Random worlds in the plane.

/// A planning problem in the plane.
struct PlaneProblem {
  PlaneWorld world;
  Eigen::VectorXd start, goal;
};

/// The same problem with x mirrored, or x and y swapped, or both.
inline PlaneProblem turned(const PlaneProblem& problem, bool mirror, bool swap) {
  const auto turn = [&](Eigen::Vector2d p) {
    if (mirror) p.x() = 1 - p.x();
    return swap ? Eigen::Vector2d(p.y(), p.x()) : p;
  };
  PlaneProblem other{{}, turn(problem.start), turn(problem.goal)};
  for (const PlaneDisc& disc : problem.world.discs)
    other.world.discs.push_back({turn(disc.center), disc.radius});
  for (const PlaneBox& box : problem.world.boxes) {
    const Eigen::Vector2d a = turn(box.lower), b = turn(box.upper);
    other.world.boxes.push_back({a.cwiseMin(b), a.cwiseMax(b)});
  }
  return other;
}

/// Two walls, thinner than a step, with gaps at opposite ends, and two discs. The straight line from start to
/// goal meets a wall at least 0.1 away from its gap.
inline PlaneProblem twoWalls(rex::Rng& rng) {
  const double first = rng.uniform(0.25, 0.38), second = rng.uniform(0.6, 0.73), gap = rng.uniform(0.2, 0.3);
  PlaneProblem problem{
      {.discs = {{{rng.uniform(0.45, 0.52), rng.uniform(0.4, 0.6)}, rng.uniform(0.03, 0.06)},
                 {{rng.uniform(0.82, 0.88), rng.uniform(0.35, 0.65)}, 0.05}},
       .boxes = {{{first, 0}, {first + 0.015, 1 - gap}}, {{second, gap}, {second + 0.015, 1}}}},
      {},
      {}};
  PlaneWorld wider{.discs = {}, .boxes = problem.world.boxes};
  wider.boxes[0].upper.y() -= 0.1;
  wider.boxes[1].lower.y() += 0.1;
  const EdgeTest hasRoom = freeIn(problem.world, -0.01), isNearlyFree = freeIn(wider);
  do {
    problem.start = Eigen::Vector2d(rng.uniform(0.05, 0.15), rng.uniform(0.05, 0.95));
    problem.goal = Eigen::Vector2d(rng.uniform(0.8, 0.95), rng.uniform(0.05, 0.95));
  } while (!hasRoom(problem.goal, problem.goal) || !hasRoom(problem.start, problem.start) ||
           isNearlyFree(problem.start, problem.goal));
  const int way = rng.index(4);
  return turned(problem, way % 2 == 1, way > 1);
}

/// One disc between start and goal, and the length of the shortest path around it: two tangents and the arc
/// between them.
struct DiscProblem {
  PlaneProblem problem;
  double shortest;
};

inline DiscProblem oneDisc(rex::Rng& rng) {
  const Eigen::Vector2d center(rng.uniform(0.47, 0.53), rng.uniform(0.47, 0.53));
  const double radius = rng.uniform(0.2, 0.28), angle = rng.uniform(0.1, 0.25);
  const Eigen::Vector2d start(rng.uniform(0.05, 0.12), center.y() - rng.uniform(0, 0.1));
  const Eigen::Vector2d goal(rng.uniform(0.88, 0.95), center.y() + angle);
  const Eigen::Vector2d a = start - center, b = goal - center;
  const double between = std::acos(a.dot(b) / (a.norm() * b.norm()));
  const double arc = between - std::acos(radius / a.norm()) - std::acos(radius / b.norm());
  const double lines =
      std::sqrt(a.squaredNorm() - radius * radius) + std::sqrt(b.squaredNorm() - radius * radius);
  const int way = rng.index(4);
  return {turned({{.discs = {{center, radius}}}, start, goal}, way % 2 == 1, way > 1), lines + radius * arc};
}

/// A jagged path, as trees make them, from the library, at a small distance from the obstacles.
inline Path jaggedPath(const PlaneProblem& problem, rex::Rng& rng) {
  const EdgeTest isFree = freeIn(problem.world, -0.004);
  const rex::PathProblem planned{
      .space = rex::Space::box(Eigen::Vector2d(0, 0), Eigen::Vector2d(1, 1)),
      .allValid = rex::eachColumn([&](const Eigen::VectorXd& q) { return isFree(q, q); }),
      .start = problem.start,
      .goal = problem.goal,
      .resolution = 0.002};
  rex::PathResult found;
  do found = rex::connectRrts(planned, {.stepSize = 0.05}, rng);
  while (found.status != rex::PathStatus::kFound);
  Path path;
  for (Eigen::Index i = 0; i < found.path.cols(); ++i) path.emplace_back(found.path.col(i));
  return path;
}
