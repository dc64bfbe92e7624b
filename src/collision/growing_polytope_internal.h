#pragma once

#include <array>

#include "collision/core_difference_internal.h"

namespace rex::internal {

/// A convex polytope of triangles that grows by points outside of it. Its normals point inwards. Holds all it
/// needs in itself, some 100 kB.
class GrowingPolytope {
 public:
  static constexpr int kMostCorners = 512;

  struct Face {
    std::array<int, 3> corners;
    std::array<int, 3> neighbours;  ///< [k] lies beyond the edge from corner k to the next
    Eigen::Vector3d n;
    double offset;  ///< n.x of its points; of a face that is gone, minus infinity
  };

  /// A tetrahedron. What is nearer than `precision` metres counts as equal.
  GrowingPolytope(const std::array<DifferencePoint, 4>& corners, double precision);

  /// The face with the largest offset: the one nearest to the origin, if that lies inside.
  [[nodiscard]] int nearestFace() const;
  [[nodiscard]] const Face& face(int index) const { return faces_[index]; }
  /// Where the line from the origin along -n leaves the polytope.
  [[nodiscard]] DifferencePoint pointAgainst(const Eigen::Vector3d& n) const;

  /// Adds a point below the face `seen`. False, and nothing has changed, if there is no room, or if rounding
  /// left no simple rim around the faces that the point sees.
  [[nodiscard]] bool add(const DifferencePoint& point, int seen);

 private:
  static constexpr int kMostFaces = 2 * kMostCorners;
  // An edge between a face that is seen and one that is not; `face` will take the place of the former.
  struct RimEdge {
    int from, to, beyond, face;
  };

  void setFace(int index, const std::array<int, 3>& corners, const std::array<int, 3>& neighbours);
  bool sees(const Eigen::Vector3d& x, int face, int from, int to) const;
  void findSeen(const Eigen::Vector3d& x, int first);
  bool findRim();
  void coverRim(int apex);
  DifferencePoint pointOf(const Face& face, const Eigen::Vector3d& x) const;

  double precision_;
  int cornerCount_ = 0, faceCount_ = 0, freeCount_ = 0, seenCount_ = 0, rimSize_ = 0;
  std::array<DifferencePoint, kMostCorners> corners_;
  std::array<Face, kMostFaces> faces_;
  std::array<bool, kMostFaces> isSeen_{};
  std::array<int, kMostFaces> free_, seen_;
  std::array<RimEdge, kMostFaces> rim_;
};

}  // namespace rex::internal
