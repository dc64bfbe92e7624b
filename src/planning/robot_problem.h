#pragma once

#include "collision/contact_model.h"
#include "planning/path_problem.h"

namespace rex {

/// The postures of a robot as a space: hinges and sliders within their limits; hinges and screws' angles
/// without any as circles; quaternions. Throws Error naming a joint that slides without limits.
[[nodiscard]] Space postureSpace(const Model& model);

/// Valid where all pairs of shapes are at least `margin` metres apart. It takes many postures at once, keeps
/// what it needs of the model, and room to work in: threads must not share one.
[[nodiscard]] AllValid contactFree(const Model& model, const ContactModel& contacts, double margin = 0);

/// Which pair of shapes is nearest at q, and how near; for messages.
[[nodiscard]] std::string nearestContact(const Model& model, const ContactModel& contacts,
                                         const VectorArg& q);

/// A way for a robot from posture to posture that keeps all pairs `margin` metres apart. `resolution` as in
/// PathProblem. Keeps what it needs of the model.
[[nodiscard]] PathProblem robotProblem(const Model& model, const ContactModel& contacts,
                                       const VectorArg& start, const VectorArg& goal, double margin = 0,
                                       double resolution = 0.01);

}  // namespace rex
