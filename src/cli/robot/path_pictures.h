#pragma once

#include <string>
#include <vector>

#include "cli/robot/path_search.h"
#include "cli/robot/posture_option.h"
#include "planning/motion_limits.h"
#include "planning/timed_path.h"
#include "render/figure.h"
#include "render/picture.h"

namespace rex::cli {

/// The body whose way a picture shows unless told otherwise: the first of those that most joints move.
[[nodiscard]] BodyId farthestBody(const Model& model);

/// What a search explored, in the workspace: the ways of a body's origin between joined configurations, each
/// tree in its own colour, and the path on top; around them the scene at the start, and faintly at the goal.
[[nodiscard]] Picture exploredPicture(const PathTask& task, BodyId body, const FoundPath& found);

/// The joints over time.
[[nodiscard]] Figure jointsFigure(const Model& model, const Motion& motion);

/// The speeds of joints over time, as shares of their limits, and a line at 1.
[[nodiscard]] Figure speedsFigure(const TimedPath& timed, const MotionLimits& limits);

/// The distance of the nearest pair of shapes over time, beside the margin (metres). There must be a pair.
[[nodiscard]] Figure clearanceFigure(const Model& model, const ContactModel& contacts, const Motion& motion,
                                     double margin);

}  // namespace rex::cli
