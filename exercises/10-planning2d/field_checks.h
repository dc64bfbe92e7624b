#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "drawing.h"
#include "exercise.h"
#include "grading/check.h"
#include "grading/evidence.h"
#include "interface.h"
#include "render/figure_builders.h"
#include "yard_checks.h"

// The checks of part 3: potentials in yards.

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

inline void describe(rex::grading::Check& check, const Yard& yard, const Eigen::Vector2d& goal,
                     const FieldGains& gains, const Eigen::Vector2d& p) {
  check.input("a yard", {{"p", p},
                         {"goal", goal},
                         {"k", gains.attraction},
                         {"eta", gains.repulsion},
                         {"rho", gains.reach},
                         {"blocks, from x, y to x, y", cornersOf(yard)}});
}

inline void potentialFits(rex::grading::Check& check, Student& student, const Yard& yard,
                          const Eigen::Vector2d& goal, const FieldGains& gains, const Eigen::Vector2d& p) {
  describe(check, yard, goal, gains, p);
  const double U = trueU(yard, goal, gains, p);
  check.near("fieldPotential", student.fieldPotential(yard, goal, gains, p), U, 1e-9 * (1 + U), "J");
}

inline void gradientFits(rex::grading::Check& check, Student& student, const Yard& yard,
                         const Eigen::Vector2d& goal, const FieldGains& gains, const Eigen::Vector2d& p) {
  describe(check, yard, goal, gains, p);
  const Eigen::Vector2d wanted = trueGradient(yard, goal, gains, p);
  const Eigen::Vector2d got = student.fieldGradient(yard, goal, gains, p);
  const Eigen::Vector2d pull = gains.attraction * (p - goal), push = wanted - pull;
  const double part = push.dot(got - pull) / push.squaredNorm();
  const auto limited =
      check.ask("Is the push of a block limited near it? It grows without bound.",
                0 < part && part < 1 && (got - pull - part * push).norm() < 1e-3 * push.norm());
  check.near("fieldGradient", got, wanted, 1e-4 * (1 + wanted.norm()), "N");
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
  figure.arrows = {rex::arrowField(pull, {0, yard.size.x()}, {0, yard.size.y()})};
  const auto end = std::find_if(trail.points.begin(), trail.points.end(),
                                [](const Eigen::Vector2d& p) { return !p.allFinite(); });
  addLine(figure, {trail.points.begin(), end},
          rex::grading::gotCurve(trail.ending == Ending::kAtGoal ? "got: ends at the goal" : "got: stuck"));
  addEnds(figure, start, goal);
  const auto U = [&](std::size_t i) { return trueU(yard, goal, gains, trail.points[i]); };
  std::size_t last = 0;
  while (last + 1 < trail.points.size() && trail.points[last + 1].allFinite() && U(last + 1) < U(last))
    ++last;
  const bool isDown = last + 1 >= trail.points.size();
  const Eigen::Vector2d& at = trail.points[isDown ? last : last + 1];
  if (at.allFinite())
    figure.series.push_back(
        rex::grading::wrongPoint(isDown ? "ends here" : "not lower than before", at.x(), at.y()));
  return {.figures = {figure}};
}

// Steps lead down and are short enough.
inline void descends(rex::grading::Check& check, const Slide& slide, const FieldTrail& trail) {
  const auto& [yard, goal, gains, start, stepSize] = slide;
  const auto U = [&](std::size_t i) { return trueU(yard, goal, gains, trail.points[i]); };
  rex::grading::Signal lengths, changes;
  for (std::size_t i = 1; i < trail.points.size(); ++i) {
    lengths.add(static_cast<double>(i), (trail.points[i] - trail.points[i - 1]).norm());
    changes.add(static_cast<double>(i), U(i) - U(i - 1));
  }
  if (lengths.at.empty()) return;
  {
    const auto fixed = check.ask("Is the step halved until the potential decreases?");
    check.atMostAlong("change of the potential in a step of slideDown", changes, 0, "J");
    check.that("each point of slideDown is lower than the one before",
               std::all_of(changes.values.begin(), changes.values.end(),
                           [](const Eigen::VectorXd& change) { return change[0] < 0; }));
  }
  check.atMostAlong("length of a step of slideDown", lengths, stepSize * (1 + 1e-9), "m");
}

/// Returns the number of points.
inline std::size_t slides(rex::grading::Check& check, Student& student, const Slide& slide, Ending wanted) {
  const auto& [yard, goal, gains, start, stepSize] = slide;
  const FieldTrail trail = student.slideDown.asItIs()(yard, goal, gains, start, stepSize);
  check.atLeast("number of points of slideDown", static_cast<double>(trail.points.size()), 1);
  const auto shown = check.show([&] { return slideSeen(slide, trail, wanted); });
  check.near("first point of slideDown", trail.points.front(), start, 0, "m");
  descends(check, slide, trail);
  const Eigen::Vector2d end = trail.points.back();
  const double slope = trueGradient(yard, goal, gains, end).norm(), level = 0.0101 * gains.attraction;
  check.input(check.input(), {{"goal", goal}, {"last point", end}, {"length of the gradient there", slope}});
  if (wanted == Ending::kAtGoal) {
    check.that("slideDown ends with kAtGoal, since no local minimum is in the way",
               trail.ending == Ending::kAtGoal);
    check.atMost("distance of the last point of slideDown from the goal", (end - goal).norm(),
                 stepSize * (1 + 1e-9), "m");
  } else {
    const auto any = check.ask("Is every point where the gradient vanishes taken for the goal?",
                               trail.ending == Ending::kAtGoal && slope < level);
    check.that("slideDown ends with kStuck, since a local minimum is in the way",
               trail.ending == Ending::kStuck);
    check.atMost("length of the gradient at the last point of slideDown", slope, level, "N");
  }
  return trail.points.size();
}
