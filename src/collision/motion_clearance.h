#pragma once

#include "collision/contact_model.h"

namespace rex {

/// The smallest distance of all pairs on a motion lies between these, metres: `atLeast` is proven, `atMost`
/// was measured somewhere. Infinite without pairs.
struct ClearanceBounds {
  double atLeast = 0, atMost = 0;
};

/// The smallest distance of all pairs while q moves straight from `from` to `to`, metres: bounds that
/// are at most `tolerance` apart. Negative in overlap. It halves stretches of the motion whose ends allow
/// that a pair comes nearer in between, given how fast the joints can move any point (conservative
/// advancement). A pair that keeps one distance takes time in proportion to 1/tolerance; after 500 000
/// distances the bounds are returned that they prove, which may be farther apart. Throws Error for vectors
/// that are not nq long or not finite, a tolerance below 1e-9, and a quaternion that is zero on the way.
[[nodiscard]] ClearanceBounds clearanceBounds(const Model& model, const ContactModel& contacts,
                                              const VectorArg& from, const VectorArg& to, double tolerance);

/// The lower of these bounds. Throws as clearanceBounds().
[[nodiscard]] double motionClearance(const Model& model, const ContactModel& contacts, const VectorArg& from,
                                     const VectorArg& to, double tolerance);

}  // namespace rex
