#pragma once

#include <cmath>
#include <string>

#include <fmt/format.h>

#include "base/error.h"
#include "base/require_finite.h"
#include "control/pd_gains.h"
#include "scene/state.h"

namespace rex::internal {

inline void requirePositive(const std::string& what, double number) {
  if (!(number > 0) || !std::isfinite(number))
    throw Error({.what = what, .found = fmt::format("{:g}", number), .wanted = "a positive number"});
}

inline void requireNotNegative(const std::string& what, double number) {
  if (!(number >= 0) || !std::isfinite(number))
    throw Error(
        {.what = what, .found = fmt::format("{:g}", number), .wanted = "a number that is not negative"});
}

inline void requireFinite(const PdGains& gains) {
  rex::requireFinite("gain Kp", gains.Kp);
  rex::requireFinite("gain Kd", gains.Kd);
}

inline void requireFinite(const State& state) {
  rex::requireFinite("joint positions q", state.q);
  rex::requireFinite("joint velocities v", state.v);
}

}  // namespace rex::internal
