#pragma once

#include "kinematics/forward_kinematics.h"

namespace rex {

/// Centre of mass of the whole scene in W, metres: sum of m_i p_i over the total mass (slide 2:61 lacks the
/// division, see the errata). Throws Error for a scene without mass.
[[nodiscard]] Eigen::Vector3d centerOfMass(const Model& model, const BodyPoses& poses);

/// Its Jacobian: 3 x nv, metres per unit of v. Throws as centerOfMass.
[[nodiscard]] Eigen::Matrix3Xd centerOfMassJacobian(const Model& model, const BodyPoses& poses);

}  // namespace rex
