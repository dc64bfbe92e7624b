#pragma once

#include <functional>

#include "bench/robots.h"

namespace rex::bench {

/// What a peer does with a robot at its posture k: all body poses; the six rows of the Jacobian at the tip's
/// origin, and the centre of mass with its Jacobian, each with the forward kinematics it needs. Empty: it
/// cannot.
struct KinematicsPeer {
  std::function<void(int k)> forwardKinematics{}, jacobian{}, centerOfMassJacobian{};
};

/// Throws std::logic_error unless both agree to 1e-10.
void requireAgreement(const std::string& what, const Eigen::MatrixXd& ours, const Eigen::MatrixXd& theirs);

/// The peers; throw std::logic_error where they compute anything else than rex. Without them all calls are
/// empty.
#ifdef REX_WITH_KDL
[[nodiscard]] KinematicsPeer kdlPeer(const Robot& robot);
#else
[[nodiscard]] inline KinematicsPeer kdlPeer(const Robot&) { return {}; }
#endif
#ifdef REX_WITH_MUJOCO
[[nodiscard]] KinematicsPeer mujocoPeer(const Robot& robot);
#else
[[nodiscard]] inline KinematicsPeer mujocoPeer(const Robot&) { return {}; }
#endif

}  // namespace rex::bench
