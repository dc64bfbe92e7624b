#include "locomotion/footsteps.h"

#include <algorithm>
#include <limits>
#include <vector>

#include <fmt/format.h>

#include "base/error.h"
#include "base/require.h"

namespace rex {
namespace {

using Eigen::Vector2d;

// A hull thinner than this share of its length counts as a line: feet placed by kinematics have rounding
// errors.
constexpr double kFlat = 1e-9;

double cross(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

// The hull by Andrew's chain of left turns. convexHull() of geometry works on single precision, in space.
std::vector<Vector2d> hull(std::vector<Vector2d> points) {
  std::sort(points.begin(), points.end(), [](const Vector2d& a, const Vector2d& b) {
    return a.x() != b.x() ? a.x() < b.x() : a.y() < b.y();
  });
  points.erase(std::unique(points.begin(), points.end()), points.end());
  if (points.size() < 3) return points;
  std::vector<Vector2d> chain;
  for (int way = 0; way < 2; ++way) {
    const std::size_t start = chain.size();
    for (const Vector2d& p : points) {
      while (chain.size() >= start + 2 &&
             cross(chain.back() - chain[chain.size() - 2], p - chain.back()) <= 0)
        chain.pop_back();
      chain.push_back(p);
    }
    chain.pop_back();  // it begins the other way
    std::reverse(points.begin(), points.end());
  }
  return chain;
}

// Rounding leaves corners that coincide, or lie on the line between their neighbours. They are removed one by
// one, since two that coincide on a line only turn out to lie on it when one of them is gone.
std::vector<Vector2d> withoutCornersBetween(std::vector<Vector2d> corners, double size) {
  std::size_t good = 0;  // in a row
  for (std::size_t i = 0; good < corners.size() && corners.size() > 3;) {
    const std::size_t n = corners.size();
    const Vector2d in = corners[i] - corners[(i + n - 1) % n], out = corners[(i + 1) % n] - corners[i];
    const bool turns = in.dot(out) < 0 || cross(in, out) > kFlat * in.norm() * out.norm();
    if (turns && in.norm() > kFlat * size) {
      ++good;
      i = (i + 1) % n;
    } else {
      good = 0;
      corners.erase(corners.begin() + static_cast<std::ptrdiff_t>(i));
      i = (i + n - 1) % n % corners.size();
    }
  }
  return corners;
}

double areaOf(const std::vector<Vector2d>& corners) {
  double sum = 0;
  for (std::size_t i = 2; i < corners.size(); ++i)
    sum += cross(corners[i - 1] - corners[0], corners[i] - corners[0]) / 2;
  return sum;
}

// The two corners farthest apart.
std::pair<Vector2d, Vector2d> diameter(const std::vector<Vector2d>& corners) {
  std::pair<Vector2d, Vector2d> best{corners[0], corners[0]};
  for (const Vector2d& a : corners)
    for (const Vector2d& b : corners)
      if ((b - a).squaredNorm() > (best.second - best.first).squaredNorm()) best = {a, b};
  return best;
}

SupportPolygon made(SupportShape shape, const std::vector<Vector2d>& corners, double area,
                    std::string message) {
  SupportPolygon support{.shape = shape, .corners = {}, .area = area, .message = std::move(message)};
  support.corners.resize(2, static_cast<Eigen::Index>(corners.size()));
  for (Eigen::Index i = 0; i < support.corners.cols(); ++i)
    support.corners.col(i) = corners[static_cast<std::size_t>(i)];
  return support;
}

Vector2d nearestOnSegment(const Vector2d& a, const Vector2d& b, const Vector2d& p) {
  const double length = (b - a).squaredNorm();
  const double share = length > 0 ? std::clamp((p - a).dot(b - a) / length, 0., 1.) : 0;
  return a + share * (b - a);
}

}  // namespace

SupportPolygon supportPolygon(const Eigen::Ref<const Eigen::Matrix2Xd>& contacts) {
  std::vector<Vector2d> points;
  for (const auto& contact : contacts.colwise()) {
    requireFinite("support polygon: contact", contact);
    points.emplace_back(contact);
  }
  if (points.empty()) return {.message = "no support: there is no contact"};
  const std::vector<Vector2d> corners = hull(std::move(points));
  if (corners.size() == 1)
    return made(SupportShape::kPoint, corners, 0, "all contacts are at one point: the support has no area");
  const auto [a, b] = diameter(corners);
  double width = 0;
  for (const Vector2d& p : corners) width = std::max(width, std::abs(cross(b - a, p - a)));
  if (width <= kFlat * (b - a).squaredNorm())
    return made(SupportShape::kLine, {a, b}, 0, "all contacts lie on one line: the support has no area");
  const std::vector<Vector2d> few = withoutCornersBetween(corners, (b - a).norm());
  return made(SupportShape::kPolygon, few, areaOf(few), "");
}

SupportMargin supportMargin(const SupportPolygon& support, const Vector2d& point, double wantedMargin) {
  requireFinite("support margin: point", point);
  requireNotNegative("support margin: wanted margin", wantedMargin);
  SupportMargin result{.margin = -std::numeric_limits<double>::infinity(), .message = support.message};
  const Eigen::Index count = support.corners.cols();
  bool isLeft = support.shape == SupportShape::kPolygon;
  double least = std::numeric_limits<double>::infinity();
  for (Eigen::Index i = 0; i < count; ++i) {
    const Vector2d a = support.corners.col(i), b = support.corners.col((i + 1) % count);
    const Vector2d nearest = nearestOnSegment(a, b, point);
    isLeft = isLeft && cross(b - a, point - a) >= 0;
    if (const double distance = (point - nearest).norm(); distance < least) {
      least = distance;
      result.nearest = nearest;
    }
  }
  if (count > 0) result.margin = isLeft ? least : -least;
  if (support.shape != SupportShape::kPolygon) return result;
  result.isInside = isLeft && result.margin >= wantedMargin;
  result.message = fmt::format("{} by {:.6g} m", isLeft ? "inside" : "outside", least);
  if (isLeft && !result.isInside) result.message += fmt::format(", wanted {:.6g} m", wantedMargin);
  return result;
}

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

SupportPolygon supportPolygon(const WalkPhase& phase, const Sole& sole) {
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
