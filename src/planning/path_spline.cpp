#include "planning/path_spline.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/error.h"
#include "planning/edge_checker.h"

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
      if (!(number > 0))
        throw Error({.what = what, .found = fmt::format("{:g}", number), .wanted = "positive numbers"});
  };
  require("limits of velocity", limits.velocity);
  if (limits.acceleration.size() > 0) require("limits of acceleration", limits.acceleration);
}

// The path with angles that do not jump, stopping at both ends.
Polygon polygonOf(const Space& space, const MatrixArg& path) {
  Polygon polygon;
  for (const auto& column : path.colwise()) {
    Eigen::VectorXd q = column;
    for (Eigen::Index i = 0; i < q.size() && !polygon.empty(); ++i) {
      const double last = polygon.back().q[i];
      if (space.parts()[static_cast<std::size_t>(i)].kind != SpacePart::Kind::kLine)
        q[i] = last + std::remainder(q[i] - last, 2 * std::numbers::pi);
    }
    polygon.push_back({q, static_cast<double>(polygon.size())});
  }
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
    longest = std::max(longest, problem.space.distance(four.col(k - 1), four.col(k)));
  const int points = std::max(1, static_cast<int>(std::ceil(longest / problem.resolution)));
  Eigen::MatrixXd Q(four.rows(), points);
  for (int i = 0; i < points; ++i) Q.col(i) = four * weights((i + 1.) / points, 0);
  return problem.allValid(Q);
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

// The shortest that keeps velocities and accelerations, which lie between the first and second differences of
// control points, within their limits.
double intervalFor(const Eigen::MatrixXd& control, const MotionLimits& limits) {
  double interval = 0;
  for (Eigen::Index k = 1; k < control.cols(); ++k) {
    const Eigen::ArrayXd step = control.col(k) - control.col(k - 1);
    interval = std::max(interval, (step.abs() / limits.velocity.array()).maxCoeff());
    if (k == 1 || limits.acceleration.size() == 0) continue;
    const Eigen::ArrayXd turn = step - (control.col(k - 1) - control.col(k - 2)).array();
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
    : control_(std::move(control)), interval_(interval) {}

double PathSpline::duration() const {
  return interval_ * static_cast<double>(std::max<Eigen::Index>(0, control_.cols() - 3));
}

Eigen::VectorXd PathSpline::value(double t, int derivative) const {
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
