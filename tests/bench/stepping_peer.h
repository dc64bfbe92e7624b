#pragma once

#include <functional>

#include "bench/robots.h"

namespace rex::bench {

/// The step that both sides take, s.
inline constexpr double kStep = 1e-3;

/// MuJoCo's step of Runge and Kutta, without contacts, from the robot's first posture on. Throws
/// std::logic_error where it leads elsewhere than ours. Empty without MuJoCo.
#ifdef REX_WITH_MUJOCO
[[nodiscard]] std::function<void()> mujocoStep(const Robot& robot);
#else
[[nodiscard]] inline std::function<void()> mujocoStep(const Robot&) { return {}; }
#endif

}  // namespace rex::bench
