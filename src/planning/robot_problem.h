#pragma once

#include <limits>
#include <string>

#include "collision/contacts.h"
#include "collision/motion_clearance.h"
#include "planning/path_problem.h"
#include "planning/space.h"

namespace rex {

/// The space of a robot's postures: hinges and sliders within their limits, hinge and screw angles without
/// limits as circles, and quaternions. Throws Error naming a joint that slides without limits.
[[nodiscard]] Space postureSpace(const Model& model);

/// Valid if all pairs of shapes are at least `margin` metres apart. It takes many postures at once. It
/// copies what it needs from the model and owns a workspace: threads must not share one.
[[nodiscard]] AllValid contactFree(const Model& model, const ContactModel& contacts, double margin = 0);

/// The pair of shapes that is nearest: its distance, metres, negative in overlap and infinite if all are far
/// apart, and which it is, for messages.
struct NearestContact {
  double distance = std::numeric_limits<double>::infinity();
  std::string text = "all shapes apart";
};
[[nodiscard]] NearestContact nearestContact(const Model& model, const ContactModel& contacts,
                                            const VectorArg& q);

/// The problem of moving a robot from `start` to `goal` with all pairs at least `margin` metres apart.
/// `resolution` as in PathProblem. Copies what it needs from the model.
[[nodiscard]] PathProblem robotProblem(const Model& model, const ContactModel& contacts,
                                       const VectorArg& start, const VectorArg& goal, double margin = 0,
                                       double resolution = 0.01);

/// Bounds on the smallest distance of all pairs of shapes along a path (one posture per column), metres,
/// also between the postures that a planner checked; see clearanceBounds(). They are at most `tolerance`
/// apart, unless a segment needs more than 500 000 distances. The motion is that of Space::interpolate(),
/// for ball joints up to a millionth of a radian. Throws Error for a path without postures, and like
/// clearanceBounds().
[[nodiscard]] ClearanceBounds pathClearance(const Model& model, const ContactModel& contacts,
                                            const Space& space, const MatrixArg& path,
                                            double tolerance = 1e-3);

}  // namespace rex
