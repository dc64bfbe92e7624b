#pragma once

#include "collision/contact_model.h"

namespace rex {

/// The smallest distance of all pairs while q moves straight from `from` to `to`, metres: a lower bound, at
/// most `tolerance` metres below the truth. Negative in overlap, infinite without pairs. It halves stretches
/// of the motion whose ends allow that a pair comes nearer in between, given how fast the joints can move any
/// point (conservative advancement). A pair that keeps one distance takes time in proportion to 1/tolerance;
/// after 500 000 distances the bound is returned that they prove, which may be more than the tolerance below.
/// Throws Error for vectors that are not nq long or not finite, a tolerance below 1e-9, and a quaternion that
/// is zero on the way.
[[nodiscard]] double motionClearance(const Model& model, const ContactModel& contacts, const VectorArg& from,
                                     const VectorArg& to, double tolerance);

}  // namespace rex
