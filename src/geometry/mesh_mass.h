#pragma once

#include <optional>

#include "geometry/triangle_mesh.h"

namespace rex {

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
