#include "kinematics/task_motion.h"

#include "base/require.h"
#include "kinematics/inverse_kinematics.h"
#include "kinematics/inverse_kinematics_internal.h"
#include "kinematics/inverse_kinematics_solver_internal.h"
#include "scene/state.h"

namespace rex {
namespace {

double share(int t, int steps, const MotionProfile& profile) {
  return profileAt(profile, static_cast<double>(t) / steps).position;
}

}  // namespace

Eigen::MatrixXd interpolatePostures(const Model& model, const VectorArg& q0, const VectorArg& qT, int steps,
                                    const MotionProfile& profile) {
  requireCount("steps of a motion", steps, 1);
  const Eigen::VectorXd way = difference(model, q0, qT);
  Eigen::MatrixXd Q(model.nq(), steps + 1);
  for (int t = 0; t <= steps; ++t) Q.col(t) = integrate(model, q0, share(t, steps, profile) * way);
  return Q;
}

Eigen::MatrixXd interpolateValues(const VectorArg& y0, const VectorArg& yT, int steps,
                                  const MotionProfile& profile) {
  requireCount("steps of a motion", steps, 1);
  requireSize("last task value yT", yT.size(), y0.size());
  Eigen::MatrixXd Y(y0.size(), steps + 1);
  for (int t = 0; t <= steps; ++t) Y.col(t) = y0 + share(t, steps, profile) * (yT - y0);
  return Y;
}

FollowedTask followTask(const Model& model, const Task& followed, const MatrixArg& Y, const VectorArg& q0,
                        const std::vector<Task>& others, const Eigen::MatrixXd& W) {
  const std::vector<internal::JointLimit> limits = internal::limitedCoordinates(model);
  std::vector<Task> tasks{followed};
  tasks.insert(tasks.end(), others.begin(), others.end());
  std::vector<TaskValue> values;
  TaskValue phi;
  BodyPoses poses;
  const StepOptions options{.W = W};
  requireSize("start posture q0", q0.size(), model.nq());
  static_cast<void>(internal::Metric("metric W", W, model.nv()));

  Eigen::VectorXd q = q0;
  FollowedTask motion{Eigen::MatrixXd(model.nq(), Y.cols()), Eigen::VectorXd(Y.cols())};
  for (Eigen::Index t = 0; t < Y.cols(); ++t) {
    tasks.front().target = Y.col(t);
    forwardKinematics(model, q, poses);
    stackTasks(tasks, {model, q, poses}, values, phi);
    if (t > 0) {
      q = integrate(model, q, inverseKinematicsStep(phi.J, -phi.y, options));
      internal::clampToLimits(limits, q);
      forwardKinematics(model, q, poses);
      stackTasks(tasks, {model, q, poses}, values, phi);
    }
    motion.Q.col(t) = q;
    motion.errors[t] = taskError(tasks.front(), values.front());
  }
  return motion;
}

}  // namespace rex
