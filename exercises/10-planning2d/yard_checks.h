#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>
#include <vector>

#include "drawing.h"
#include "exercise.h"
#include "grading/check.h"
#include "grading/evidence_parts.h"
#include "interface.h"
#include "maps.h"
#include "render/figure_builders.h"

// The checks of parts 3 and 4: yards, potentials and roadmaps in them.

inline Eigen::Vector2d randomPlace(const Yard& yard, rex::Rng& rng) {
  return {rng.uniform(0, yard.size.x()), rng.uniform(0, yard.size.y())};
}

inline Eigen::Vector2d randomFreePlace(const Yard& yard, rex::Rng& rng) {
  while (true) {
    const Eigen::Vector2d p = randomPlace(yard, rng);
    if (isFree(yard, p)) return p;
  }
}

// Blocks with corners on a grid of that spacing: gaps between them are at least that wide.
inline Yard randomYard(rex::Rng& rng, const Eigen::Vector2d& size, int blocks, double raster) {
  Yard yard{.size = size, .blocks = {}};
  const auto corner = [&](double length) { return raster * rng.index(static_cast<int>(length / raster)); };
  for (int i = 0; i < blocks; ++i) {
    const Eigen::Vector2d lower(corner(size.x()), corner(size.y()));
    yard.blocks.push_back({lower, lower + raster * Eigen::Vector2d(1 + rng.index(3), 1 + rng.index(3))});
  }
  return yard;
}

// The length of the part of the straight way from a to b that lies in a block (or touches it): zero at least,
// negative if there is none.
inline double lengthIn(const Block& block, const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  double first = 0, last = 1;
  for (int i = 0; i < 2; ++i) {
    const double way = b[i] - a[i];
    if (way == 0) {
      if (a[i] < block.lower[i] || a[i] > block.upper[i]) return -1;
      continue;
    }
    const double one = (block.lower[i] - a[i]) / way, other = (block.upper[i] - a[i]) / way;
    first = std::max(first, std::min(one, other));
    last = std::min(last, std::max(one, other));
  }
  return first > last ? -1 : (last - first) * (b - a).norm();
}

// What a straight way between free positions is: blocked, if points at that spacing must hit a block; free,
// if it keeps off all blocks; otherwise either answer is accepted.
enum class Straight { kFree, kEither, kBlocked };
inline Straight judged(const Yard& yard, const Eigen::Vector2d& a, const Eigen::Vector2d& b,
                       double resolution) {
  Straight result = Straight::kFree;
  for (const auto& [lower, upper] : yard.blocks) {
    const Eigen::Vector2d rim = Eigen::Vector2d::Constant(1e-9);
    const double length = lengthIn({lower - rim, upper + rim}, a, b);
    if (length > resolution * (1 + 1e-6) + 1e-8) return Straight::kBlocked;
    if (length >= 0) result = Straight::kEither;
  }
  return result;
}

// U of part 3, and its gradient by differences.
inline double trueU(const Yard& yard, const Eigen::Vector2d& goal, const FieldGains& gains,
                    const Eigen::Vector2d& p) {
  double U = gains.attraction / 2 * (p - goal).squaredNorm();
  for (const Block& pusher : yard.blocks) {
    const double nearness = 1 / (nearestPoint(pusher, p) - p).norm() - 1 / gains.reach;
    if (nearness > 0) U += gains.repulsion * nearness * nearness / 2;
  }
  return U;
}

inline Eigen::Vector2d trueGradient(const Yard& yard, const Eigen::Vector2d& goal, const FieldGains& gains,
                                    const Eigen::Vector2d& p) {
  const double h = 1e-5;
  const auto U = [&](double dx, double dy) { return trueU(yard, goal, gains, p + Eigen::Vector2d(dx, dy)); };
  return {(U(h, 0) - U(-h, 0)) / (2 * h), (U(0, h) - U(0, -h)) / (2 * h)};
}

// Whether p is farther than `distance` from all blocks.
inline bool isClear(const Yard& yard, const Eigen::Vector2d& p, double distance) {
  return std::all_of(yard.blocks.begin(), yard.blocks.end(),
                     [&](const Block& block) { return (p - nearestPoint(block, p)).norm() > distance; });
}

struct Slide {
  Yard yard;
  Eigen::Vector2d goal;
  FieldGains gains;
  Eigen::Vector2d start;
  double stepSize = 0.05;
};

// Whether U rises above its value at the start on every way to the goal, so that a descent gets stuck.
// Blocks stand on a grid of 0.5 m, and ways between them are searched on one of 0.1 m.
inline bool isCutOff(const Slide& slide) {
  const double h = 0.1, margin = 2;
  const auto columns = static_cast<int>((slide.yard.size.x() + 2 * margin) / h) + 1,
             rows = static_cast<int>((slide.yard.size.y() + 2 * margin) / h) + 1;
  const auto placeOf = [&](const Eigen::Vector2d& p) {
    return MapCell{static_cast<int>(std::lround((p.x() + margin) / h)),
                   static_cast<int>(std::lround((p.y() + margin) / h))};
  };
  CellMap below{.width = columns, .height = rows, .blocked = {}};
  const double level = trueU(slide.yard, slide.goal, slide.gains, slide.start) * 1.1;
  for (int y = 0; y < rows; ++y)
    for (int x = 0; x < columns; ++x) {
      const Eigen::Vector2d p(h * x - margin, h * y - margin);
      below.blocked.push_back(trueU(slide.yard, slide.goal, slide.gains, p) <= level ? 0 : 1);
    }
  std::vector<MapCell> open{placeOf(slide.start)};
  while (!open.empty()) {
    const MapCell at = open.back();
    open.pop_back();
    if (!below.isFree(at)) continue;
    if (at == placeOf(slide.goal)) return false;
    below.blocked[below.placeOf(at)] = 1;
    for (int y = at.y - 1; y <= at.y + 1; ++y)
      for (int x = at.x - 1; x <= at.x + 1; ++x) open.push_back({x, y});
  }
  return true;
}

// Whether the goal is reached with a margin: also from positions around the start and with other step
// sizes, and the field is nearly level nowhere on the way.
inline bool isEasy(const Slide& slide) {
  for (int i = 0; i < 5; ++i) {
    const Eigen::Vector2d aside(i == 1 ? 0.2 : i == 2 ? -0.2 : 0, i == 3 ? 0.2 : i == 4 ? -0.2 : 0);
    Eigen::Vector2d p = slide.start + aside;
    for (int step = 0; (p - slide.goal).norm() > slide.stepSize; ++step) {
      const Eigen::Vector2d gradient = trueGradient(slide.yard, slide.goal, slide.gains, p);
      const double distance = (p - slide.goal).norm();
      if (!gradient.allFinite() || gradient.norm() < 0.3 * slide.gains.attraction * distance || step > 1000)
        return false;
      p -= std::min(slide.stepSize, 0.02) * gradient.normalized();
    }
  }
  return true;
}

inline FieldGains randomGains(rex::Rng& rng) {
  return {rng.uniform(0.5, 2), rng.uniform(0.05, 0.5), rng.uniform(0.4, 1.2)};
}

// A block with two arms, open to any of four sides, with the start between the arms and the goal behind the
// block, among other blocks.
inline Slide randomTrap(rex::Rng& rng) {
  while (true) {
    Slide slide{randomYard(rng, {8, 8}, 3, 0.5), {}, randomGains(rng), {}};
    const double width = 1 + 0.5 * rng.index(2), arm = 1 + 0.5 * rng.index(2);
    std::vector<Eigen::Vector2d> places{{4, 3 - width},
                                        {4.5, 5 + width},
                                        {4 - arm, 3 - width},
                                        {4, 4 - width},
                                        {4 - arm, 4 + width},
                                        {4, 5 + width},
                                        {4 - rng.uniform(0.4, 0.8), rng.uniform(3.6, 4.4)},
                                        {4.5 + rng.uniform(1, 2), rng.uniform(3.5, 4.5)}};
    const bool isMirrored = rng.index(2) == 0, isTurned = rng.index(2) == 0;
    for (Eigen::Vector2d& p : places) {
      if (isMirrored) p.x() = 8 - p.x();
      if (isTurned) p = {p.y(), p.x()};
    }
    for (std::size_t i = 0; i < 6; i += 2)
      slide.yard.blocks.push_back({places[i].cwiseMin(places[i + 1]), places[i].cwiseMax(places[i + 1])});
    slide.start = places[6];
    slide.goal = places[7];
    if (isFree(slide.yard, slide.start) && isClear(slide.yard, slide.goal, slide.gains.reach) &&
        isCutOff(slide))
      return slide;
  }
}

// A goal in sight, and a block near the straight way to it.
inline Slide randomPass(rex::Rng& rng) {
  while (true) {
    Slide slide{randomYard(rng, {8, 8}, 5, 0.5), {}, randomGains(rng), {}};
    slide.goal = randomFreePlace(slide.yard, rng);
    slide.start = randomFreePlace(slide.yard, rng);
    const bool isFar = (slide.goal - slide.start).norm() > 3;
    const bool isNear = !isClear(slide.yard, (slide.start + slide.goal) / 2, slide.gains.reach);
    if (isFar && isNear && isClear(slide.yard, slide.start, 0.3) &&
        isClear(slide.yard, slide.goal, slide.gains.reach) && isEasy(slide))
      return slide;
  }
}

// A slide down a field, over the directions in which the field pulls.
inline rex::grading::Evidence slideSeen(const Slide& slide, const FieldTrail& trail, Ending wanted) {
  const auto& [yard, goal, gains, start, stepSize] = slide;
  rex::Figure figure =
      planOf(wanted == Ending::kAtGoal ? "Down the field; wanted: it ends at the goal"
                                       : "Down the field; wanted: it ends in the trap, and says so",
             yard.size, yard.blocks);
  const auto pull = [&](const Eigen::Vector2d& p) -> Eigen::Vector2d {
    const Eigen::Vector2d down = -trueGradient(yard, goal, gains, p);
    return isFree(yard, p) && down.allFinite() ? down : Eigen::Vector2d::Zero();
  };
  figure.arrows = {rex::arrowsOf(pull, {0, yard.size.x()}, {0, yard.size.y()})};
  const auto end = std::find_if(trail.points.begin(), trail.points.end(),
                                [](const Eigen::Vector2d& p) { return !p.allFinite(); });
  addLine(figure, {trail.points.begin(), end},
          rex::grading::gotCurve(trail.ending == Ending::kAtGoal ? "got: ends at the goal" : "got: stuck"));
  addEnds(figure, start, goal);
  const auto U = [&](std::size_t i) { return trueU(yard, goal, gains, trail.points[i]); };
  for (std::size_t i = 1; i < trail.points.size(); ++i)
    if (trail.points[i].allFinite() && !(U(i) < U(i - 1))) {
      figure.series.push_back(
          rex::grading::wrongPoint("not lower than before", trail.points[i].x(), trail.points[i].y()));
      break;
    }
  return {.figures = {figure}};
}

inline void slides(rex::grading::Check& check, Student& student, const Slide& slide, Ending wanted) {
  const auto& [yard, goal, gains, start, stepSize] = slide;
  const FieldTrail trail = student.slideDown.asItIs()(yard, goal, gains, start, stepSize);
  const auto shown = check.show([&] { return slideSeen(slide, trail, wanted); });
  check.that("the trail begins at the start", !trail.points.empty() && trail.points.front() == start);
  for (std::size_t i = 1; i < trail.points.size(); ++i) {
    const Eigen::Vector2d &from = trail.points[i - 1], &to = trail.points[i];
    check.atMost("length of a step", (to - from).norm(), stepSize * (1 + 1e-9), "m");
    check.that("each point is lower than the one before",
               trueU(yard, goal, gains, to) < trueU(yard, goal, gains, from));
  }
  const Eigen::Vector2d end = trail.points.back();
  if (wanted == Ending::kAtGoal) {
    check.that("no local minimum is in the way, and it ends at the goal", trail.ending == Ending::kAtGoal);
    check.atMost("distance from the goal at the end", (end - goal).norm(), stepSize * (1 + 1e-9), "m");
  } else {
    check.that("a local minimum is in the way, and it ends stuck", trail.ending == Ending::kStuck);
    check.atMost("length of the gradient at the end", trueGradient(yard, goal, gains, end).norm(),
                 0.0101 * gains.attraction, "N");
  }
}

// The k nodes nearest to q, leaving out node `self`.
inline std::vector<std::size_t> nearestTo(const std::vector<Eigen::Vector2d>& nodes, const Eigen::Vector2d& q,
                                          int k, std::size_t self) {
  std::vector<std::pair<double, std::size_t>> order;
  for (std::size_t i = 0; i < nodes.size(); ++i)
    if (i != self) order.emplace_back((nodes[i] - q).norm(), i);
  std::sort(order.begin(), order.end());
  order.resize(std::min(order.size(), static_cast<std::size_t>(k)));
  std::vector<std::size_t> nearest;
  for (const auto& [distance, i] : order) nearest.push_back(i);
  return nearest;
}

// The roadmap that joinNearest() asks for; `with` says what to do with ways for which either answer is
// accepted.
inline Network roadmapOf(const Yard& yard, const std::vector<Eigen::Vector2d>& nodes, int k,
                         double resolution, Straight with) {
  std::set<std::pair<std::size_t, std::size_t>> pairs;
  for (std::size_t i = 0; i < nodes.size(); ++i)
    for (const std::size_t j : nearestTo(nodes, nodes[i], k, i)) {
      const Straight way = judged(yard, nodes[i], nodes[j], resolution);
      if (way == Straight::kFree || way == with) pairs.insert({std::min(i, j), std::max(i, j)});
    }
  Network network(nodes.size());
  for (const auto& [i, j] : pairs) {
    network[i].push_back({j, (nodes[i] - nodes[j]).norm()});
    network[j].push_back({i, (nodes[i] - nodes[j]).norm()});
  }
  return network;
}

inline bool hasArc(const Network& network, std::size_t from, std::size_t to) {
  return std::any_of(network[from].begin(), network[from].end(),
                     [&](const Arc& arc) { return arc.to == to; });
}

// Checks that no necessary arc is missing, and that there are no others than the possible ones.
inline void isRoadmap(rex::grading::Check& check, const Yard& yard, const std::vector<Eigen::Vector2d>& nodes,
                      int k, double resolution, const Network& got) {
  const Network all = roadmapOf(yard, nodes, k, resolution, Straight::kEither),
                least = roadmapOf(yard, nodes, k, resolution, Straight::kFree);
  check.that("there is a list of arcs for each node", got.size() == nodes.size());
  for (std::size_t i = 0; i < got.size(); ++i) {
    std::set<std::size_t> ends;
    for (const auto& [to, length] : got[i]) {
      check.that("every arc leads to a node", to < nodes.size());
      check.that("no arc is there twice", ends.insert(to).second);
      check.that("every arc has one that leads back", hasArc(got, to, i));
      check.that("arcs lead only along free ways to one of the k nearest nodes", hasArc(all, i, to));
      check.near("length of an arc", length, (nodes[i] - nodes[to]).norm(), 1e-9, "m");
    }
    for (const Arc& arc : least[i])
      check.that("all free ways to the k nearest nodes have arcs", hasArc(got, i, arc.to));
  }
}
