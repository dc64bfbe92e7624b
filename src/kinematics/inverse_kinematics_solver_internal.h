#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "scene/state.h"

namespace rex::internal {

/// The limits of the coordinates that have any, with their places in q and v.
struct JointLimit {
  int iq, iv;
  double lower, upper;
};

inline std::vector<JointLimit> limitedCoordinates(const Model& model) {
  std::vector<JointLimit> limits;
  forEachPlainCoordinate(model, [&](int iq, int iv, const DegreeOfFreedom&) {
    const double lower = model.lowerLimits()[iq], upper = model.upperLimits()[iq];
    if (std::isfinite(lower) || std::isfinite(upper)) limits.push_back({iq, iv, lower, upper});
  });
  return limits;
}

/// Moves each coordinate that is beyond a limit exactly onto it.
inline void clampToLimits(const std::vector<JointLimit>& limits, Eigen::VectorXd& q) {
  for (const JointLimit& limit : limits) q[limit.iq] = std::clamp(q[limit.iq], limit.lower, limit.upper);
}

}  // namespace rex::internal
