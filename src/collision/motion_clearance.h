#pragma once

#include "collision/contact_model.h"

namespace rex {

/// Bounds of the smallest distance of all pairs during a motion, metres: `atLeast` is proven, `atMost` was
/// measured at some point. Infinite without pairs.
struct ClearanceBounds {
  double atLeast = 0, atMost = 0;
};

/// Bounds, at most `tolerance` apart, of the smallest distance of all pairs while q moves straight from
/// `from` to `to`, metres; negative in overlap. It bisects intervals of the motion in which a pair could
/// come nearer than at the ends, given how fast the joints can move any point (conservative advancement). A
/// pair at constant distance takes time proportional to 1/tolerance; after 500 000 distances it returns the
/// bounds proven so far, which may be farther apart. Throws Error for vectors that are not nq long or not
/// finite, a tolerance below 1e-9, and a quaternion that is zero on the way.
[[nodiscard]] ClearanceBounds clearanceBounds(const Model& model, const ContactModel& contacts,
                                              const VectorArg& from, const VectorArg& to, double tolerance);

/// The lower of these bounds. Throws as clearanceBounds().
[[nodiscard]] double motionClearance(const Model& model, const ContactModel& contacts, const VectorArg& from,
                                     const VectorArg& to, double tolerance);

}  // namespace rex
