#pragma once

#include <string>
#include <vector>

#include "render/picture.h"
#include "systems/racer.h"

namespace rex {

/// The content of a picture of racers, side by side in lanes 0.3 m wide, such as one before and one after
/// learning.
struct RacerView {
  Eigen::Matrix4Xd x{};              ///< states (x, theta, x', theta'), the nearest first
  std::vector<std::string> names{};  ///< one for each racer, drawn above it; or none
  std::string caption{};             ///< in the top left corner
  RacerDynamics dynamics{};          ///< for their lengths
};

/// Draws wheels, with crosses that show how they turn, and pendulums. Throws Error for numbers that are not
/// finite, if the number of names is not that of racers, and if there is no racer.
[[nodiscard]] Picture racerPicture(const RacerView& view);

}  // namespace rex
