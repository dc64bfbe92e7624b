#pragma once

#include "scene/model.h"

namespace rex {

/// Forces of the joints themselves; each must be switched on.
struct JointForces {
  /// -damping v - friction tanh(v / frictionSpeed), with the numbers of the scene (Joint::damping, friction).
  bool friction = false;
  double frictionSpeed = 1e-2;  ///< at which friction has reached 76 % of its value, rad/s or m/s
  /// Limits push back with limitStiffness per unit by which a coordinate is beyond, and limitDamping per
  /// unit of v meanwhile: soft forces, N m/rad and N m s/rad, or N/m and N s/m. 0: limits have no effect.
  /// Quaternions have none.
  double limitStiffness = 0;
  double limitDamping = 0;
  [[nodiscard]] bool any() const { return friction || limitStiffness > 0 || limitDamping > 0; }
};

/// The forces (nv) that joints add to u. Throws Error for wrong sizes, and for settings that are negative
/// or not finite.
[[nodiscard]] Eigen::VectorXd jointForces(const Model& model, const VectorArg& q, const VectorArg& v,
                                          const JointForces& forces);
/// Overload for hot loops. The caller owns u, which must be nv already.
void jointForces(const Model& model, const VectorArg& q, const VectorArg& v, const JointForces& forces,
                 Eigen::Ref<Eigen::VectorXd> u);

/// Throws Error naming the setting that is negative or not finite, or a frictionSpeed of 0.
void requireValid(const JointForces& forces);

}  // namespace rex
