#pragma once

#include <vector>

#include "base/rng.h"
#include "geometry/shape.h"
#include "grasping/contact.h"

namespace rex {

/// A point of a surface in the object's frame O, metres, with the outward unit normal.
struct SurfacePoint {
  Eigen::Vector3d p_OQ, normal_O;
};

/// An intersection of a line with a surface, `t` metres from the line's origin along its direction;
/// negative if behind the origin.
struct LineHit {
  double t = 0;
  Eigen::Vector3d normal_O;  ///< unit, out of the object
};

/// The surface of a closed solid in its own frame O, to place fingers on. Boxes, spheres, capsules,
/// cylinders and cones are exact, meshes are sets of triangles in double precision.
class ObjectSurface {
 public:
  /// Throws Error for other types of shapes, sizes that are not positive and finite, and a mesh without
  /// area or triangles. A capsule may have no straight part.
  explicit ObjectSurface(const Shape& shape);

  [[nodiscard]] double area() const;  ///< m^2
  /// `count` points, uniform by area, with the normal of the face or triangle. Throws Error for count < 0.
  [[nodiscard]] std::vector<SurfacePoint> sample(Rng& rng, int count) const;
  /// All intersections of the line p_OQ + t direction with the surface, sorted by t. At a common edge both
  /// triangles may count. Throws Error for a direction that is not a unit vector, and numbers that are not
  /// finite.
  [[nodiscard]] std::vector<LineHit> hits(const Eigen::Vector3d& p_OQ,
                                          const Eigen::Vector3d& direction_O) const;

 private:
  struct Triangle {
    Eigen::Vector3d corner, edge1, edge2, normal;
  };
  [[nodiscard]] bool isRound() const;
  void addTriangle(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c);
  void addBox();
  void addMesh(const TriangleMesh& mesh);
  [[nodiscard]] std::vector<double> roundAreas() const;
  [[nodiscard]] SurfacePoint sampleRound(Rng& rng) const;
  [[nodiscard]] SurfacePoint sampleCone(Rng& rng) const;
  [[nodiscard]] SurfacePoint sampleTriangle(Rng& rng) const;
  [[nodiscard]] std::vector<LineHit> roundHits(const Eigen::Vector3d& p, const Eigen::Vector3d& d) const;
  [[nodiscard]] std::vector<LineHit> coneHits(const Eigen::Vector3d& p, const Eigen::Vector3d& d) const;
  [[nodiscard]] std::vector<LineHit> triangleHits(const Eigen::Vector3d& p, const Eigen::Vector3d& d) const;

  ShapeType type_;
  Eigen::Vector3d half_{0, 0, 0};  // half edges; of round shapes z is half the straight part
  double radius_ = 0;
  std::vector<Triangle> triangles_;  // of meshes and boxes
  std::vector<double> areas_;        // of triangles or of the parts of round shapes, summed up
};

}  // namespace rex
