#pragma once

#include <Eigen/Core>

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

}  // namespace rex
