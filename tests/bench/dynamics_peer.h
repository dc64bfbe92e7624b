#pragma once

#include <functional>

#include "bench/robots.h"

namespace rex::bench {

/// A robot at its postures in motion: velocities, accelerations and forces, one per column.
struct MovingRobot : Robot {
  Eigen::MatrixXd V, A, U;
  /// (q, v), nq + nv.
  [[nodiscard]] Eigen::VectorXd state(int k) const {
    Eigen::VectorXd x(Q.rows() + V.rows());
    x << Q.col(k), V.col(k);
    return x;
  }
};
/// The step of the derivatives of steps, seconds.
inline constexpr double kStepSeconds = 0.002;
[[nodiscard]] std::vector<MovingRobot> movingRobots();

/// What a peer does with a robot in its state k, with the kinematics it needs. Empty: it cannot.
struct DynamicsPeer {
  std::function<void(int k)> inverseDynamics{}, massMatrix{}, forwardDynamics{}, stepDerivatives{};
};

/// Throws std::logic_error where it computes anything else than rex. Without MuJoCo all calls are empty.
#ifdef REX_WITH_MUJOCO
[[nodiscard]] DynamicsPeer mujocoDynamicsPeer(const MovingRobot& robot);
#else
[[nodiscard]] inline DynamicsPeer mujocoDynamicsPeer(const MovingRobot&) { return {}; }
#endif

}  // namespace rex::bench
