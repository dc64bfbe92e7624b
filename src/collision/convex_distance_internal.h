#pragma once

#include "collision/proximity.h"

namespace rex::internal {

/// A proximity and how sure it is: the true distance lies within [distance, distance + slack], metres.
struct CertifiedProximity {
  Proximity proximity;
  double slack = 0;
};

/// The proximity of two convex solids of any type, by their support points alone. The slack is 1e-10 where
/// the cores lie apart or have flat sides, 5e-7 where the core of a cylinder is overlapped; more, up to 1e-4
/// of the size, only where some hundred directions out of an overlap are equally short within that. Throws
/// Error for a marker, and for a shape that needs a mesh and has none.
[[nodiscard]] CertifiedProximity certifiedProximity(const Shape& a, const Pose& X_WA, const Shape& b,
                                                    const Pose& X_WB);
[[nodiscard]] Proximity convexProximity(const Shape& a, const Pose& X_WA, const Shape& b, const Pose& X_WB);

}  // namespace rex::internal
