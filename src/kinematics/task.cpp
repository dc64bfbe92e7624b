#include "kinematics/task.h"

#include <cmath>

#include <fmt/format.h>

#include "base/require.h"

namespace rex {
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
