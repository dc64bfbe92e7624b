#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scene/model.h"

namespace rex {

/// Postures (nq each) and their times, seconds.
struct LiveRecording {
  std::vector<double> times{};
  std::vector<Eigen::VectorXd> postures{};
  std::optional<double> floor{};  ///< the height of the last one simulated on, metres
};

/// The recording as a page for browsers, as `rex simulate -o NAME.html` makes it. Throws Error as
/// reportPage(), and for an empty recording.
[[nodiscard]] std::string replayOf(const Model& model, const LiveRecording& recording);

/// A table with the names of the columns: time, then q. `rex render --motion` reads it.
[[nodiscard]] std::string tableOf(const Model& model, const LiveRecording& recording);

}  // namespace rex
