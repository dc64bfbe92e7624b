#pragma once

#include "kinematics/forward_kinematics.h"

namespace rex {

/// Centre of mass of the whole scene in W, metres: sum of m_i p_i over the total mass (slide 2:61 lacks the
/// division: erratum 4). Throws Error for a scene without mass.
[[nodiscard]] Eigen::Vector3d centerOfMass(const Model& model, const BodyPoses& poses);

/// Its Jacobian: 3 x nv, metres per unit of v. Throws as centerOfMass.
[[nodiscard]] Eigen::Matrix3Xd centerOfMassJacobian(const Model& model, const BodyPoses& poses);
/// Overload for hot loops. The caller owns J, which must be 3 x nv already, and `moments`: column i becomes
/// the mass times the centre of mass, kg m in W, of body i with all its descendants (column 0: the whole
/// scene). It allocates nothing once `moments` has been used with this model.
void centerOfMassJacobian(const Model& model, const BodyPoses& poses, Eigen::Matrix3Xd& moments,
                          Eigen::Ref<Eigen::Matrix3Xd> J);

}  // namespace rex
