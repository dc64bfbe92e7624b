#include "trajectory/motion_terms.h"

#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "base/error.h"
#include "base/require.h"
#include "collision/motion_clearance.h"
#include "kinematics/jacobians.h"
#include "kinematics/task_maps.h"
#include "trajectory/trajectory_optimizer.h"

namespace rex::internal {

/// Throws Error for a model whose q is more than plain numbers, which differences of q do not describe.
inline void requirePlain(const Model& model) {
  if (model.nq() == model.nv()) return;
  throw Error({.what = "model of a trajectory",
               .found = "joints with quaternions",
               .wanted = "hinges, sliders and other joints of plain numbers"});
}

/// A robot in one posture after another: room for terms to work in.
class WindowPosture {
 public:
  explicit WindowPosture(const Model& model) : model_(model) {}

  [[nodiscard]] const Model& model() const { return model_; }
  /// Moves it to (1 - share) a + share b.
  Posture moveTo(const VectorArg& a, const VectorArg& b, double share) {
    if (a.size() != model_.nq()) requireSize("configurations of a trajectory", a.size(), model_.nq());
    q_ = (1 - share) * a + share * b;
    forwardKinematics(model_, q_, poses_);
    return {model_, q_, poses_};
  }

 private:
  Model model_;
  Eigen::VectorXd q_;
  BodyPoses poses_;
};

}  // namespace rex::internal

namespace rex {
namespace {

// The k-th difference of configurations, newest last: binomials with alternating signs.
TrajectoryTerm differenceTerm(const char* name, int k, Eigen::VectorXd weights) {
  const std::string what = fmt::format("weights of {}", name);
  requireNotNegative(what, weights);
  const auto function = [k, weights = std::move(weights), what](const TrajectoryWindow& window,
                                                                FunctionValue& value) {
    const Eigen::Index n = window.X.rows();
    if (weights.size() > 0) requireSize(what, weights.size(), n);
    value.y.setZero(n);
    value.J.setZero(n, (k + 1) * n);
    double factor = std::sqrt(window.tau) / std::pow(window.tau, k);
    for (int j = 0; j <= k; ++j) {
      for (Eigen::Index i = 0; i < n; ++i) {
        const double a = weights.size() > 0 ? factor * std::sqrt(weights[i]) : factor;
        value.J(i, (k - j) * n + i) = a;
        value.y[i] += a * window.X(i, k - j);
      }
      factor *= -static_cast<double>(k - j) / (j + 1);
    }
  };
  return {.name = name, .order = k, .function = function};
}

}  // namespace

TrajectoryTerm velocityTerm(Eigen::VectorXd weights) {
  return differenceTerm("velocity", 1, std::move(weights));
}

TrajectoryTerm accelerationTerm(Eigen::VectorXd weights) {
  return differenceTerm("acceleration", 2, std::move(weights));
}

TrajectoryTerm jerkTerm(Eigen::VectorXd weights) { return differenceTerm("jerk", 3, std::move(weights)); }

TrajectoryTerm postureTerm(const VectorArg& target) {
  const auto function = [target = Eigen::VectorXd(target)](const TrajectoryWindow& window,
                                                           FunctionValue& value) {
    requireSize("target of a posture", target.size(), window.X.rows());
    value.y = window.X.col(0) - target;
    value.J.setIdentity(target.size(), target.size());
  };
  return {.name = "posture", .function = function};
}

TrajectoryTerm limitsTerm(const VectorArg& lower, const VectorArg& upper) {
  requireSize("upper limits", upper.size(), lower.size());
  std::vector<std::pair<Eigen::Index, double>> limits[2];  // indices and values of lower and upper ones
  for (Eigen::Index i = 0; i < lower.size(); ++i) {
    if (!(lower[i] <= upper[i]))
      throw Error({.what = fmt::format("limits of coordinate {}", i),
                   .found = fmt::format("{:g} to {:g}", lower[i], upper[i]),
                   .wanted = "a lower one that is not above the upper one"});
    if (std::isfinite(lower[i])) limits[0].emplace_back(i, lower[i]);
    if (std::isfinite(upper[i])) limits[1].emplace_back(i, upper[i]);
  }
  const auto rows = static_cast<Eigen::Index>(limits[0].size() + limits[1].size());
  const auto function = [=, below = limits[0], above = limits[1], n = lower.size()](
                            const TrajectoryWindow& window, FunctionValue& value) {
    requireSize("limits of configurations", n, window.X.rows());
    value.y.resize(rows);
    value.J.setZero(rows, n);
    Eigen::Index row = 0;
    for (const auto& [i, limit] : below) value.y[row] = limit - window.X(i, 0), value.J(row++, i) = -1;
    for (const auto& [i, limit] : above) value.y[row] = window.X(i, 0) - limit, value.J(row++, i) = 1;
  };
  return {.name = "limits", .kind = TermKind::kInequality, .function = function};
}

TrajectoryTerm velocityLimitsTerm(const VectorArg& limit) {
  std::vector<std::pair<Eigen::Index, double>> limits;  // indices and values of the finite ones
  for (Eigen::Index i = 0; i < limit.size(); ++i) {
    requirePositiveOrInfinite("velocity limits", limit[i]);
    if (std::isfinite(limit[i])) limits.emplace_back(i, limit[i]);
  }
  const auto function = [limits, n = limit.size()](const TrajectoryWindow& window, FunctionValue& value) {
    requireSize("velocity limits", n, window.X.rows());
    const auto rows = static_cast<Eigen::Index>(limits.size());
    value.y.resize(2 * rows);
    value.J.setZero(2 * rows, 2 * n);
    Eigen::Index row = 0;
    for (const auto& [i, most] : limits) {
      const double velocity = (window.X(i, 1) - window.X(i, 0)) / window.tau;
      value.y[row] = velocity - most;
      value.y[rows + row] = -velocity - most;
      value.J(row, n + i) = value.J(rows + row, i) = 1 / window.tau;
      value.J(row, i) = value.J(rows + row, n + i) = -1 / window.tau;
      ++row;
    }
  };
  return {.name = "velocity limits", .kind = TermKind::kInequality, .order = 1, .function = function};
}

std::vector<TrajectoryTerm> restTerms(const VectorArg& target, int steps) {
  TrajectoryTerm goal = as(TermKind::kEquality, at(postureTerm(target), steps - 1));
  TrajectoryTerm rest = as(TermKind::kEquality, at(velocityTerm(), steps - 1));
  goal.name = "goal";
  rest.name = "rest";
  return {goal, rest};
}

namespace {

void requireSound(const Model& model, const ContactSampling& sampling) {
  internal::requirePlain(model);
  requirePositive("margin of a contact term", sampling.margin, kMetres);
  requireCount("samples of a contact term", sampling.samples, 1);
}

// A task map in several postures between two.
class SampledMap {
 public:
  SampledMap(const Model& model, TaskMap map, int samples, double weight)
      : posture_(model), map_(std::move(map)), samples_(samples), weight_(weight) {}

  void operator()(const TrajectoryWindow& window, FunctionValue& value) {
    const Eigen::Index n = window.X.rows();
    for (int i = 0; i < samples_; ++i) {
      const double share = (i + 1.) / samples_;
      map_(posture_.moveTo(window.X.col(0), window.X.col(1), share), at_);
      const Eigen::Index d = at_.y.size();
      value.y.resize(samples_ * d);
      value.J.resize(samples_ * d, 2 * n);
      value.y.segment(i * d, d) = weight_ * at_.y;
      value.J.block(i * d, 0, d, n) = (1 - share) * weight_ * at_.J;
      value.J.block(i * d, n, d, n) = share * weight_ * at_.J;
    }
  }

 private:
  internal::WindowPosture posture_;
  TaskMap map_;
  int samples_;
  double weight_;
  TaskValue at_{};
};

Eigen::Vector3d inBody(const Pose& X_WB, const Eigen::Vector3d& p_W) {
  return X_WB.R.transpose() * (p_W - X_WB.p);
}

// 1 - d / margin of each pair. A single row for the nearest pair would jump where two are equally near.
TaskMap clearanceMap(const ContactModel& contacts, double margin) {
  return [contacts, margin, storage = ProxyStorage(), J = Eigen::Matrix3Xd()](const Posture& at,
                                                                              TaskValue& value) mutable {
    const auto pairs = contacts.pairs();
    value.y.setConstant(static_cast<Eigen::Index>(pairs.size()), -1);
    value.J.setZero(value.y.size(), at.model.nv());
    J.resize(3, at.model.nv());
    proxies(contacts, at.poses, 2 * margin, storage);
    for (Eigen::Index row = 0; row < value.y.size(); ++row) {
      const Proximity& proximity = storage.pairs[static_cast<std::size_t>(row)];
      if (proximity.distance >= 2 * margin) continue;
      value.y[row] = 1 - proximity.distance / margin;
      const ShapePair& pair = pairs[static_cast<std::size_t>(row)];
      const Eigen::RowVector3d direction = -proximity.normal_W.transpose() / margin;
      const BodyId a = contacts.body(pair.a), b = contacts.body(pair.b);
      positionJacobian(at.model, at.poses, a, inBody(at.poses[a], proximity.p_WA), J);
      value.J.row(row).noalias() += direction.lazyProduct(J);
      positionJacobian(at.model, at.poses, b, inBody(at.poses[b], proximity.p_WB), J);
      value.J.row(row).noalias() -= direction.lazyProduct(J);
    }
  };
}

}  // namespace

TrajectoryTerm contactCostTerm(const Model& model, const ContactModel& contacts,
                               const ContactSampling& sampling, double precision) {
  requireSound(model, sampling);
  requirePositive("precision of a contact term", precision);
  const double weight = std::sqrt(precision / sampling.samples);
  return {.name = "contact cost",
          .order = 1,
          .function = SampledMap(model, contactTask(contacts, sampling.margin), sampling.samples, weight)};
}

TrajectoryTerm clearanceTerm(const Model& model, const ContactModel& contacts,
                             const ContactSampling& sampling) {
  requireSound(model, sampling);
  return {.name = "clearance",
          .kind = TermKind::kInequality,
          .order = 1,
          .function = SampledMap(model, clearanceMap(contacts, sampling.margin), sampling.samples, 1)};
}

TrajectoryClearance trajectoryClearance(const Model& model, const ContactModel& contacts,
                                        const MatrixArg& path, double tolerance) {
  requireCount("configurations of a path", path.cols(), 2);
  TrajectoryClearance clearance{.distance = std::numeric_limits<double>::infinity()};
  for (int t = 0; t + 1 < path.cols(); ++t) {
    const double distance = motionClearance(model, contacts, path.col(t), path.col(t + 1), tolerance);
    if (distance < clearance.distance) clearance = {distance, t};
  }
  return clearance;
}

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
