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

/// The posture (nq) that is found for target k, as good as it is.
using SolveIk = std::function<Eigen::VectorXd(std::size_t k)>;

/// KDL's solver by Levenberg and Marquardt, which knows no joint limits. Empty: it is not installed.
#ifdef REX_WITH_KDL
[[nodiscard]] SolveIk kdlMarquardt(const ReachableRobot& robot);
#else
[[nodiscard]] inline SolveIk kdlMarquardt(const ReachableRobot&) { return {}; }
#endif

}  // namespace rex::bench
