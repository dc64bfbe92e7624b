#pragma once

#include <functional>

#include "bench/robots.h"

namespace rex::bench {

/// The step that both sides take, s.
inline constexpr double kStep = 1e-3;

/// MuJoCo's step without contacts, from the robot's first posture on: of Runge and Kutta, with four
/// evaluations of the dynamics, or Euler's, with one. Throws std::logic_error where the former leads
/// elsewhere than ours. Empty without MuJoCo.
enum class PeerStep { kRungeKutta4, kEuler };
#ifdef REX_WITH_MUJOCO
[[nodiscard]] std::function<void()> mujocoStep(const Robot& robot, PeerStep kind);
#else
[[nodiscard]] inline std::function<void()> mujocoStep(const Robot&, PeerStep) { return {}; }
#endif

}  // namespace rex::bench
