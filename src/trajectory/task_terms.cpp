#include "trajectory/task_terms.h"

#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "base/require.h"
#include "trajectory/motion_terms.h"
#include "trajectory/robot_window_internal.h"

namespace rex {
namespace {

constexpr int kMostOrder = 3;
// Binomials with alternating signs, of x_t, x_{t-1}, x_{t-2}, x_{t-3}.
constexpr double kDifferences[kMostOrder + 1][kMostOrder + 1] = {
    {1, 0, 0, 0}, {1, -1, 0, 0}, {1, -2, 1, 0}, {1, -3, 3, -1}};

void requireUsable(const Task& task, int order) {
  const auto refuse = [&](const char* part, std::string found, const char* wanted) {
    throw Error(
        {.what = fmt::format("task '{}': {}", task.name, part), .found = std::move(found), .wanted = wanted});
  };
  if (!task.map) refuse("map", "none", "a function");
  requirePositive(fmt::format("task '{}': precision", task.name), task.precision);
  if (order < 0 || order > kMostOrder) refuse("order", fmt::format("{}", order), "0, 1, 2 or 3");
}

class TaskOverTime {
 public:
  TaskOverTime(const Model& model, Task task, int order)
      : posture_(model), task_(std::move(task)), order_(order) {}

  void operator()(const TrajectoryWindow& window, FunctionValue& value) {
    const Eigen::Index n = window.X.rows();
    const double weight = std::sqrt(order_ > 0 ? task_.precision * window.tau : task_.precision);
    for (int j = 0; j <= order_; ++j) {
      const auto q = window.X.col(order_ - j);
      task_.map(posture_.moveTo(q, q, 1), at_);
      if (j == 0) begin(value, weight, n);
      const double a = weight * kDifferences[order_][j] / std::pow(window.tau, order_);
      value.y += a * at_.y;
      value.J.middleCols((order_ - j) * n, n) = a * at_.J;
    }
  }

 private:
  void begin(FunctionValue& value, double weight, Eigen::Index n) const {
    const Eigen::Index d = at_.y.size();
    value.y.setZero(d);
    value.J.resize(d, (order_ + 1) * n);
    if (task_.target.size() == 0) return;
    if (task_.target.size() != d)
      requireSize(fmt::format("task '{}': target", task_.name), task_.target.size(), d);
    value.y = -weight * task_.target;
  }

  internal::WindowPosture posture_;
  Task task_;
  int order_;
  TaskValue at_{};
};

}  // namespace

TrajectoryTerm taskTerm(const Model& model, Task task, int order) {
  internal::requirePlain(model);
  requireUsable(task, order);
  const std::string name = task.name;
  return {.name = name, .order = order, .function = TaskOverTime(model, std::move(task), order)};
}

TrajectoryTerm jointLimitsTerm(const Model& model) {
  internal::requirePlain(model);
  TrajectoryTerm term = limitsTerm(model.lowerLimits(), model.upperLimits());
  term.name = "joint limits";
  return term;
}

}  // namespace rex
