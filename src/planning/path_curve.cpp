#include "planning/path_curve.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/require.h"
#include "geometry/rotation.h"

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

}  // namespace rex
