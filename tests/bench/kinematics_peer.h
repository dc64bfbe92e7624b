#pragma once

#include <functional>

#include "bench/robots.h"

namespace rex::bench {

/// What a peer does with a robot at its posture k: all body poses; the six rows of the Jacobian at the tip's
/// origin, with the forward kinematics it needs. Empty: it is not installed.
struct KinematicsPeer {
  std::function<void(int k)> forwardKinematics{}, jacobian{};
};

/// Throws std::logic_error unless both agree to 1e-10.
void requireAgreement(const std::string& what, const Eigen::MatrixXd& ours, const Eigen::MatrixXd& theirs);

/// Throws std::logic_error where KDL computes anything else than rex.
#ifdef REX_WITH_KDL
[[nodiscard]] KinematicsPeer kdlPeer(const Robot& robot);
#else
[[nodiscard]] inline KinematicsPeer kdlPeer(const Robot&) { return {}; }
#endif

}  // namespace rex::bench
