#pragma once

#include <functional>

#include "scene/model.h"

namespace rex::bench {

/// A robot, and poses X_WT that its tip can reach within the joint limits. Solvers start at the middle of all
/// joints.
struct ReachableRobot {
  std::string name;
  Model model;
  BodyId tip;
  Eigen::VectorXd middle;
  std::vector<Pose> targets;
};

/// The postures (nq) that two solvers of a peer find for target k, as good as they are. Empty: it is not
/// installed.
struct IkPeer {
  using Solve = std::function<Eigen::VectorXd(std::size_t k)>;
  Solve levenbergMarquardt{};  ///< knows no joint limits
  Solve newtonWithLimits{};
};

#ifdef REX_WITH_KDL
[[nodiscard]] IkPeer kdlIkPeer(const ReachableRobot& robot);
#else
[[nodiscard]] inline IkPeer kdlIkPeer(const ReachableRobot&) { return {}; }
#endif

}  // namespace rex::bench
