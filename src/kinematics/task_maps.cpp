#include "kinematics/task_maps.h"

#include <cmath>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <fmt/format.h>

#include "base/error.h"
#include "base/require.h"
#include "kinematics/center_of_mass.h"
#include "kinematics/jacobians.h"
#include "scene/state.h"

namespace rex {
namespace {

using Columns = Eigen::Ref<Eigen::Matrix3Xd>;

Eigen::Vector3d cross(const Eigen::Vector3d& a, const Eigen::Vector3d& b) { return a.cross(b); }

// Each column times v, as "A x v" on slide 2:54.
void crossColumns(Columns A, const Eigen::Vector3d& v) {
  for (auto column : A.colwise()) column = cross(column, v);
}

void transformColumns(const Eigen::Matrix3d& M, Columns A) {
  for (auto column : A.colwise()) column = M * Eigen::Vector3d(column);
}

// Angular velocity of B relative to A, in A's axes, per unit of v.
Eigen::Matrix3Xd relativeAngularJacobian(const Posture& at, BodyId body, BodyId a) {
  Eigen::Matrix3Xd J = angularJacobian(at.model, at.poses, body) - angularJacobian(at.model, at.poses, a);
  transformColumns(at.poses[a].R.transpose(), J);
  return J;
}

// Writes the one of an orientation's two quaternions that is closer to `nearest`, and how it changes: for an
// angular velocity w in the axes of the frame that the orientation refers to, q' = (0, w) o q / 2.
void writeQuaternion(const Eigen::Matrix3d& R, const Eigen::Matrix3Xd& angular, const Quaternion& nearest,
                     TaskValue& out) {
  const Quaternion q = quaternionFromRotation(R);
  out.y = q.dot(nearest) < 0 ? Quaternion(-q) : q;
  const double w = out.y[0];
  const Eigen::Vector3d v = out.y.tail<3>();
  out.J.resize(4, angular.cols());
  for (Eigen::Index i = 0; i < angular.cols(); ++i) {
    const Eigen::Vector3d omega = angular.col(i);
    out.J.col(i) << -0.5 * omega.dot(v), 0.5 * (w * omega + omega.cross(v));
  }
}

void requireDirection(const Quaternion& nearest) {
  static_cast<void>(rotationFromQuaternion(nearest));  // throws for zero and numbers that are not finite
}

void writeVector(const Posture& at, BodyId body, const Eigen::Vector3d& vector_B, TaskValue& out) {
  out.y = direction(at.poses, body, vector_B);
  out.J.resize(3, at.model.nv());
  angularJacobian(at.model, at.poses, body, out.J);
  crossColumns(out.J, out.y);
}

}  // namespace

TaskMap positionTask(BodyId body, const Eigen::Vector3d& p_BQ) {
  return [=](const Posture& at, TaskValue& out) {
    out.y = position(at.poses, body, p_BQ);
    out.J.resize(3, at.model.nv());
    positionJacobian(at.model, at.poses, body, p_BQ, out.J);
  };
}

TaskMap vectorTask(BodyId body, const Eigen::Vector3d& vector_B) {
  return [=](const Posture& at, TaskValue& out) { writeVector(at, body, vector_B, out); };
}

TaskMap quaternionTask(BodyId body, const Quaternion& nearest) {
  requireDirection(nearest);
  return [=](const Posture& at, TaskValue& out) {
    writeQuaternion(at.poses[body].R, angularJacobian(at.model, at.poses, body), nearest, out);
  };
}

TaskMap orientationTask(BodyId body, const Eigen::Matrix3d& R_WT) {
  return [=](const Posture& at, TaskValue& out) {
    out.y = logSO3(at.poses[body].R * R_WT.transpose());
    out.J.resize(3, at.model.nv());
    angularJacobian(at.model, at.poses, body, out.J);
    transformColumns(leftJacobianSO3(out.y).inverse(), out.J);
  };
}

TaskMap poseTask(BodyId body, const Pose& X_WT, const Eigen::Vector3d& p_BQ) {
  return [=](const Posture& at, TaskValue& out) {
    out.y.resize(6);
    out.J.resize(6, at.model.nv());
    out.y << position(at.poses, body, p_BQ) - X_WT.p, logSO3(at.poses[body].R * X_WT.R.transpose());
    poseJacobian(at.model, at.poses, body, p_BQ, out.J);
    transformColumns(leftJacobianSO3(out.y.tail<3>()).inverse(), out.J.bottomRows<3>());
  };
}

TaskMap relativePositionTask(BodyId body, const Eigen::Vector3d& p_BQ, BodyId a,
                             const Eigen::Vector3d& p_AP) {
  return [=](const Posture& at, TaskValue& out) {
    const Eigen::Vector3d p_PQ_W = position(at.poses, body, p_BQ) - position(at.poses, a, p_AP);
    Eigen::Matrix3Xd turning = angularJacobian(at.model, at.poses, a);
    crossColumns(turning, p_PQ_W);
    const Eigen::Matrix3d R_AW = at.poses[a].R.transpose();
    out.y = R_AW * p_PQ_W;
    out.J = positionJacobian(at.model, at.poses, body, p_BQ) - positionJacobian(at.model, at.poses, a, p_AP) -
            turning;
    transformColumns(R_AW, out.J);
  };
}

TaskMap relativeVectorTask(BodyId body, const Eigen::Vector3d& vector_B, BodyId a) {
  return [=](const Posture& at, TaskValue& out) {
    out.y = at.poses[a].R.transpose() * direction(at.poses, body, vector_B);
    out.J = relativeAngularJacobian(at, body, a);
    crossColumns(out.J, out.y);
  };
}

TaskMap relativeQuaternionTask(BodyId body, BodyId a, const Quaternion& nearest) {
  requireDirection(nearest);
  return [=](const Posture& at, TaskValue& out) {
    writeQuaternion(at.poses[a].R.transpose() * at.poses[body].R, relativeAngularJacobian(at, body, a),
                    nearest, out);
  };
}

TaskMap alignmentTask(BodyId body, const Eigen::Vector3d& vector_B, const Eigen::Vector3d& vector_W) {
  return [=](const Posture& at, TaskValue& out) {
    out.y = vector_W.transpose() * direction(at.poses, body, vector_B);
    out.J = vector_W.transpose() * directionJacobian(at.model, at.poses, body, vector_B);
  };
}

TaskMap relativeAlignmentTask(BodyId body, const Eigen::Vector3d& vector_B, BodyId a,
                              const Eigen::Vector3d& vector_A) {
  return [=](const Posture& at, TaskValue& out) {
    const Eigen::Vector3d v_W = direction(at.poses, body, vector_B), u_W = direction(at.poses, a, vector_A);
    out.y = u_W.transpose() * v_W;
    out.J = u_W.transpose() * directionJacobian(at.model, at.poses, body, vector_B) +
            v_W.transpose() * directionJacobian(at.model, at.poses, a, vector_A);
  };
}

TaskMap jointLimitsTask(double margin) {
  requirePositive("margin of joint limits", margin);
  return [=](const Posture& at, TaskValue& out) {
    out.y.setZero(1);
    out.J.setZero(1, at.model.nv());
    forEachPlainCoordinate(at.model, [&](int iq, int iv, const DegreeOfFreedom&) {
      const double tooLow = margin - (at.q[iq] - at.model.lowerLimits()[iq]);
      const double tooHigh = margin - (at.model.upperLimits()[iq] - at.q[iq]);
      out.y[0] += (std::max(0., tooLow) + std::max(0., tooHigh)) / margin;
      out.J(0, iv) = ((tooHigh > 0 ? 1 : 0) - (tooLow > 0 ? 1 : 0)) / margin;
    });
  };
}

TaskMap centerOfMassTask() {
  return [](const Posture& at, TaskValue& out) {
    out.y = centerOfMass(at.model, at.poses);
    out.J = centerOfMassJacobian(at.model, at.poses);
  };
}

TaskMap homingTask(const VectorArg& home) {
  return [home = Eigen::VectorXd(home)](const Posture& at, TaskValue& out) {
    requireSize("home posture", home.size(), at.model.nq());
    out.y = difference(at.model, home, at.q);
    out.J.setIdentity(at.model.nv(), at.model.nv());
    forEachQuaternion(at.model, [&](int, int iv) {
      out.J.block<3, 3>(iv, iv) = rightJacobianSO3(out.y.segment<3>(iv)).inverse();
    });
  };
}

TaskMap taskRows(const TaskMap& map, int first, int count) {
  requireCount("first row of a map", first, 0);
  requireCount("rows of a map", count, 0);
  return [map, first, count](const Posture& at, TaskValue& out) {
    TaskValue all;
    map(at, all);
    if (all.y.size() < first + count)
      throw Error({.what = "rows of a map",
                   .found = fmt::format("a value of {} numbers", all.y.size()),
                   .wanted = fmt::format("at least {}", first + count)});
    out.y = all.y.segment(first, count);
    out.J = all.J.middleRows(first, count);
  };
}

namespace {

[[noreturn]] void refuse(const Task& task, const char* part, std::string found, std::string wanted) {
  throw Error({.what = fmt::format("task '{}': {}", task.name, part),
               .found = std::move(found),
               .wanted = std::move(wanted)});
}

void requireUsable(const Task& task) {
  if (!task.map) refuse(task, "map", "none", "a function");
  if (!(task.precision > 0 && std::isfinite(task.precision)))  // no text if it is valid: each step asks
    requirePositive(fmt::format("task '{}': precision", task.name), task.precision);
  if (!(task.tolerance >= 0))
    requireNotNegativeOrInfinite(fmt::format("task '{}': tolerance", task.name), task.tolerance);
}

void requireValue(const Task& task, const TaskValue& value, int nv) {
  const Eigen::Index d = value.y.size();
  if (task.target.size() > 0 && task.target.size() != d)
    refuse(task, "target", fmt::format("{} numbers", task.target.size()),
           fmt::format("{}, as its map gives", d));
  if (value.J.rows() != d || value.J.cols() != nv) {
    refuse(task, "Jacobian", fmt::format("{} x {}", value.J.rows(), value.J.cols()),
           fmt::format("{} x {}", d, nv));
  }
  if (!value.y.allFinite()) refuse(task, "value", "a number that is not finite", "finite numbers");
  if (!value.J.allFinite()) refuse(task, "Jacobian", "a number that is not finite", "finite numbers");
  if (!task.target.allFinite()) refuse(task, "target", "a number that is not finite", "finite numbers");
}

}  // namespace

void stackTasks(std::span<const Task> tasks, const Posture& at, std::vector<TaskValue>& values,
                TaskValue& phi) {
  values.resize(tasks.size());
  Eigen::Index rows = 0;
  for (std::size_t i = 0; i < tasks.size(); ++i) {
    requireUsable(tasks[i]);
    tasks[i].map(at, values[i]);
    requireValue(tasks[i], values[i], at.model.nv());
    rows += values[i].y.size();
  }
  phi.y.resize(rows);
  phi.J.resize(rows, at.model.nv());
  Eigen::Index row = 0;
  for (std::size_t i = 0; i < tasks.size(); ++i) {
    const double weight = std::sqrt(tasks[i].precision);
    const Eigen::Index d = values[i].y.size();
    phi.y.segment(row, d) = weight * values[i].y;
    if (tasks[i].target.size() > 0) phi.y.segment(row, d) -= weight * tasks[i].target;
    phi.J.middleRows(row, d) = weight * values[i].J;
    row += d;
  }
}

TaskValue stackTasks(std::span<const Task> tasks, const Posture& at) {
  std::vector<TaskValue> values;
  TaskValue phi;
  stackTasks(tasks, at, values, phi);
  return phi;
}

double taskError(const Task& task, const TaskValue& value) {
  if (value.y.size() == 0) return 0;
  if (task.target.size() == 0) return value.y.cwiseAbs().maxCoeff();
  return (value.y - task.target).cwiseAbs().maxCoeff();
}

}  // namespace rex
