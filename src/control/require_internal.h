#pragma once

#include "base/require.h"
#include "control/pd_gains.h"
#include "scene/state.h"

namespace rex::internal {

inline void requireFinite(const PdGains& gains) {
  rex::requireFinite("gain Kp", gains.Kp);
  rex::requireFinite("gain Kd", gains.Kd);
}

inline void requireFinite(const State& state) {
  rex::requireFinite("joint positions q", state.q);
  rex::requireFinite("joint velocities v", state.v);
}

}  // namespace rex::internal
