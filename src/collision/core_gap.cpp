#include <array>
#include <limits>

#include <Eigen/Geometry>

#include "collision/core_gap_internal.h"

namespace rex::internal {
namespace {

using Eigen::Vector3d;

constexpr double kGapSlack = 1e-10;  // metres, between the bounds that end the search
constexpr double kTouch = 1e-12;     // metres: below this distance the direction is undefined
constexpr double kSliver = 1e-10;    // the sine of the least angle that counts
constexpr double kNoFarther = 1 + 1e-15;
constexpr int kMostSteps = 100;

// Up to four points, and weights such that their weighted sum is the point nearest to the origin.
struct Simplex {
  std::array<DifferencePoint, 4> points;
  std::array<double, 4> weights{};
  int size = 0;
  double distance = std::numeric_limits<double>::infinity();
  Vector3d n = Vector3d::Zero();

  void add(const DifferencePoint& point, double weight) {
    points[size] = point;
    weights[size++] = weight;
  }
  // The point nearest to the origin lies inside the simplex, in direction n. The direction is more precise
  // than the point, whose digits cancel near the origin.
  void finish(const Vector3d& direction) {
    n = direction.normalized();
    distance = sum().x.norm();
  }
  DifferencePoint sum() const {
    DifferencePoint result{Vector3d::Zero(), Vector3d::Zero()};
    for (int i = 0; i < size; ++i) {
      result.x += weights[i] * points[i].x;
      result.onA += weights[i] * points[i].onA;
    }
    return result;
  }
};

void keepNearer(const Simplex& candidate, Simplex& best) {
  if (candidate.distance < best.distance) best = candidate;
}

void tryPoint(const DifferencePoint& p, Simplex& best) {
  Simplex candidate;
  candidate.add(p, 1);
  candidate.finish(p.x);
  keepNearer(candidate, best);
}

void tryEdge(const DifferencePoint& p, const DifferencePoint& q, Simplex& best) {
  const Vector3d edge = q.x - p.x;
  const double t = -p.x.dot(edge) / edge.squaredNorm();
  if (!(t > 0 && t < 1)) return;
  Simplex candidate;
  candidate.add(p, 1 - t);
  candidate.add(q, t);
  const Vector3d rough = p.x + t * edge;
  candidate.finish(rough - edge.dot(rough) / edge.squaredNorm() * edge);
  keepNearer(candidate, best);
}

void tryTriangle(const DifferencePoint& p, const DifferencePoint& q, const DifferencePoint& r,
                 Simplex& best) {
  const Vector3d n = (q.x - p.x).cross(r.x - p.x);
  const double area = n.norm();
  if (!(area > kSliver * (q.x - p.x).norm() * (r.x - p.x).norm())) return;
  const double u = n.dot(q.x.cross(r.x)), v = n.dot(r.x.cross(p.x)), w = n.dot(p.x.cross(q.x));
  if (!(u > 0 && v > 0 && w > 0)) return;
  Simplex candidate;
  candidate.add(p, u / (u + v + w));
  candidate.add(q, v / (u + v + w));
  candidate.add(r, w / (u + v + w));
  candidate.finish(n.dot(p.x) > 0 ? n : -n);
  keepNearer(candidate, best);
}

bool holdsOrigin(const Simplex& s, const DifferencePoint& w) {
  if (s.size < 3) return false;
  const auto volume = [](const Vector3d& a, const Vector3d& b, const Vector3d& c) {
    return a.cross(b).dot(c);
  };
  const Vector3d &p = s.points[0].x, &q = s.points[1].x, &r = s.points[2].x;
  const double whole = volume(q - p, r - p, w.x - p);
  const double sign = whole < 0 ? -1 : 1;
  return sign * volume(q, r, w.x) > 0 && sign * volume(r, p, w.x) > 0 && sign * volume(p, q, w.x) > 0;
}

// The part of the simplex that is nearest to the origin, among those with the new point w as a corner.
Simplex nearestWith(const Simplex& old, const DifferencePoint& w) {
  Simplex best;
  tryPoint(w, best);
  for (int i = 0; i < old.size; ++i) {
    tryEdge(w, old.points[i], best);
    for (int j = 0; j < i; ++j) tryTriangle(w, old.points[i], old.points[j], best);
  }
  return best;
}

}  // namespace

CoreProximity coreGap(const MinkowskiDifference& difference) {
  Simplex simplex;
  const Vector3d start = difference.centres();
  tryPoint(difference.lowest(start.squaredNorm() > 0 ? start : Vector3d::UnitX()), simplex);
  CoreProximity best;
  best.slack = std::numeric_limits<double>::infinity();
  for (int step = 0; step < kMostSteps && simplex.distance > kTouch; ++step) {
    const DifferencePoint w = difference.lowest(simplex.n);
    const double slack = simplex.distance - simplex.n.dot(w.x);
    if (slack < best.slack) best = {simplex.distance, slack, simplex.n, simplex.sum()};
    if (slack <= kGapSlack || holdsOrigin(simplex, w)) break;
    const Simplex next = nearestWith(simplex, w);
    if (!(next.distance <= simplex.distance * kNoFarther)) break;
    simplex = next;
  }
  if (simplex.distance > kTouch && best.distance > best.slack) return best;
  return {0, 0, Vector3d::Zero(), simplex.sum()};
}

}  // namespace rex::internal
