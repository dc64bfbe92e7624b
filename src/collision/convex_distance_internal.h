#pragma once

#include "collision/proximity.h"

namespace rex::internal {

/// A proximity and how sure it is: the distance is the true one within `slack`, metres.
struct CertifiedProximity {
  Proximity proximity;
  double slack = 0;
};

/// The proximity of two convex solids that pass requireSolid(), by their support points alone. The slack is
/// at most 1e-10 m where the cores (see Core) lie apart or have flat sides, 1e-9 if a core is flat, and 5e-7
/// where that of a cylinder is overlapped. It may be more only between cylinders of more than 10 m radius
/// around one axis, where too many directions lead out on ways of nearly one length. Such cases cost
/// milliseconds.
[[nodiscard]] CertifiedProximity certifiedProximity(const Shape& a, const Pose& X_WA, const Shape& b,
                                                    const Pose& X_WB);
[[nodiscard]] Proximity convexProximity(const Shape& a, const Pose& X_WA, const Shape& b, const Pose& X_WB);

/// Whether they are nearer than `margin` metres, or not a number. Only for a negative margin does it find out
/// how deep cores overlap; for others those that touch are nearer. `apart_A`, a unit vector that may
/// tell them apart, becomes the one that was found, for the next posture; the answer does not depend on it.
[[nodiscard]] bool isNearer(const Shape& a, const Pose& X_WA, const Shape& b, const Pose& X_WB, double margin,
                            Eigen::Vector3d& apart_A);

}  // namespace rex::internal
