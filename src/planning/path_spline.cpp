#include "planning/path_spline.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/error.h"
#include "base/require.h"
#include "geometry/rotation.h"
#include "planning/path_problem.h"
#include "planning/path_problem_internal.h"
#include "planning/smooth_path.h"

namespace rex {
namespace {

// The velocity that leads from one configuration to the next in a unit of time; both are unrolled.
Eigen::VectorXd velocityBetween(const Space& space, const VectorArg& from, const VectorArg& to) {
  Eigen::VectorXd velocity(space.size());
  Eigen::Index i = 0, k = 0;
  for (const SpacePart& part : space.parts()) {
    if (part.kind == SpacePart::Kind::kQuaternion) {
      const Eigen::Matrix3d R0 = rotationFromQuaternion(from.segment<4>(i));
      velocity.segment<3>(k) = logSO3(R0.transpose() * rotationFromQuaternion(to.segment<4>(i)));
      i += 4, k += 3;
    } else {
      velocity[k++] = to[i] - from[i];
      ++i;
    }
  }
  return velocity.head(k);
}

CurvePiece straightPiece(const Space& space, const Eigen::VectorXd& from, const Eigen::VectorXd& to,
                         const Eigen::VectorXd& velocity) {
  const double length = velocity.norm();
  const Eigen::VectorXd direction = velocity / length;
  const auto at = [=](double s, CurvePoint& point) {
    point.q.resize(from.size());
    if (s >= length)
      point.q = to;
    else
      space.interpolate(from, to, std::max(0., s / length), point.q);
    point.dq = direction;
    point.ddq = Eigen::VectorXd::Zero(direction.size());
  };
  return {.length = length, .at = at};
}

// The largest entry of the second derivative that bends the path: of its part across the first derivative, or
// of all of it if the piece turns round.
double bendOf(const CurvePiece& piece) {
  CurvePoint point;
  piece.at(0, point);
  const Eigen::VectorXd first = point.dq;
  piece.at(piece.length, point);
  const bool goesOn = first.dot(point.dq) > .5 * first.norm() * point.dq.norm();
  double most = 0;
  for (const double share : {0., .25, .5, .75, 1.}) {
    piece.at(share * piece.length, point);
    Eigen::VectorXd bend = point.ddq;
    if (goesOn && point.dq.squaredNorm() > 0)
      bend -= point.dq * (point.dq.dot(point.ddq) / point.dq.squaredNorm());
    // On a straight path, what rounding leaves does not count as a bend.
    if (bend.norm() > 1e-12 * point.ddq.norm()) most = std::max(most, bend.cwiseAbs().maxCoeff());
  }
  return most;
}

}  // namespace

double PathCurve::length() const {
  double sum = 0;
  for (const CurvePiece& piece : pieces) sum += piece.length;
  return sum;
}

int PathCurve::stops() const {
  int count = 0;
  for (std::size_t i = 0; i + 1 < pieces.size(); ++i) count += pieces[i].stopsAtEnd ? 1 : 0;
  return count;
}

PathCurve straightCurve(const Space& space, const MatrixArg& path) {
  constexpr double kCorner = 1e-7, kNoWay = 1e-12;
  requireSize("configurations of a path", path.rows(), space.size());
  if (path.cols() == 0) throw Error({.what = "path", .found = "no configurations", .wanted = "at least one"});
  const Eigen::MatrixXd postures = unrolled(space, path);
  PathCurve curve{.start = postures.col(0)};
  Eigen::VectorXd from = postures.col(0), last;
  for (Eigen::Index k = 1; k < postures.cols(); ++k) {
    const Eigen::VectorXd to = postures.col(k), velocity = velocityBetween(space, from, to);
    if (!(velocity.norm() > kNoWay)) continue;
    const Eigen::VectorXd direction = velocity.normalized();
    if (!curve.pieces.empty()) curve.pieces.back().stopsAtEnd = (direction - last).norm() > kCorner;
    curve.pieces.push_back(straightPiece(space, from, to, velocity));
    from = to;
    last = direction;
  }
  return curve;
}

Eigen::MatrixXd sampled(const PathCurve& curve, double tolerance) {
  requirePositive("tolerance of a sampled curve", tolerance);
  std::vector<Eigen::VectorXd> postures{curve.start};
  CurvePoint point;
  for (const CurvePiece& piece : curve.pieces) {
    const double steps = std::ceil(piece.length * std::sqrt(bendOf(piece) / (8 * tolerance)));
    const int count = static_cast<int>(std::clamp(steps, 1., 1e5));
    for (int i = 1; i <= count; ++i) {
      piece.at(piece.length * i / count, point);
      postures.push_back(point.q);
    }
  }
  Eigen::MatrixXd columns(curve.start.size(), static_cast<Eigen::Index>(postures.size()));
  for (std::size_t k = 0; k < postures.size(); ++k) columns.col(static_cast<Eigen::Index>(k)) = postures[k];
  return columns;
}

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
  double place;  // along the path: 1.5 is halfway between its configurations 1 and 2
  bool isStop = false;
};
using Polygon = std::vector<Corner>;

void requireSound(const PathProblem& problem, const MatrixArg& path) {
  const Space& space = problem.space;
  requireSize("configurations of a path", path.rows(), space.size());
  if (path.cols() == 0) throw Error({.what = "path", .found = "no configurations", .wanted = "at least one"});
  for (const SpacePart& part : space.parts())
    if (part.kind == SpacePart::Kind::kQuaternion)
      throw Error({.what = "space of a spline", .found = "quaternions", .wanted = "only lines and angles"});
}

// The path with angles that do not jump, stopping at both ends.
Polygon polygonOf(const Space& space, const MatrixArg& path) {
  Polygon polygon;
  const Eigen::MatrixXd corners = unrolled(space, path);
  for (const auto& q : corners.colwise()) polygon.push_back({q, static_cast<double>(polygon.size())});
  polygon.front().isStop = polygon.back().isStop = true;
  return polygon;
}

// The corners from which the control points stem, in order.
std::vector<std::size_t> cornersOf(const Polygon& polygon) {
  std::vector<std::size_t> corners;
  for (std::size_t i = 0; i < polygon.size(); ++i)
    corners.insert(corners.end(), polygon[i].isStop ? 3 : 1, i);
  return corners;
}

// Whether the segment of four successive control points is valid, checked at points no farther apart than the
// resolution.
bool isValid(const PathProblem& problem, const Eigen::Ref<const Eigen::MatrixXd>& four) {
  double longest = 0;
  for (Eigen::Index k = 1; k < 4; ++k)
    longest = std::max(longest, problem.space.wayLength(four.col(k - 1), four.col(k)));
  const int points = internal::pointsOn(longest, problem.resolution);
  Eigen::MatrixXd block(four.rows(), internal::kBlock);
  return internal::isValidSpread(problem.allValid, points, block,
                                 [&](double share, auto out) { out = four * weights(share, 0); });
}

// The corners of those segments in which the spline leaves the path and is not valid.
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

// Halves the sides between bad corners, or turns these corners into stops.
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

SplineResult resultOf(const Polygon& polygon, const Eigen::MatrixXd& control) {
  SplineResult result{.spline = PathSpline(control)};
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i) result.stops += polygon[i].isStop ? 1 : 0;
  result.status = result.stops > 0 ? SplineStatus::kStops : SplineStatus::kSmooth;
  result.message = fmt::format("a spline with {} control points and {} stops", control.cols(), result.stops);
  return result;
}

// A straight piece from `from`, half of `side` long per unit of the parameter. It ends exactly at `to`.
CurvePiece sixthOf(const Eigen::VectorXd& side, const Eigen::VectorXd& from, const Eigen::VectorXd& to) {
  constexpr double kLength = 1. / 3;
  const auto at = [=](double s, CurvePoint& point) {
    point.q = s >= kLength ? to : (from + s / 2 * side).eval();
    point.dq = side / 2;
    point.ddq = Eigen::VectorXd::Zero(side.size());
  };
  return {.length = kLength, .at = at};
}

CurvePiece cubicPiece(const Eigen::MatrixXd& four) {
  const auto at = [=](double s, CurvePoint& point) {
    point.q = four * weights(s, 0);
    point.dq = four * weights(s, 1);
    point.ddq = four * weights(s, 2);
  };
  return {.length = 1, .at = at};
}

// Nothing where all four are one point.
std::optional<CurvePiece> pieceOf(const Eigen::MatrixXd& four) {
  const Eigen::VectorXd first = four.col(0), last = four.col(3), side = last - first;
  const bool isAtFirst = four.col(1) == first && four.col(2) == first;
  const bool isAtLast = four.col(1) == last && four.col(2) == last;
  if (isAtFirst && isAtLast) return {};
  if (isAtFirst) return sixthOf(side, first, first + side / 6);
  if (!isAtLast) return cubicPiece(four);
  CurvePiece piece = sixthOf(side, last - side / 6, last);
  piece.stopsAtEnd = true;
  return piece;
}

}  // namespace

PathSpline::PathSpline(Eigen::MatrixXd control) : control_(std::move(control)) {
  if (control_.cols() == 0)
    throw Error({.what = "spline", .found = "no control points", .wanted = "at least one"});
}

double PathSpline::length() const {
  return static_cast<double>(std::max<Eigen::Index>(0, control_.cols() - 3));
}

Eigen::VectorXd PathSpline::value(double s, int derivative) const {
  if (control_.cols() == 0)
    throw Error({.what = "spline", .found = "no control points", .wanted = "one that splineAlong() found"});
  requireFinite("parameter of a spline", s);
  if (!(length() > 0))
    return derivative == 0 ? Eigen::VectorXd(control_.col(0)) : Eigen::VectorXd(0 * control_.col(0));
  const double way = std::clamp(s, 0., length());
  const Eigen::Index segment = std::min(static_cast<Eigen::Index>(way), control_.cols() - 4);
  return control_.middleCols<4>(segment) * weights(way - static_cast<double>(segment), derivative);
}

PathCurve PathSpline::curve() const {
  PathCurve curve{.start = value(0)};
  if (control_.cols() < 4) return curve;
  curve.start = control_.col(0);
  for (Eigen::Index k = 0; k + 3 < control_.cols(); ++k)
    if (auto piece = pieceOf(control_.middleCols<4>(k))) curve.pieces.push_back(std::move(*piece));
  return curve;
}

SplineResult splineAlong(const PathProblem& problem, const MatrixArg& path) {
  requireSound(problem, path);
  if (!isPathValid(problem, path)) return {.message = "no spline: the path itself is not valid"};
  Polygon polygon = polygonOf(problem.space, path);
  for (int round = 0;; ++round) {
    const std::vector<std::size_t> corners = cornersOf(polygon);
    Eigen::MatrixXd control(path.rows(), static_cast<Eigen::Index>(corners.size()));
    for (std::size_t k = 0; k < corners.size(); ++k)
      control.col(static_cast<Eigen::Index>(k)) = polygon[corners[k]].q;
    const std::vector<bool> isBad = badCorners(problem, polygon, control, corners);
    if (std::count(isBad.begin(), isBad.end(), true) == 0) return resultOf(polygon, control);
    refine(polygon, isBad, round < kMostRounds);
  }
}

PathCurve smoothCurve(const PathProblem& problem, const MatrixArg& path, int rounds, Rng& rng) {
  const Eigen::MatrixXd shorter = shortcut(problem, path, rounds, rng);
  const bool hasRotations = std::ranges::any_of(
      problem.space.parts(), [](const SpacePart& part) { return part.kind == SpacePart::Kind::kQuaternion; });
  if (hasRotations) return straightCurve(problem.space, shorter);
  const SplineResult result = splineAlong(problem, shorter);
  // A straight segment was checked at other points than the spline, which may find an invalid one on it.
  return result.status == SplineStatus::kInvalid ? straightCurve(problem.space, shorter)
                                                 : result.spline.curve();
}

}  // namespace rex
