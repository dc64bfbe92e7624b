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

/// The body whose trace a picture shows by default: the first of those moved by the most joints.
[[nodiscard]] BodyId farthestBody(const Model& model);

/// What a search explored, in the workspace: the traces of a body's origin between connected
/// configurations, each tree in its own colour, and the path on top; also the scene at the start and,
/// faintly, at the goal.
[[nodiscard]] Picture exploredPicture(const PathTask& task, BodyId body, const FoundPath& found);

/// The joint positions over time.
[[nodiscard]] Figure jointsFigure(const Model& model, const Motion& motion);

/// The joint speeds over time, as fractions of their limits, with a line at 1.
[[nodiscard]] Figure speedsFigure(const TimedPath& timed, const MotionLimits& limits);

/// The distance of the nearest pair of shapes over time, with the margin (metres). There must be at least
/// one pair.
[[nodiscard]] Figure clearanceFigure(const Model& model, const ContactModel& contacts, const Motion& motion,
                                     double margin);

}  // namespace rex::cli
