#include <algorithm>
#include <limits>

#include <Eigen/Geometry>

#include "collision/expanding_polytope_internal.h"

namespace rex::internal {

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

}  // namespace rex::internal
