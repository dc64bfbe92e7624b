#pragma once

#include <string>

#include "cli/robot/posture_option.h"
#include "planning/space.h"

namespace rex::cli {

/// The path, one posture per column, at a speed in the metric of the space: all its postures, and others
/// between them, so that no two are more than `gap` seconds apart. Postures that repeat are left out.
[[nodiscard]] Motion timedPath(const Space& space, const MatrixArg& path, double speed, double gap);

/// The motion at `rate` postures per second, which lie on its straight ways; the last one is always there.
[[nodiscard]] Motion resampled(const Space& space, const Motion& motion, double rate);

/// The motion as a table: "time", then the joints by name, separated by commas; a motion for readMotion().
[[nodiscard]] std::string csvOf(const Model& model, const Motion& motion);

}  // namespace rex::cli
