#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <memory_resource>
#include <vector>

#include <Eigen/Geometry>

#include "collision/contact_kernel_internal.h"
#include "collision/convex_core_internal.h"
#include "collision/convex_distance_internal.h"

namespace rex::internal {

/// The distance of two cores that lie apart, with a slack of 1e-10 m; more only where features of nanometres
/// blur the direction. If they touch or overlap, zero, and then only `nearest` counts: the origin if the
/// difference is flat. Gilbert, Johnson and Keerthi, 1988, with the nearest point of a simplex by trying all
/// its sides. It ends early, with a distance that is not the least, where that is at least `enough`.
[[nodiscard]] CoreProximity coreGap(const MinkowskiDifference& difference,
                                    double enough = std::numeric_limits<double>::infinity());

/// A convex polytope of triangles that grows by points outside of it. Its normals point inwards. Some 100 kB
/// lie in itself, room for a few hundred corners; only beyond those does it allocate.
class ExpandingPolytope {
 public:
  static constexpr int kMostCorners = 1 << 15;

  struct Face {
    std::array<int, 3> corners;
    std::array<int, 3> neighbours;  ///< [k] lies beyond the edge from corner k to the next
    Eigen::Vector3d n;
    double offset;  ///< n.x of its points; of a face that is gone, minus infinity
  };

  /// A tetrahedron. What is nearer than `precision` metres counts as equal.
  ExpandingPolytope(const std::array<DifferencePoint, 4>& corners, double precision);
  ExpandingPolytope(const ExpandingPolytope&) = delete;
  ExpandingPolytope& operator=(const ExpandingPolytope&) = delete;

  /// The face with the largest offset: the one nearest to the origin, if that lies inside.
  [[nodiscard]] int nearestFace() const { return order_.front().face; }
  [[nodiscard]] const Face& face(int index) const { return faces_[place(index)]; }
  /// Where the line from the origin along -n leaves the polytope.
  [[nodiscard]] DifferencePoint pointAgainst(const Eigen::Vector3d& n) const;

  /// Adds a point below the face `seen`. False, and nothing has changed, if there is no room, or if rounding
  /// left no simple rim around the faces that the point sees.
  [[nodiscard]] bool add(const DifferencePoint& point, int seen);

 private:
  // An edge between a face that is seen and one that is not; `face` will take the place of the former.
  struct RimEdge {
    int from, to, beyond, face;
  };
  // Where a face stands in the order of offsets. Of a face that is gone the offset no longer fits.
  struct Rank {
    double offset;
    int face;
    bool operator<(const Rank& other) const {
      return offset != other.offset ? offset < other.offset : face > other.face;
    }
  };

  static std::size_t place(int index) { return static_cast<std::size_t>(index); }
  const Eigen::Vector3d& corner(int index) const { return corners_[place(index)].x; }
  int newFace();
  void setFace(int index, const std::array<int, 3>& corners, const std::array<int, 3>& neighbours);
  bool sees(const Eigen::Vector3d& x, int face, int from, int to) const;
  void findSeen(const Eigen::Vector3d& x, int first);
  bool findRim();
  void coverRim(int apex);
  Eigen::Vector3d sharesOf(const Face& face, const Eigen::Vector3d& x) const;

  double precision_;
  std::array<std::byte, 96 * 1024> room_;
  std::pmr::monotonic_buffer_resource memory_{room_.data(), room_.size()};
  std::pmr::vector<DifferencePoint> corners_{&memory_};
  std::pmr::vector<Face> faces_{&memory_};
  std::pmr::vector<char> isSeen_{&memory_};
  std::pmr::vector<Rank> order_{&memory_};  // a heap
  std::pmr::vector<int> free_{&memory_}, seen_{&memory_};
  std::pmr::vector<RimEdge> rim_{&memory_};
};

/// How deep two cores overlap that touch or overlap: `touching` is a pair of common points. A polytope inside
/// of their difference grows at the side nearest to the origin, which bounds the depth from below, as every
/// gap bounds it from above (van den Bergen, 2001). The slack is 1e-10 m for cores with flat sides, 5e-7 m
/// with curved ones, as long as the corners of ExpandingPolytope suffice: about one for each direction that
/// leads out on nearly the shortest way, so 10 000 for cylinders of 3 m radius around one axis.
[[nodiscard]] CoreProximity coreDepth(const MinkowskiDifference& difference, const DifferencePoint& touching);

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

CoreProximity coreGap(const MinkowskiDifference& difference, double enough) {
  Simplex simplex;
  const Vector3d start = difference.centres();
  tryPoint(difference.lowest(start.squaredNorm() > 0 ? start : Vector3d::UnitX()), simplex);
  CoreProximity best;
  best.slack = std::numeric_limits<double>::infinity();
  for (int step = 0; step < kMostSteps && simplex.distance > kTouch; ++step) {
    const DifferencePoint w = difference.lowest(simplex.n);
    const double gap = simplex.n.dot(w.x), slack = simplex.distance - gap;
    if (slack < best.slack) best = {simplex.distance, slack, simplex.n, simplex.sum()};
    if (slack <= kGapSlack || gap >= enough || holdsOrigin(simplex, w)) break;
    const Simplex next = nearestWith(simplex, w);
    if (!(next.distance <= simplex.distance * kNoFarther)) break;
    simplex = next;
  }
  if (simplex.distance > kTouch && best.distance > best.slack) return best;
  return {0, 0, Vector3d::Zero(), simplex.sum()};
}

using Eigen::Vector3d;

namespace {

constexpr double kNone = -std::numeric_limits<double>::infinity();
constexpr double kGrazing = 1e-9;           // the sine of an angle
constexpr double kOnePlane = 1e-9;          // metres
constexpr std::size_t kUsualCorners = 256;  // fits into the reserved memory

}  // namespace

ExpandingPolytope::ExpandingPolytope(const std::array<DifferencePoint, 4>& corners, double precision)
    : precision_(precision) {
  corners_.reserve(kUsualCorners);
  faces_.reserve(2 * kUsualCorners);
  isSeen_.reserve(2 * kUsualCorners);
  order_.reserve(6 * kUsualCorners);
  corners_.assign(corners.begin(), corners.end());
  const Vector3d& p = corners[0].x;
  if ((corners[1].x - p).cross(corners[2].x - p).dot(corners[3].x - p) < 0)
    std::swap(corners_[0], corners_[1]);
  for (int i = 0; i < 4; ++i) newFace();
  setFace(0, {0, 1, 2}, {1, 3, 2});
  setFace(1, {0, 3, 1}, {2, 3, 0});
  setFace(2, {0, 2, 3}, {0, 3, 1});
  setFace(3, {1, 3, 2}, {1, 2, 0});
}

int ExpandingPolytope::newFace() {
  if (!free_.empty()) {
    const int index = free_.back();
    free_.pop_back();
    return index;
  }
  faces_.emplace_back();
  isSeen_.push_back(false);
  return static_cast<int>(faces_.size()) - 1;
}

void ExpandingPolytope::setFace(int index, const std::array<int, 3>& corners,
                                const std::array<int, 3>& neighbours) {
  Face& face = faces_[place(index)];
  const Vector3d& p = corner(corners[0]);
  face.corners = corners;
  face.neighbours = neighbours;
  face.n = (corner(corners[1]) - p).cross(corner(corners[2]) - p).normalized();
  // A sliver without a normal is skipped: its neighbours have its points.
  face.offset = face.n.squaredNorm() > 0 ? face.n.dot(p) : kNone;
  order_.push_back({face.offset, index});
  std::push_heap(order_.begin(), order_.end());
}

DifferencePoint ExpandingPolytope::pointAgainst(const Vector3d& n) const {
  const auto way = [&](const Face& face) {
    const double slope = face.n.dot(n);
    return slope > kGrazing ? face.offset / slope : kNone;
  };
  double nearest = kNone;
  for (const Face& face : faces_) nearest = std::max(nearest, way(face));
  // Among faces in one plane, the one that contains the point.
  const Face* hit = &face(nearestFace());
  Vector3d shares = Vector3d::Constant(kNone);
  for (const Face& face : faces_) {
    if (!(way(face) >= nearest - kOnePlane)) continue;
    const Vector3d found = sharesOf(face, nearest * n);
    if (found.minCoeff() > shares.minCoeff()) shares = found, hit = &face;
  }
  shares = shares.cwiseMax(0);
  shares /= shares.sum();
  DifferencePoint point{Vector3d::Zero(), Vector3d::Zero()};
  for (int k = 0; k < 3; ++k) {
    const DifferencePoint& corner = corners_[place(hit->corners[k])];
    point.x += shares[k] * corner.x;
    point.onA += shares[k] * corner.onA;
  }
  return point;
}

// The barycentric coordinates of the point x in the plane of a face.
Vector3d ExpandingPolytope::sharesOf(const Face& face, const Vector3d& x) const {
  std::array<Vector3d, 3> to;
  for (int k = 0; k < 3; ++k) to[k] = corner(face.corners[k]) - x;
  Vector3d shares;
  for (int k = 0; k < 3; ++k) shares[k] = face.n.dot(to[(k + 1) % 3].cross(to[(k + 2) % 3]));
  return shares / shares.sum();
}

bool ExpandingPolytope::add(const DifferencePoint& point, int seen) {
  if (corners_.size() == kMostCorners) return false;
  findSeen(point.x, seen);
  const bool hasRim = findRim();
  for (const int face : seen_) isSeen_[place(face)] = false;
  if (!hasRim) return false;
  corners_.push_back(point);
  coverRim(static_cast<int>(corners_.size()) - 1);
  return true;
}

// Also true if x would form a sliver with the edge: then x lies on the line of the edge, and the sliver
// would have no normal.
bool ExpandingPolytope::sees(const Vector3d& x, int face, int from, int to) const {
  if (faces_[place(face)].n.dot(x) < faces_[place(face)].offset - precision_) return true;
  const Vector3d edge = corner(to) - corner(from);
  return edge.cross(x - corner(from)).squaredNorm() <= precision_ * precision_ * edge.squaredNorm();
}

void ExpandingPolytope::findSeen(const Vector3d& x, int first) {
  seen_.assign(1, first);
  isSeen_[place(first)] = true;
  for (std::size_t i = 0; i < seen_.size(); ++i) {
    const Face& face = faces_[place(seen_[i])];
    for (std::size_t k = 0; k < 3; ++k) {
      const int beyond = face.neighbours[k];
      if (isSeen_[place(beyond)] || !sees(x, beyond, face.corners[k], face.corners[(k + 1) % 3])) continue;
      isSeen_[place(beyond)] = true;
      seen_.push_back(beyond);
    }
  }
}

// Collects the edges around the visible faces in order; false unless they form one simple ring.
bool ExpandingPolytope::findRim() {
  rim_.clear();
  for (const int index : seen_) {
    const Face& face = faces_[place(index)];
    for (std::size_t k = 0; k < 3; ++k)
      if (!isSeen_[place(face.neighbours[k])])
        rim_.push_back({face.corners[k], face.corners[(k + 1) % 3], face.neighbours[k], -1});
  }
  if (rim_.size() < 3) return false;
  for (auto edge = rim_.begin(); edge + 1 != rim_.end(); ++edge) {
    const auto startsHere = [&](const RimEdge& other) { return other.from == edge->to; };
    if (edge->to == rim_[0].from || std::count_if(edge + 1, rim_.end(), startsHere) != 1) return false;
    std::iter_swap(edge + 1, std::find_if(edge + 1, rim_.end(), startsHere));
  }
  return rim_.back().to == rim_[0].from;
}

void ExpandingPolytope::coverRim(int apex) {
  for (const int face : seen_) faces_[place(face)].offset = kNone;
  free_.insert(free_.end(), seen_.begin(), seen_.end());
  for (RimEdge& edge : rim_) edge.face = newFace();
  for (std::size_t i = 0; i < rim_.size(); ++i) {
    const auto& [from, to, beyond, face] = rim_[i];
    const int next = rim_[(i + 1) % rim_.size()].face;
    const int previous = rim_[(i + rim_.size() - 1) % rim_.size()].face;
    setFace(face, {from, to, apex}, {beyond, next, previous});
    Face& outer = faces_[place(beyond)];
    for (std::size_t k = 0; k < 3; ++k)
      if (outer.corners[k] == to) outer.neighbours[k] = face;
  }
  while (faces_[place(nearestFace())].offset != order_.front().offset) {
    std::pop_heap(order_.begin(), order_.end());
    order_.pop_back();
  }
}

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

using Eigen::Vector3d;

CertifiedProximity certifiedProximity(const Shape& a, const Pose& X_WA, const Shape& b, const Pose& X_WB) {
  const ConvexCore coreA(a), coreB(b);
  const MinkowskiDifference difference(coreA, coreB, X_WA.inverse() * X_WB);
  CoreProximity cores = coreGap(difference);
  if (!(cores.distance > 0)) cores = coreDepth(difference, cores.nearest);

  // The points differ by the distance along the normal within the slack; half of the rest falls to each.
  const double distance = cores.distance - coreA.radius() - coreB.radius();
  const Vector3d normal_W = X_WA.R * cores.normal;
  const Vector3d middle_A = cores.nearest.onA - cores.nearest.x / 2;
  const Vector3d middle_W = X_WA * middle_A + (coreB.radius() - coreA.radius()) / 2 * normal_W;
  const Vector3d half_W = distance / 2 * normal_W;
  return {{distance, middle_W + half_W, middle_W - half_W, normal_W}, cores.slack};
}

Proximity convexProximity(const Shape& a, const Pose& X_WA, const Shape& b, const Pose& X_WB) {
  return certifiedProximity(a, X_WA, b, X_WB).proximity;
}

bool isNearer(const Shape& a, const Pose& X_WA, const Shape& b, const Pose& X_WB, double margin,
              Eigen::Vector3d& apart_A) {
  if (margin < 0) return !(convexProximity(a, X_WA, b, X_WB).distance >= margin);
  const ConvexCore coreA(a), coreB(b);
  const MinkowskiDifference difference(coreA, coreB, X_WA.inverse() * X_WB);
  const double radii = coreA.radius() + coreB.radius(), far = margin + radii + kCullSlack;
  if (apart_A.dot(difference.lowest(apart_A).x) >= far) return false;
  const CoreProximity cores = coreGap(difference, far);
  apart_A = cores.normal;
  return !(cores.distance > 0 && cores.distance - radii >= margin);
}

}  // namespace rex::internal
