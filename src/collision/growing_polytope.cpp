#include <algorithm>
#include <limits>

#include <Eigen/Geometry>

#include "collision/growing_polytope_internal.h"

namespace rex::internal {

using Eigen::Vector3d;

namespace {

constexpr double kNone = -std::numeric_limits<double>::infinity();

}  // namespace

GrowingPolytope::GrowingPolytope(const std::array<DifferencePoint, 4>& corners, double precision)
    : precision_(precision), cornerCount_(4), faceCount_(4) {
  std::copy(corners.begin(), corners.end(), corners_.begin());
  const Vector3d& p = corners[0].x;
  if ((corners[1].x - p).cross(corners[2].x - p).dot(corners[3].x - p) < 0)
    std::swap(corners_[0], corners_[1]);
  setFace(0, {0, 1, 2}, {1, 3, 2});
  setFace(1, {0, 3, 1}, {2, 3, 0});
  setFace(2, {0, 2, 3}, {0, 3, 1});
  setFace(3, {1, 3, 2}, {1, 2, 0});
}

void GrowingPolytope::setFace(int index, const std::array<int, 3>& corners,
                              const std::array<int, 3>& neighbours) {
  Face& face = faces_[index];
  const Vector3d& p = corners_[corners[0]].x;
  face.corners = corners;
  face.neighbours = neighbours;
  face.n = (corners_[corners[1]].x - p).cross(corners_[corners[2]].x - p).normalized();
  // A sliver without normal hides between its neighbours, which know its points.
  face.offset = face.n.squaredNorm() > 0 ? face.n.dot(p) : kNone;
}

int GrowingPolytope::nearestFace() const {
  const auto nearest = std::max_element(faces_.begin(), faces_.begin() + faceCount_,
                                        [](const Face& a, const Face& b) { return a.offset < b.offset; });
  return static_cast<int>(nearest - faces_.begin());
}

DifferencePoint GrowingPolytope::pointAgainst(const Vector3d& n) const {
  int hit = nearestFace();
  double way = kNone;
  for (int i = 0; i < faceCount_; ++i) {
    const double slope = faces_[i].n.dot(n);
    if (slope > 1e-9 && faces_[i].offset / slope > way) way = faces_[i].offset / slope, hit = i;
  }
  return pointOf(faces_[hit], way * n);
}

// The point x of the face, by its shares of the corners.
DifferencePoint GrowingPolytope::pointOf(const Face& face, const Vector3d& x) const {
  std::array<Vector3d, 3> to;
  for (int k = 0; k < 3; ++k) to[k] = corners_[face.corners[k]].x - x;
  Vector3d share;
  for (int k = 0; k < 3; ++k) share[k] = std::max(face.n.dot(to[(k + 1) % 3].cross(to[(k + 2) % 3])), 0.0);
  if (!(share.sum() > 0)) share.setOnes();
  share /= share.sum();
  DifferencePoint point{Vector3d::Zero(), Vector3d::Zero()};
  for (int k = 0; k < 3; ++k) {
    point.x += share[k] * corners_[face.corners[k]].x;
    point.onA += share[k] * corners_[face.corners[k]].onA;
  }
  return point;
}

bool GrowingPolytope::add(const DifferencePoint& point, int seen) {
  if (cornerCount_ == kMostCorners) return false;
  findSeen(point.x, seen);
  const bool hasRim = findRim();
  for (int i = 0; i < seenCount_; ++i) isSeen_[seen_[i]] = false;
  if (!hasRim) return false;
  corners_[cornerCount_] = point;
  coverRim(cornerCount_++);
  return true;
}

// Also where x would make a sliver with an edge: it lies in the plane beyond, and the sliver would have no
// normal.
bool GrowingPolytope::sees(const Vector3d& x, int face, int from, int to) const {
  if (faces_[face].n.dot(x) < faces_[face].offset - precision_) return true;
  const Vector3d edge = corners_[to].x - corners_[from].x;
  return edge.cross(x - corners_[from].x).squaredNorm() <= precision_ * precision_ * edge.squaredNorm();
}

void GrowingPolytope::findSeen(const Vector3d& x, int first) {
  seen_[0] = first;
  seenCount_ = 1;
  isSeen_[first] = true;
  for (int i = 0; i < seenCount_; ++i) {
    const Face& face = faces_[seen_[i]];
    for (int k = 0; k < 3; ++k) {
      const int beyond = face.neighbours[k];
      if (isSeen_[beyond] || !sees(x, beyond, face.corners[k], face.corners[(k + 1) % 3])) continue;
      isSeen_[beyond] = true;
      seen_[seenCount_++] = beyond;
    }
  }
}

// The edges around what is seen, one after the other; false unless they make one simple ring.
bool GrowingPolytope::findRim() {
  rimSize_ = 0;
  for (int i = 0; i < seenCount_; ++i) {
    const Face& face = faces_[seen_[i]];
    for (int k = 0; k < 3; ++k)
      if (!isSeen_[face.neighbours[k]])
        rim_[rimSize_++] = {face.corners[k], face.corners[(k + 1) % 3], face.neighbours[k], -1};
  }
  if (rimSize_ < 3) return false;
  const auto rimEnd = rim_.begin() + rimSize_;
  for (auto edge = rim_.begin(); edge + 1 != rimEnd; ++edge) {
    const auto startsHere = [&](const RimEdge& other) { return other.from == edge->to; };
    if (edge->to == rim_[0].from || std::count_if(edge + 1, rimEnd, startsHere) != 1) return false;
    std::iter_swap(edge + 1, std::find_if(edge + 1, rimEnd, startsHere));
  }
  return (rimEnd - 1)->to == rim_[0].from;
}

void GrowingPolytope::coverRim(int apex) {
  for (int i = 0; i < seenCount_; ++i) {
    faces_[seen_[i]].offset = kNone;
    free_[freeCount_++] = seen_[i];
  }
  for (int i = 0; i < rimSize_; ++i) rim_[i].face = freeCount_ > 0 ? free_[--freeCount_] : faceCount_++;
  for (int i = 0; i < rimSize_; ++i) {
    const auto& [from, to, beyond, face] = rim_[i];
    const int next = rim_[(i + 1) % rimSize_].face, previous = rim_[(i + rimSize_ - 1) % rimSize_].face;
    setFace(face, {from, to, apex}, {beyond, next, previous});
    Face& outer = faces_[beyond];
    for (int k = 0; k < 3; ++k)
      if (outer.corners[k] == to) outer.neighbours[k] = face;
  }
}

}  // namespace rex::internal
