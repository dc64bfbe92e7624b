#include "course/simulator.h"
#include "kinematics/inverse_kinematics_solver.h"
#include "kinematics/task_maps.h"

namespace rex {
namespace {

constexpr double kReach = 1e-6;  // metres and radians

ReachedPosture reach(const Simulator& simulator, const std::string& body, TaskMap map,
                     Eigen::VectorXd target) {
  const Task task{.name = body, .map = std::move(map), .target = std::move(target), .tolerance = kReach};
  Rng rng(1);
  InverseKinematicsResult found =
      solveInverseKinematics(simulator.model(), {&task, 1}, simulator.getJointAngles(), {}, rng);
  return {.isReached = found.status == InverseKinematicsResult::Status::kSolved,
          .q = std::move(found.q),
          .error = found.residuals.front(),
          .message = std::move(found.message)};
}

}  // namespace

ReachedPosture Simulator::inverseKinematics(const std::string& body, const Pose& X_WB) const {
  return reach(*this, body, poseTask(model().body(body), X_WB), {});
}

ReachedPosture Simulator::inverseKinematics(const std::string& body, const Eigen::Vector3d& p_W,
                                            const Eigen::Vector3d& rel) const {
  return reach(*this, body, positionTask(model().body(body), rel), p_W);
}

}  // namespace rex
