#pragma once

#include <vector>

#include <Eigen/Core>

#include "base/rng.h"
#include "geometry/shape.h"

namespace rex {

/// A finger that touches an object at a point C, in the object's frame O. `normal_O` is a unit vector into
/// the object. The finger exerts any force f whose tangential part is at most friction times f.normal_O:
/// the friction cone of slide 10:6. Without friction it only pushes along the normal, as on slide 10:5.
struct Contact {
  Eigen::Vector3d p_OC{0, 0, 0};
  Eigen::Vector3d normal_O{1, 0, 0};
  double friction = 0;
};

/// The same in the plane.
struct PlanarContact {
  Eigen::Vector2d p_OC{0, 0};
  Eigen::Vector2d normal_O{1, 0};
  double friction = 0;
};

/// The axes of the contact frame C in O, 3 x 3 or 2 x 2: first the normal, then the tangents. If the normal
/// is an axis of O, so are the tangents. In space it is a rotation; in the plane the tangent is the normal
/// turned to the left.
[[nodiscard]] Eigen::Matrix3d contactFrame(const Contact& contact);
[[nodiscard]] Eigen::Matrix2d contactFrame(const PlanarContact& contact);

/// Throws Error for numbers that are not finite, a normal that is not a unit vector within 1e-6, and
/// negative friction.
void requireValid(const Contact& contact);
void requireValid(const PlanarContact& contact);

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

/// The gripper with two opposite jaws for which candidates are sampled.
struct AntipodalOptions {
  double friction = 0.5;
  double maxWidth = 0.1;  ///< opening of the jaws, metres
};

/// Two contacts whose connecting line lies in both friction cones: `a` and `b` push towards each other.
struct AntipodalGrasp {
  Contact a, b;
  double width = 0;  ///< distance between them, metres
};

/// The grasps found, and why other candidates were rejected.
struct AntipodalGrasps {
  std::vector<AntipodalGrasp> grasps{};
  int tries = 0;
  int notOpposite = 0;  ///< the surface at the other end is too slanted
  int tooWide = 0;
  int blocked = 0;  ///< another part of the object is where the open jaws would be
};

/// Samples grasps by two jaws that move along one line (criterion of Nguyen, 1988): `tries` points of the
/// surface, each with a random line in its friction cone, uniform over the cone's cross-section; a ray
/// finds the other contact. A grasp is reachable if it is at most maxWidth wide and the line outside the
/// contacts is free as far as the jaws open, symmetrically to both sides. Throws Error for negative tries
/// and options out of range.
[[nodiscard]] AntipodalGrasps sampleAntipodal(const ObjectSurface& surface, Rng& rng, int tries,
                                              const AntipodalOptions& options = {});

/// Contacts that push into the surface at these points. Throws like requireValid().
[[nodiscard]] std::vector<Contact> contactsAt(const std::vector<SurfacePoint>& points, double friction);

}  // namespace rex
