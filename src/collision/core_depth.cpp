#include <array>
#include <limits>

#include <Eigen/Geometry>

#include "collision/core_depth_internal.h"
#include "collision/expanding_polytope_internal.h"

namespace rex::internal {
namespace {

using Eigen::Vector3d;

constexpr double kDepthSlack = 1e-10, kCurvedSlack = 5e-7;  // metres
constexpr double kFlat = 1e-9;                              // metres: anything thinner has no interior
constexpr double kPrecision = 1e-13;                        // of the size

// Four corners that span the Minkowski difference, or a direction in which it has no thickness.
struct Span {
  bool isFlat = true;
  Vector3d normal = Vector3d::UnitZ();
  std::array<DifferencePoint, 4> corners;
};

template <class Measure, class... Directions>
double findFarthest(const MinkowskiDifference& difference, const Measure& measure, DifferencePoint& farthest,
                    const Directions&... directions) {
  double most = -1;
  const auto ask = [&](const Vector3d& n) {
    const DifferencePoint point = difference.lowest(n);
    if (const double m = measure(point.x); m > most) most = m, farthest = point;
  };
  (ask(directions), ...);
  return most;
}

Span spanOf(const MinkowskiDifference& difference) {
  Span span;
  auto& [p, q, r, s] = span.corners;
  double size = -1;
  for (int k = 0; k < 3; ++k) {
    const DifferencePoint low = difference.lowest(Vector3d::Unit(k)),
                          high = difference.lowest(-Vector3d::Unit(k));
    if (const double width = (high.x - low.x).norm(); width > size) size = width, p = low, q = high;
  }
  if (size <= kFlat) return span;
  const Vector3d along = (q.x - p.x) / size, across = along.unitOrthogonal(), third = along.cross(across);
  span.normal = across;
  const auto fromLine = [&](const Vector3d& x) { return along.cross(x - p.x).norm(); };
  if (findFarthest(difference, fromLine, r, across, Vector3d(-across), third, Vector3d(-third)) <= kFlat)
    return span;
  span.normal = along.cross(r.x - p.x).normalized();
  const auto fromPlane = [&](const Vector3d& x) { return std::abs(span.normal.dot(x - p.x)); };
  span.isFlat = findFarthest(difference, fromPlane, s, span.normal, Vector3d(-span.normal)) <= kFlat;
  return span;
}

CoreProximity flatDepth(const MinkowskiDifference& difference, const Vector3d& normal,
                        const DifferencePoint& touching) {
  const double one = normal.dot(difference.lowest(normal).x);
  const double other = -normal.dot(difference.lowest(-normal).x);
  if (one >= other) return {one, kFlat, normal, touching};
  return {other, kFlat, -normal, touching};
}

// The gap along n is a lower bound on the distance.
void keepBetter(const Vector3d& n, const DifferencePoint& lowest, CoreProximity& best) {
  if (const double gap = n.dot(lowest.x); gap > best.distance) best.distance = gap, best.normal = n;
}

}  // namespace

CoreProximity coreDepth(const MinkowskiDifference& difference, const DifferencePoint& touching) {
  const Span span = spanOf(difference);
  if (span.isFlat) return flatDepth(difference, span.normal, touching);
  const double size = (span.corners[1].x - span.corners[0].x).norm();
  const double enough = difference.isCurved() ? kCurvedSlack : kDepthSlack;
  ExpandingPolytope polytope(span.corners, kPrecision * size);
  CoreProximity best;
  best.distance = -std::numeric_limits<double>::infinity();
  for (bool grows = true; grows;) {
    const int index = polytope.nearestFace();
    const ExpandingPolytope::Face& face = polytope.face(index);
    const DifferencePoint w = difference.lowest(face.n);
    keepBetter(face.n, w, best);
    if (difference.isCurved())
      for (const Vector3d& ridge : difference.ridges(face.n))
        if (ridge.norm() > kFlat) keepBetter(ridge.normalized(), difference.lowest(ridge), best);
    best.slack = face.offset - best.distance;
    grows = best.slack > enough && polytope.add(w, index);
  }
  best.nearest = polytope.pointAgainst(best.normal);
  return best;
}

}  // namespace rex::internal
