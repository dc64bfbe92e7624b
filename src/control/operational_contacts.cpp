#include "control/operational_contacts.h"

#include <vector>

#include "control/require_internal.h"
#include "dynamics/joint_springs.h"
#include "dynamics/loop_dynamics.h"
#include "kinematics/hierarchical_step.h"

namespace rex {
namespace {

std::vector<TaskValue> valuesOf(const std::vector<Task>& tasks, const Posture& at) {
  std::vector<TaskValue> values;
  TaskValue stack;
  stackTasks(tasks, at, values, stack);
  return values;
}

}  // namespace

Eigen::VectorXd forcesInContact(const Model& model, const State& state,
                                std::span<const OperationalContact> contacts,
                                std::span<const OperationalTask> tasks,
                                const OperationalSpaceOptions& options) {
  internal::requireFinite(state);
  requireFinite("gravity", options.gravity_W);
  const BodyPoses poses = forwardKinematics(model, state.q);
  const Posture posture{model, state.q, poses};
  std::vector<Task> holds, aims;
  std::vector<TaskMap> maps;
  for (const OperationalContact& one : contacts) {
    holds.push_back({.name = one.name, .map = one.map});
    maps.push_back(one.map);
  }
  for (const OperationalTask& one : tasks) aims.push_back(one.task);
  const std::vector<TaskValue> held = valuesOf(holds, posture), aimed = valuesOf(aims, posture);

  const LoopMotion idle =
      loopDynamics(model, state, maps, springForces(model, state.q), {.gravity_W = options.gravity_W});
  const LoopResponse change = loopResponse(model, state.q, maps);
  std::vector<TaskLevel> levels;
  TaskLevel forces{Eigen::MatrixXd(0, model.nv()), Eigen::VectorXd(0)};
  Eigen::Index row = 0;
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const Eigen::Index d = held[i].y.size(), before = forces.dy.size();
    if (contacts[i].force.size() > 0) {
      const std::string what = "contact '" + contacts[i].name + "': force";
      requireSize(what, contacts[i].force.size(), d);
      requireFinite(what, contacts[i].force);
      forces.J.conservativeResize(before + d, Eigen::NoChange);
      forces.J.bottomRows(d) = change.forces_u.middleRows(row, d);
      forces.dy.conservativeResize(before + d);
      forces.dy.tail(d) = contacts[i].force - idle.forces.segment(row, d);
    }
    row += d;
  }
  if (forces.dy.size() > 0) levels.push_back(forces);
  for (std::size_t i = 0; i < tasks.size(); ++i)
    levels.push_back({aimed[i].J * change.a_u, wantedAcceleration(tasks[i], aimed[i], state) -
                                                   velocityAcceleration(model, state, tasks[i].task.map) -
                                                   aimed[i].J * idle.a});
  return hierarchicalStep(levels, {.W = options.H, .a = options.u0, .damping = options.damping});
}

}  // namespace rex
