#pragma once

#include <array>
#include <cstddef>
#include <memory_resource>
#include <vector>

#include "collision/minkowski_difference_internal.h"

namespace rex::internal {

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

}  // namespace rex::internal
