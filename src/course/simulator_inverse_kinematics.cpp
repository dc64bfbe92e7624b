#include <algorithm>
#include <numbers>

#include <fmt/format.h>

#include "base/require.h"
#include "collision/contacts.h"
#include "course/simulator.h"
#include "kinematics/forward_kinematics.h"
#include "kinematics/inverse_kinematics_solver.h"
#include "kinematics/task_maps.h"
#include "scene/state.h"

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

ReachedPosture Simulator::inverseKinematics(const std::string& body, const Pose& X_WB,
                                            double clearance) const {
  requirePositive("inverseKinematics: clearance", clearance, kMetres);
  const ContactModel contacts(model());
  const auto isClear = [&](const Eigen::VectorXd& q) {
    return contactCost(contacts, forwardKinematics(model(), q), clearance) == 0;
  };
  const PoseTarget target{
      .body = model().body(body), .X_WB = X_WB, .tolerance = kReach, .isAllowed = isClear};
  Rng rng(1);
  return reached(solveInverseKinematics(model(), target, getJointAngles(), {}, rng));
}

ReachedPosture Simulator::inverseKinematics(const std::string& body, const Eigen::Vector3d& p_W,
                                            const Eigen::Vector3d& rel, double clearance) const {
  requirePositive("inverseKinematics: clearance", clearance, kMetres);
  const Task tasks[] = {
      {.name = body, .map = positionTask(model().body(body), rel), .target = p_W, .tolerance = kReach},
      {.name = "contacts",
       .map = contactTask(ContactModel(model()), clearance),
       .target = Eigen::VectorXd::Zero(1),
       .tolerance = kReach}};
  // Contacts push best out of postures that reach the place.
  const InverseKinematicsOptions once{.maxRestarts = 0};
  Rng rng(1);
  const Eigen::VectorXd start = getJointAngles();
  InverseKinematicsResult best;
  int starts = 0;
  for (; starts <= InverseKinematicsOptions().maxRestarts; ++starts) {
    const Eigen::VectorXd way = Eigen::VectorXd::NullaryExpr(
        model().nv(), [&] { return starts == 0 ? 0 : rng.uniform(-std::numbers::pi, std::numbers::pi); });
    const Eigen::VectorXd there =
        solveInverseKinematics(model(), {tasks, 1}, integrate(model(), start, way), once, rng).q;
    InverseKinematicsResult found = solveInverseKinematics(model(), tasks, there, once, rng);
    if (starts == 0 || found.cost < best.cost) best = std::move(found);
    if (best.status == InverseKinematicsResult::Status::kSolved) break;
  }
  best.message += fmt::format(", the best after {} other starts",
                              std::min(starts, InverseKinematicsOptions().maxRestarts));
  return reached(std::move(best));
}

}  // namespace rex
