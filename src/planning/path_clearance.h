#pragma once

#include "collision/motion_clearance.h"
#include "planning/space.h"

namespace rex {

/// The smallest distance of all pairs of shapes all along a path (a posture per column), metres, also between
/// the postures that planners looked at: bounds as clearanceBounds() gives them for each piece. They are at
/// most `tolerance` apart, unless a piece asks for more than 500 000 distances. The way is that of
/// Space::interpolate(), with ball joints a millionth of a radian off at most. Throws Error for a path
/// without postures, and as clearanceBounds().
[[nodiscard]] ClearanceBounds pathClearance(const Model& model, const ContactModel& contacts,
                                            const Space& space, const MatrixArg& path,
                                            double tolerance = 1e-3);

}  // namespace rex
