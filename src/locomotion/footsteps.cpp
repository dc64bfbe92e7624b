#include "locomotion/footsteps.h"

#include <algorithm>

#include <fmt/format.h>

#include "base/error.h"
#include "base/require.h"

namespace rex {
namespace {

using Eigen::Vector2d;

constexpr double kMostColumns = 1e6;

void requirePlan(const WalkPlan& plan) {
  if (plan.footsteps.size() < 2)
    throw Error({.what = "walk: footsteps",
                 .found = fmt::format("{}", plan.footsteps.size()),
                 .wanted = "two to stand on at first, and one for each step"});
  for (std::size_t i = 0; i < plan.footsteps.size(); ++i) {
    const Footstep& step = plan.footsteps[i];
    requireFinite(fmt::format("walk: footstep {}: p", i), step.p);
    requireFinite(fmt::format("walk: footstep {}: yaw", i), step.yaw);
    if (i > 0 && step.side == plan.footsteps[i - 1].side)
      throw Error({.what = fmt::format("walk: footstep {}", i),
                   .found = "the same side as before",
                   .wanted = "left and right in turn"});
  }
  requirePositive("walk: length of the sole", plan.sole.length);
  requirePositive("walk: width of the sole", plan.sole.width);
  requirePositive("walk: time of double support", plan.doubleSupport);
  requirePositive("walk: time of single support", plan.singleSupport);
  requirePositive("walk: time of rest", plan.rest);
}

double durationOf(const WalkPlan& plan) {
  const double steps = static_cast<double>(plan.footsteps.size() - 2);
  return 2 * plan.rest + plan.doubleSupport + steps * (plan.doubleSupport + plan.singleSupport);
}

// Standing on footsteps i and i + 1.
WalkPhase standing(const WalkPlan& plan, std::size_t i) {
  const Footstep &a = plan.footsteps[i], &b = plan.footsteps[i + 1];
  const bool isLeftFirst = a.side == Side::kLeft;
  return {.left = isLeftFirst ? a : b, .right = isLeftFirst ? b : a, .zmp = (a.p + b.p) / 2};
}

WalkPhase phaseOf(const WalkPlan& plan, double t) {
  const std::vector<Footstep>& feet = plan.footsteps;
  const std::size_t last = feet.size() - 2;  // steps, and the phase after them
  const double period = plan.doubleSupport + plan.singleSupport, walked = t - plan.rest;
  if (walked < 0) {
    WalkPhase phase = standing(plan, 0);
    phase.share = std::max(t / plan.rest, 0.);
    return phase;
  }
  const std::size_t step = std::min(static_cast<std::size_t>(std::min(walked / period, 1e9)), last);
  const double into = walked - static_cast<double>(step) * period;
  WalkPhase phase = standing(plan, step);
  if (into < plan.doubleSupport) {
    phase.share = into / plan.doubleSupport;
    const Vector2d from = step == 0 ? phase.zmp : feet[step].p,
                   to = step == last ? phase.zmp : feet[step + 1].p;
    phase.zmp = from + phase.share * (to - from);
  } else if (step < last) {
    phase.share = (into - plan.doubleSupport) / plan.singleSupport;
    phase.swing = feet[step + 2];
    phase.zmp = feet[step + 1].p;
  } else {
    phase.share = std::min((into - plan.doubleSupport) / plan.rest, 1.);
  }
  return phase;
}

void addCorners(const Footstep& foot, const Sole& sole, Eigen::Matrix2Xd& corners) {
  const Vector2d along(std::cos(foot.yaw), std::sin(foot.yaw)), across(-along.y(), along.x());
  for (const double x : {-sole.length / 2, sole.length / 2})
    for (const double y : {-sole.width / 2, sole.width / 2}) {
      corners.conservativeResize(2, corners.cols() + 1);
      corners.rightCols<1>() = foot.p + x * along + y * across;
    }
}

}  // namespace

std::vector<Footstep> straightFootsteps(int count, double length, double width) {
  requireCount("footsteps: count", count, 1);
  requireFinite("footsteps: length", length);
  requirePositive("footsteps: width", width);
  std::vector<Footstep> steps;
  for (int i = -2; i < count; ++i) {
    const Side side = i % 2 == 0 ? Side::kLeft : Side::kRight;
    const double x = length * std::clamp(i + 1, 0, count - 1);
    steps.push_back({.side = side, .p = {x, (side == Side::kLeft ? width : -width) / 2}});
  }
  return steps;
}

double duration(const WalkPlan& plan) {
  requirePlan(plan);
  return durationOf(plan);
}

WalkPhase phaseAt(const WalkPlan& plan, double t) {
  requirePlan(plan);
  requireFinite("walk: time t", t);
  return phaseOf(plan, t);
}

SupportPolygon supportOf(const WalkPhase& phase, const Sole& sole) {
  Eigen::Matrix2Xd corners(2, 0);
  for (const Footstep& foot : {phase.left, phase.right})
    if (!phase.swing || phase.swing->side != foot.side) addCorners(foot, sole, corners);
  return supportPolygon(corners);
}

Eigen::Matrix2Xd zmpReference(const WalkPlan& plan, double step) {
  requirePlan(plan);
  requirePositive("walk: time step", step);
  const double count = std::floor(durationOf(plan) / step + 1e-9) + 1;
  if (count > kMostColumns)
    throw Error({.what = "walk: time step",
                 .found = fmt::format("{:g} columns", count),
                 .wanted = fmt::format("at most {:g}", kMostColumns)});
  Eigen::Matrix2Xd reference(2, static_cast<Eigen::Index>(count));
  for (Eigen::Index k = 0; k < reference.cols(); ++k)
    reference.col(k) = phaseOf(plan, static_cast<double>(k) * step).zmp;
  return reference;
}

}  // namespace rex
