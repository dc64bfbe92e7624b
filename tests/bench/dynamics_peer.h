#pragma once

#include <functional>

#include "bench/robots.h"

namespace rex::bench {

/// A robot at its postures in motion: velocities, accelerations and forces, one per column.
struct MovingRobot : Robot {
  Eigen::MatrixXd V, A, U;
};
[[nodiscard]] std::vector<MovingRobot> movingRobots();

/// What a peer does with a robot in its state k, with the kinematics it needs. Empty: it cannot.
struct DynamicsPeer {
  std::function<void(int k)> inverseDynamics{}, forwardDynamics{};
};

/// Throws std::logic_error where it computes anything else than rex. Without MuJoCo all calls are empty.
#ifdef REX_WITH_MUJOCO
[[nodiscard]] DynamicsPeer mujocoDynamicsPeer(const MovingRobot& robot);
#else
[[nodiscard]] inline DynamicsPeer mujocoDynamicsPeer(const MovingRobot&) { return {}; }
#endif

}  // namespace rex::bench
