#pragma once

#include <span>
#include <vector>

#include "base/require.h"
#include "grasping/object_surface.h"

namespace rex {

/// Makes forces and torques comparable: torques are taken about the point R and divided by `length`
/// (metres), so that all entries of a wrench are newtons. In the plane only x and y of R count. Closure
/// does not depend on either, quality does: `length` is often the largest distance of the surface from the
/// centre of mass, so that no torque of a unit force exceeds one.
struct WrenchReference {
  Eigen::Vector3d p_OR{0, 0, 0};
  double length = 1;
};

/// The wrenches that one contact can exert, per newton of normal force: normal + tangents t with |t| at
/// most `friction`, in O. In space a wrench is (fx, fy, fz, tx, ty, tz) and has two tangents, in the plane
/// (fx, fy, tz) and one; the torque is (p_OC - p_OR) x f / length. Slide 10:6, whose cross product has the
/// opposite order.
struct WrenchCone {
  Eigen::VectorXd normal{};    ///< d = 6 or 3
  Eigen::MatrixXd tangents{};  ///< d x 2 or 3 x 1
  double friction = 0;

  /// The wrench with one newton of normal force that is lowest along `direction` (d); it lies on the rim.
  [[nodiscard]] Eigen::VectorXd lowest(const VectorArg& direction) const;
};

/// The cones of contacts, in their order. Throws Error like requireValid(), naming the contact, for a
/// length that is not positive, and for a reference that is not finite.
[[nodiscard]] std::vector<WrenchCone> wrenchCones(std::span<const Contact> contacts,
                                                  const WrenchReference& reference = {});
[[nodiscard]] std::vector<WrenchCone> wrenchCones(std::span<const PlanarContact> contacts,
                                                  const WrenchReference& reference = {});

/// The wrench of a weight, in space d = 6: mass times gravity_O (m/s^2), at the centre of mass p_OM. Throws
/// Error like wrenchCones(), and for numbers that are not finite.
[[nodiscard]] Eigen::VectorXd weightWrench(double mass, const Eigen::Vector3d& p_OM,
                                           const Eigen::Vector3d& gravity_O,
                                           const WrenchReference& reference = {});

/// Wrenches of single edges of cones, one per column.
struct WrenchSet {
  Eigen::MatrixXd wrenches{};  ///< d x N
  std::vector<int> contact{};  ///< N: the contact of each
};

/// The edges of a pyramid inside each cone, each with one newton along the normal. In space these are
/// `edges` evenly spaced ones, the first along the first tangent; in the plane the two that bound the cone;
/// for a contact without friction only the normal. Throws Error for fewer than three edges and for cones of
/// different sizes or numbers of tangents.
[[nodiscard]] WrenchSet primitiveWrenches(std::span<const WrenchCone> cones, int edges = 8);

}  // namespace rex
