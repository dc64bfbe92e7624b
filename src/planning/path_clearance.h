#pragma once

#include "collision/motion_clearance.h"
#include "planning/space.h"

namespace rex {

/// Bounds on the smallest distance of all pairs of shapes along a path (one posture per column), metres,
/// also between the postures that a planner checked; see clearanceBounds(). They are at most `tolerance`
/// apart, unless a segment needs more than 500 000 distances. The motion is that of Space::interpolate(),
/// for ball joints up to a millionth of a radian. Throws Error for a path without postures, and like
/// clearanceBounds().
[[nodiscard]] ClearanceBounds pathClearance(const Model& model, const ContactModel& contacts,
                                            const Space& space, const MatrixArg& path,
                                            double tolerance = 1e-3);

}  // namespace rex
