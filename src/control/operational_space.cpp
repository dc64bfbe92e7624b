#include "control/operational_space.h"

#include <cassert>
#include <cmath>
#include <vector>

#include <Eigen/Cholesky>

#include "control/require_internal.h"
#include "dynamics/equations_of_motion.h"
#include "dynamics/forward_dynamics.h"
#include "dynamics/joint_springs.h"
#include "kinematics/hierarchical_step.h"
#include "kinematics/inverse_kinematics.h"

namespace rex {
namespace {

// A reference with the size of its task; empty means zero.
Eigen::VectorXd referenceOf(const Task& task, const char* what, const Eigen::VectorXd& given,
                            Eigen::Index size) {
  if (given.size() == 0) return Eigen::VectorXd::Zero(size);
  const std::string name = "task '" + task.name + "': " + what;
  requireSize(name, given.size(), size);
  requireFinite(name, given);
  return given;
}

// What each task requires of the forces: T u = y''* - J' v + T F, where -T F = J a is its acceleration
// without them.
std::vector<TaskLevel> wishesOf(const Model& model, const State& state,
                                std::span<const OperationalTask> tasks, const Eigen::Vector3d& gravity_W) {
  internal::requireFinite(state);
  requireFinite("gravity", gravity_W);
  // Throws if M is singular, naming the joint and the body. This comes before the factorisation, which might
  // succeed because of rounding.
  const Eigen::VectorXd fall =
      forwardDynamics(model, state.q, state.v, springForces(model, state.q), gravity_W);
  const Eigen::LLT<Eigen::MatrixXd> factors(massMatrix(model, state.q));
  assert(factors.info() == Eigen::Success);
  std::vector<Task> plain;
  for (const OperationalTask& one : tasks) plain.push_back(one.task);
  std::vector<TaskValue> values;
  TaskValue stack;
  const BodyPoses poses = forwardKinematics(model, state.q);
  stackTasks(plain, {model, state.q, poses}, values, stack);

  std::vector<TaskLevel> wishes;
  for (std::size_t i = 0; i < tasks.size(); ++i) {
    const Eigen::MatrixXd T = factors.solve(values[i].J.transpose()).transpose();
    wishes.push_back({T, wantedAcceleration(tasks[i], values[i], state) -
                             velocityAcceleration(model, state, tasks[i].task.map) - values[i].J * fall});
  }
  return wishes;
}

}  // namespace

Eigen::VectorXd wantedAcceleration(const OperationalTask& one, const TaskValue& value, const State& state) {
  const Eigen::Index d = value.y.size();
  requireFinite("task '" + one.task.name + "': gain Kp", one.gains.Kp);
  requireFinite("task '" + one.task.name + "': gain Kd", one.gains.Kd);
  const Eigen::VectorXd target = referenceOf(one.task, "target", one.task.target, d);
  const Eigen::VectorXd velocity = referenceOf(one.task, "reference velocity", one.velocity, d);
  const Eigen::VectorXd acceleration = referenceOf(one.task, "reference acceleration", one.acceleration, d);
  return acceleration + one.gains.Kp * (target - value.y) + one.gains.Kd * (velocity - value.J * state.v);
}

Eigen::VectorXd operationalSpaceForces(const Model& model, const State& state,
                                       std::span<const OperationalTask> tasks,
                                       const OperationalSpaceOptions& options) {
  const std::vector<TaskLevel> wishes = wishesOf(model, state, tasks, options.gravity_W);
  Eigen::Index rows = 0;
  for (const TaskLevel& wish : wishes) rows += wish.J.rows();
  Eigen::MatrixXd T(rows, model.nv());
  Eigen::VectorXd b(rows);
  rows = 0;
  for (std::size_t i = 0; i < wishes.size(); ++i) {
    const Eigen::Index d = wishes[i].J.rows();
    const double weight = std::sqrt(tasks[i].task.precision);
    T.middleRows(rows, d) = weight * wishes[i].J;
    b.segment(rows, d) = weight * wishes[i].dy;
    rows += d;
  }
  return inverseKinematicsStep(T, b, StepOptions{.W = options.H, .a = options.u0});
}

Eigen::VectorXd prioritisedForces(const Model& model, const State& state,
                                  std::span<const OperationalTask> tasks,
                                  const OperationalSpaceOptions& options) {
  return hierarchicalStep(wishesOf(model, state, tasks, options.gravity_W),
                          {.W = options.H, .a = options.u0, .damping = options.damping});
}

}  // namespace rex
