#pragma once

#include "collision/contact_model.h"
#include "planning/space.h"

namespace rex {

/// The smallest distance of all pairs of shapes all along a path (a posture per column), metres: as
/// motionClearance() of each piece, so it is at most `tolerance` below the truth, also between the postures
/// that planners looked at. Angles of circles turn the shorter way round, ball joints along the chord of
/// their quaternions. Throws Error for a path without postures, and as motionClearance().
[[nodiscard]] double pathClearance(const Model& model, const ContactModel& contacts, const Space& space,
                                   const MatrixArg& path, double tolerance = 1e-3);

}  // namespace rex
