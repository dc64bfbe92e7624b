#include "planning/path_spline.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/error.h"
#include "base/require_finite.h"
#include "planning/edge_checker.h"
#include "planning/spread_check_internal.h"

namespace rex {
namespace {

constexpr int kMostRounds = 8;  // of finer polygons: corners are then cut by 2^-8 of their sides

// Weights of four control points at the share s of a segment, and their derivatives by s.
Eigen::Vector4d weights(double s, int derivative) {
  const double r = 1 - s;
  if (derivative == 0)
    return Eigen::Vector4d(r * r * r, 4 - 6 * s * s + 3 * s * s * s, 4 - 6 * r * r + 3 * r * r * r,
                           s * s * s) /
           6;
  if (derivative == 1) return Eigen::Vector4d(-r * r, 3 * s * s - 4 * s, 4 * r - 3 * r * r, s * s) / 2;
  return {r, 3 * s - 2, 1 - 3 * s, s};
}

// A corner of the control polygon; the spline goes through those where it stops.
struct Corner {
  Eigen::VectorXd q;
  double place;  // in the path: between its configurations 1 and 2 for 1.5
  bool isStop = false;
};
using Polygon = std::vector<Corner>;

void requireSound(const PathProblem& problem, const MatrixArg& path, const MotionLimits& limits) {
  const Space& space = problem.space;
  requireSize("configurations of a path", path.rows(), space.size());
  if (path.cols() == 0) throw Error({.what = "path", .found = "no configurations", .wanted = "at least one"});
  for (const SpacePart& part : space.parts())
    if (part.kind == SpacePart::Kind::kQuaternion)
      throw Error({.what = "space of a spline", .found = "quaternions", .wanted = "lines and angles alone"});
  const auto require = [&](const char* what, const Eigen::VectorXd& limit) {
    requireSize(what, limit.size(), space.size());
    for (const double number : limit)
      if (!(number > 0) || !std::isfinite(number))
        throw Error(
            {.what = what, .found = fmt::format("{:g}", number), .wanted = "positive, finite numbers"});
  };
  require("limits of velocity", limits.velocity);
  if (limits.acceleration.size() > 0) require("limits of acceleration", limits.acceleration);
}

// The path with angles that do not jump, stopping at both ends.
Polygon polygonOf(const Space& space, const MatrixArg& path) {
  Polygon polygon;
  const Eigen::MatrixXd corners = unrolled(space, path);
  for (const auto& q : corners.colwise()) polygon.push_back({q, static_cast<double>(polygon.size())});
  polygon.front().isStop = polygon.back().isStop = true;
  return polygon;
}

// The corners behind the control points, in order.
std::vector<std::size_t> cornersOf(const Polygon& polygon) {
  std::vector<std::size_t> corners;
  for (std::size_t i = 0; i < polygon.size(); ++i)
    corners.insert(corners.end(), polygon[i].isStop ? 3 : 1, i);
  return corners;
}

// Four control points in turn, at points of their segment that are no farther apart than the resolution.
bool isValid(const PathProblem& problem, const Eigen::Ref<const Eigen::MatrixXd>& four) {
  double longest = 0;
  for (Eigen::Index k = 1; k < 4; ++k)
    longest = std::max(longest, problem.space.wayLength(four.col(k - 1), four.col(k)));
  const int points = internal::pointsOn(longest, problem.resolution);
  Eigen::MatrixXd block(four.rows(), internal::kBlock);
  return internal::isValidSpread(problem.allValid, points, block,
                                 [&](double share, auto out) { out = four * weights(share, 0); });
}

// The corners of control points between which the spline leaves the path where that is not valid.
std::vector<bool> badCorners(const PathProblem& problem, const Polygon& polygon,
                             const Eigen::MatrixXd& control, const std::vector<std::size_t>& corners) {
  std::vector<bool> isBad(polygon.size());
  for (std::size_t k = 0; k + 3 < corners.size(); ++k) {
    const bool isOnPath = polygon[corners[k + 3]].place <= std::floor(polygon[corners[k]].place) + 1;
    if (isOnPath || isValid(problem, control.middleCols<4>(static_cast<Eigen::Index>(k)))) continue;
    for (std::size_t i = k; i < k + 4; ++i) isBad[corners[i]] = true;
  }
  return isBad;
}

// Halves the sides between bad corners, or makes these stops.
void refine(Polygon& polygon, const std::vector<bool>& isBad, bool mayHalve) {
  Polygon finer;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    finer.push_back(polygon[i]);
    if (isBad[i] && !mayHalve) finer.back().isStop = true;
    if (!isBad[i] || !mayHalve || i + 1 == polygon.size() || !isBad[i + 1]) continue;
    const Corner &a = polygon[i], &b = polygon[i + 1];
    finer.push_back({(a.q + b.q) / 2, (a.place + b.place) / 2});
  }
  polygon = std::move(finer);
}

bool isPathValid(const PathProblem& problem, const MatrixArg& path) {
  EdgeChecker edges(problem.space, problem.allValid, problem.resolution);
  bool isValid = edges.isValid(path.col(0));
  for (Eigen::Index k = 1; isValid && k < path.cols(); ++k)
    isValid = edges.isValid(path.col(k - 1), path.col(k));
  return isValid;
}

// The largest share of the limits that the velocity reaches in the segment between two control points, where
// one such step takes a second. Its number at the share s is that of a quadratic B-spline of three steps: it
// is largest at an end, or where it turns.
double velocityShare(const Eigen::Ref<const Eigen::MatrixXd>& four, const Eigen::VectorXd& limit) {
  double largest = 0;
  for (Eigen::Index i = 0; i < four.rows(); ++i) {
    const double first = four(i, 1) - four(i, 0), second = four(i, 2) - four(i, 1);
    const double third = four(i, 3) - four(i, 2), rise = second - first, fall = second - third;
    double fastest = std::max(std::abs(first + second), std::abs(second + third)) / 2;
    if (rise * fall > 0)  // it turns at rise / (rise + fall)
      fastest = std::max(fastest, std::abs((first + second + rise * rise / (rise + fall)) / 2));
    largest = std::max(largest, fastest / limit[i]);
  }
  return largest;
}

// The shortest that keeps velocities and accelerations within their limits. The latter are linear between
// control points, where they are second differences.
double intervalFor(const Eigen::MatrixXd& control, const MotionLimits& limits) {
  double interval = 0;
  for (Eigen::Index k = 0; k + 3 < control.cols(); ++k)
    interval = std::max(interval, velocityShare(control.middleCols<4>(k), limits.velocity));
  if (limits.acceleration.size() == 0) return interval;
  for (Eigen::Index k = 2; k < control.cols(); ++k) {
    const Eigen::ArrayXd turn = control.col(k) - 2 * control.col(k - 1) + control.col(k - 2);
    interval = std::max(interval, std::sqrt((turn.abs() / limits.acceleration.array()).maxCoeff()));
  }
  return interval;
}

SplineResult resultOf(const Polygon& polygon, const Eigen::MatrixXd& control, const MotionLimits& limits) {
  SplineResult result{.spline = PathSpline(control, intervalFor(control, limits))};
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i) result.stops += polygon[i].isStop ? 1 : 0;
  result.status = result.stops > 0 ? SplineStatus::kStops : SplineStatus::kSmooth;
  result.message = fmt::format("a spline with {} control points and {} stops, {:.3g} s", control.cols(),
                               result.stops, result.spline.duration());
  return result;
}

}  // namespace

PathSpline::PathSpline(Eigen::MatrixXd control, double interval)
    : control_(std::move(control)), interval_(interval) {
  if (control_.cols() == 0)
    throw Error({.what = "spline", .found = "no control points", .wanted = "at least one"});
  if (!(interval >= 0) || !std::isfinite(interval))
    throw Error({.what = "interval of a spline",
                 .found = fmt::format("{:g} s", interval),
                 .wanted = "a finite time, zero or more"});
}

double PathSpline::duration() const {
  return interval_ * static_cast<double>(std::max<Eigen::Index>(0, control_.cols() - 3));
}

Eigen::VectorXd PathSpline::value(double t, int derivative) const {
  if (control_.cols() == 0)
    throw Error({.what = "spline", .found = "no control points", .wanted = "one that splineAlong() found"});
  requireFinite("time on a spline", t);
  const bool isPoint = !(duration() > 0);
  if (isPoint)
    return derivative == 0 ? Eigen::VectorXd(control_.col(0)) : Eigen::VectorXd(0 * control_.col(0));
  const double way = std::clamp(t, 0., duration()) / interval_;
  const Eigen::Index segment = std::min(static_cast<Eigen::Index>(way), control_.cols() - 4);
  return control_.middleCols<4>(segment) * weights(way - static_cast<double>(segment), derivative) /
         std::pow(interval_, derivative);
}

SplineResult splineAlong(const PathProblem& problem, const MatrixArg& path, const MotionLimits& limits) {
  requireSound(problem, path, limits);
  if (!isPathValid(problem, path)) return {.message = "no spline: the path itself is not valid"};
  Polygon polygon = polygonOf(problem.space, path);
  for (int round = 0;; ++round) {
    const std::vector<std::size_t> corners = cornersOf(polygon);
    Eigen::MatrixXd control(path.rows(), static_cast<Eigen::Index>(corners.size()));
    for (std::size_t k = 0; k < corners.size(); ++k)
      control.col(static_cast<Eigen::Index>(k)) = polygon[corners[k]].q;
    const std::vector<bool> isBad = badCorners(problem, polygon, control, corners);
    if (std::count(isBad.begin(), isBad.end(), true) == 0) return resultOf(polygon, control, limits);
    refine(polygon, isBad, round < kMostRounds);
  }
}

}  // namespace rex
