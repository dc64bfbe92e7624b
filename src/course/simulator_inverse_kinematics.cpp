#include "course/simulator.h"
#include "kinematics/inverse_kinematics_solver.h"
#include "kinematics/task_maps.h"

namespace rex {
namespace {

constexpr double kReach = 1e-6;  // metres and radians

ReachedPosture reached(InverseKinematicsResult found) {
  return {.isReached = found.status == InverseKinematicsResult::Status::kSolved,
          .q = std::move(found.q),
          .error = found.residuals.front(),
          .message = std::move(found.message)};
}

}  // namespace

ReachedPosture Simulator::inverseKinematics(const std::string& body, const Pose& X_WB) const {
  const PoseTarget target{.body = model().body(body), .X_WB = X_WB, .tolerance = kReach};
  Rng rng(1);
  return reached(solveInverseKinematics(model(), target, getJointAngles(), {}, rng));
}

ReachedPosture Simulator::inverseKinematics(const std::string& body, const Eigen::Vector3d& p_W,
                                            const Eigen::Vector3d& rel) const {
  const Task task{
      .name = body, .map = positionTask(model().body(body), rel), .target = p_W, .tolerance = kReach};
  Rng rng(1);
  return reached(solveInverseKinematics(model(), {&task, 1}, getJointAngles(), {}, rng));
}

}  // namespace rex
