#pragma once

#include <optional>

#include <Eigen/Core>

#include "geometry/triangle_mesh.h"

namespace rex {

/// The reason why a matrix cannot be the inertia of any mass distribution: a negative principal moment, or
/// one that is larger than the sum of the two others (the triangle inequality).
enum class InertiaFault { kNone, kNegative, kTriangle };

/// Checks a symmetric inertia about the centre of mass, kg m^2, with a tolerance of 1e-6 of its trace.
[[nodiscard]] InertiaFault inertiaFault(const Eigen::Matrix3d& I);

/// The principal moments of a symmetric inertia, ascending, kg m^2.
[[nodiscard]] Eigen::Vector3d principalMoments(const Eigen::Matrix3d& I);

/// The symmetric matrix without negative principal moments that is nearest to I in the Frobenius norm:
/// negative moments become 0, and the axes stay (Higham 1988).
[[nodiscard]] Eigen::Matrix3d nearestWithoutNegativeMoments(const Eigen::Matrix3d& I);

/// How heavy a body is and where, in its frame B: kg, metres, kg m^2.
struct MassProperties {
  double mass = 0;
  Eigen::Vector3d p_BBcm{0, 0, 0};                     ///< centre of mass
  Eigen::Matrix3d I_BBcm_B = Eigen::Matrix3d::Zero();  ///< about the centre of mass, along the axes of B
};

/// What of a surface weighs.
enum class MeshMassRule {
  kEnclosed,  ///< what it encloses: the tetrahedra over its triangles, with signs (Eberly 2002)
  kUnsigned,  ///< the same tetrahedra without signs
  kShell,     ///< the surface itself
};

/// The mass properties of a mesh of density 1: kg/m^3, or kg/m^2 of a shell. The tips of the tetrahedra lie
/// at the centroid of the surface to find the centre of mass, and there to find all else, which is what
/// MuJoCo 3.3 does: so kUnsigned counts too much of a surface that is not visible as a whole from there,
/// and all numbers of a surface with holes depend on this choice. None below 1e-15 kg.
[[nodiscard]] MassProperties meshMass(const TriangleMesh& mesh, MeshMassRule rule);

/// The volume that a surface encloses once its holes are closed, each rim by triangles to its middle, m^3.
/// Empty for a surface without holes, whose triangles all have the same side outward.
[[nodiscard]] std::optional<double> volumeWithoutHoles(const TriangleMesh& mesh);

}  // namespace rex
