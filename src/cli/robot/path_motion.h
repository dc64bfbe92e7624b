#pragma once

#include <string>

#include "cli/robot/posture_option.h"
#include "planning/timed_path.h"

namespace rex::cli {

/// Postures of a motion, `rate` per second, and its end, so that the last interval may be shorter.
[[nodiscard]] Motion motionOf(const TimedPath& timed, double rate);

/// The motion as a table: "time", then the joints by name, separated by commas; a motion for readMotion().
[[nodiscard]] std::string csvOf(const Model& model, const Motion& motion);

}  // namespace rex::cli
