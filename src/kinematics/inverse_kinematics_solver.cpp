#include "kinematics/inverse_kinematics_solver.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include <Eigen/Cholesky>
#include <fmt/format.h>

#include "base/require.h"
#include "kinematics/closed_form_arm.h"
#include "kinematics/inverse_kinematics_solver_internal.h"
#include "kinematics/task_maps.h"
#include "scene/state.h"

namespace rex::internal {

/// Steps (J^T J + lambda Id)^-1 J^T e of Levenberg and Marquardt, by the smaller of the two Woodbury forms:
/// inverseKinematicsStep() for iterations. It keeps its storage, and allocates nothing once it has been used
/// with these sizes.
class DampedStep {
 public:
  /// J: d x n. e: d. lambda > 0. `step` becomes n numbers.
  void solve(const Eigen::MatrixXd& J, const Eigen::VectorXd& e, double lambda, Eigen::VectorXd& step) {
    if (J.rows() == 3) return solveFixed<3>(J, e, lambda, step);
    if (J.rows() == 6) return solveFixed<6>(J, e, lambda, step);
    if (J.rows() <= J.cols()) return solveInTaskSpace(J, e, lambda, step);
    solveInJointSpace(J, e, lambda, step);
  }

 private:
  // Sizes known to the compiler, because a point and a pose are what most callers ask for: half the time.
  template <int D>
  static void solveFixed(const Eigen::MatrixXd& J, const Eigen::VectorXd& e, double lambda,
                         Eigen::VectorXd& step) {
    const Eigen::Map<const Eigen::Matrix<double, D, Eigen::Dynamic>> fixedJ(J.data(), D, J.cols());
    Eigen::Matrix<double, D, D> A = lambda * Eigen::Matrix<double, D, D>::Identity();
    for (const auto& column : fixedJ.colwise()) A += column * column.transpose();
    const Eigen::Matrix<double, D, 1> z = A.llt().solve(e.head<D>());
    step.noalias() = fixedJ.transpose().lazyProduct(z);
  }

  void solveInTaskSpace(const Eigen::MatrixXd& J, const Eigen::VectorXd& e, double lambda,
                        Eigen::VectorXd& step) {
    A_.setZero(J.rows(), J.rows());
    A_.selfadjointView<Eigen::Lower>().rankUpdate(J);
    A_.diagonal().array() += lambda;
    factors_.compute(A_);
    z_ = e;
    factors_.solveInPlace(z_);
    step.noalias() = J.transpose() * z_;
  }

  void solveInJointSpace(const Eigen::MatrixXd& J, const Eigen::VectorXd& e, double lambda,
                         Eigen::VectorXd& step) {
    A_.setZero(J.cols(), J.cols());
    A_.selfadjointView<Eigen::Lower>().rankUpdate(J.transpose());
    A_.diagonal().array() += lambda;
    factors_.compute(A_);
    step.noalias() = J.transpose() * e;
    factors_.solveInPlace(step);
  }

  Eigen::MatrixXd A_;
  Eigen::VectorXd z_;
  Eigen::LLT<Eigen::MatrixXd> factors_;
};

}  // namespace rex::internal

namespace rex {
namespace {

using Result = InverseKinematicsResult;
using Options = InverseKinematicsOptions;

// Damping of the normal equations, lambda = factor * cost, vanishes at a solution and so keeps Gauss-Newton's
// speed there (Sugihara 2011). The factors were tuned on poses of two 7-joint arms; dividing or multiplying
// any of them by three changes the time by less than a third.
constexpr double kFirstDamping = 0.1, kLeastDamping = 1e-5, kMostDamping = 1e3;
constexpr double kDampingAfterFullStep = 0.3, kDampingAfterShortStep = 4;
// For singular Jacobians: a share of their squared size that is always added.
constexpr double kLeastRelativeDamping = 1e-12;
// A start is given up if a few iterations do not even halve the cost.
constexpr int kIterationsToHalve = 5;
// Line search: the share of the promised gain that is enough, and when to stop halving.
constexpr double kSufficientGain = 1e-4;
constexpr int kMostHalvings = 30;
// A joint this close to a limit counts as being at it (Bertsekas 1982), in units of q: otherwise all steps,
// cut short by the limit, might fail to descend. The distance exceeds what the last halving leaves of the
// longest step, the one with the least damping: 2^-kMostHalvings / (2 sqrt(kLeastDamping)).
constexpr double kAtLimit = 2e-7;

// Draws postures: uniformly within limits, around a centre where there are none.
class PostureSampler {
 public:
  PostureSampler(const Model& model, const Eigen::VectorXd& center) : q_(center) {
    forEachPlainCoordinate(model, [&](int iq, int, const DegreeOfFreedom& freedom) {
      const double reach = freedom.angular.isZero(0) ? 1 : std::numbers::pi;
      const double lower = model.lowerLimits()[iq], upper = model.upperLimits()[iq];
      ranges_.push_back({iq, std::isfinite(lower) ? lower : std::min(center[iq], upper) - reach,
                         std::isfinite(upper) ? upper : std::max(center[iq], lower) + reach});
    });
    forEachQuaternion(model, [&](int iq, int) { quaternions_.push_back(iq); });
  }

  const Eigen::VectorXd& draw(Rng& rng) {
    for (const Range& range : ranges_) q_[range.iq] = rng.uniform(range.lower, range.upper);
    for (const int iq : quaternions_)
      for (int i = 0; i < 4; ++i) q_[iq + i] = rng.normal();
    return q_;
  }

 private:
  struct Range {
    int iq;
    double lower, upper;
  };
  std::vector<Range> ranges_;
  std::vector<int> quaternions_;
  Eigen::VectorXd q_;
};

// A posture, and the values of the tasks there.
struct Point {
  Eigen::VectorXd q;
  TaskValue phi;
  std::vector<TaskValue> values;
  double cost = 0;
  bool fulfilled = false;  // all tasks are within their tolerances
};

// A descent from one posture, with storage that serves the next one too.
class Descent {
 public:
  enum class End { kConverged, kGivenUp, kIterationLimit };

  Descent(const Model& model, std::span<const Task> tasks, const Options& options)
      : model_(model), tasks_(tasks), options_(options), limits_(internal::limitedCoordinates(model)) {
    held_.reserve(limits_.size());
    for (const Task& task : tasks) isWeighed_ = isWeighed_ || task.tolerance == kNoTolerance;
  }

  // `patient`: to the very end, even if the targets get no closer.
  End run(const Eigen::VectorXd& start, bool patient) {
    here_.q = start;
    internal::clampToLimits(limits_, here_.q);
    evaluate(here_);
    double damping = kFirstDamping, costBefore = here_.cost;
    for (int i = 1; i <= options_.maxIterations; ++i) {
      if (here_.fulfilled && !isWeighed_) return End::kConverged;
      ++iterations_;
      findDirection(damping);
      if (direction_.lpNorm<Eigen::Infinity>() <= options_.stepTolerance) return End::kConverged;
      const int halvings = searchLine();
      if (halvings > kMostHalvings) return End::kConverged;  // any further gain is lost in rounding errors
      damping = halvings == 0 ? std::max(kLeastDamping, kDampingAfterFullStep * damping)
                              : std::min(kMostDamping, kDampingAfterShortStep * damping);
      if (i % kIterationsToHalve > 0) continue;
      if (!patient && !here_.fulfilled && here_.cost > costBefore / 2) return End::kGivenUp;
      costBefore = here_.cost;
    }
    return here_.fulfilled && !isWeighed_ ? End::kConverged : End::kIterationLimit;
  }

  const Point& here() const { return here_; }
  int iterations() const { return iterations_; }

 private:
  void evaluate(Point& at) {
    forwardKinematics(model_, at.q, poses_);
    stackTasks(tasks_, {model_, at.q, poses_}, at.values, at.phi);
    at.cost = at.phi.y.squaredNorm();
    at.fulfilled = true;
    for (std::size_t i = 0; i < tasks_.size(); ++i)
      at.fulfilled = at.fulfilled && taskError(tasks_[i], at.values[i]) <= tasks_[i].tolerance;
  }

  // A joint at a limit that the descent would push it across is held: it only moves the rest of the way to
  // the limit.
  void findDirection(double damping) {
    gradient_.noalias() = here_.phi.J.transpose() * here_.phi.y;
    J_ = here_.phi.J;
    held_.clear();
    for (const internal::JointLimit& limit : limits_) {
      const double slope = gradient_[limit.iv];
      const double way = (slope > 0 ? limit.lower : limit.upper) - here_.q[limit.iq];
      if (slope == 0 || std::abs(way) > kAtLimit) continue;
      J_.col(limit.iv).setZero();
      held_.push_back({limit.iv, way});
    }
    const double lambda = damping * here_.cost + kLeastRelativeDamping * J_.squaredNorm();
    if (lambda > 0) {
      step_.solve(J_, here_.phi.y, lambda, direction_);
      direction_ *= -1;
    } else {
      direction_.setZero(J_.cols());  // at zero cost with a Jacobian of zeros
    }
    for (const auto& [iv, way] : held_) direction_[iv] = way;
  }

  // Halves the step until it gains a fair share of what the slope promises (Armijo along the projected path,
  // Bertsekas 1976). Returns the number of halvings, more than kMostHalvings if none helps.
  int searchLine() {
    double share = 1;
    for (int halvings = 0; halvings <= kMostHalvings; ++halvings, share /= 2) {
      const double promised = moveAlong(share);
      if (!(promised < 0)) continue;
      evaluate(there_);
      if (there_.cost > here_.cost + kSufficientGain * promised) continue;
      std::swap(here_, there_);
      return halvings;
    }
    return kMostHalvings + 1;
  }

  // Writes the posture after a share of the step, clipped at the limits, to there_.q. Returns the change in
  // cost that the gradient promises for it.
  double moveAlong(double share) {
    move_ = share * direction_;
    if (model_.nq() == model_.nv()) {
      there_.q = here_.q + move_;
    } else {
      there_.q = integrate(model_, here_.q, move_);
    }
    internal::clampToLimits(limits_, there_.q);
    for (const internal::JointLimit& limit : limits_)
      move_[limit.iv] = there_.q[limit.iq] - here_.q[limit.iq];
    return 2 * gradient_.dot(move_);
  }

  const Model& model_;
  const std::span<const Task> tasks_;
  const Options options_;
  const std::vector<internal::JointLimit> limits_;
  std::vector<std::pair<int, double>> held_;  // joints at limits: index in v, and the distance left
  bool isWeighed_ = false;  // some task has no tolerance, so that fulfilling the others is not the end
  int iterations_ = 0;
  Point here_, there_;
  BodyPoses poses_;
  Eigen::MatrixXd J_;
  Eigen::VectorXd gradient_, direction_, move_;
  internal::DampedStep step_;
};

void requireProblem(const Model& model, std::span<const Task> tasks, const VectorArg& start,
                    const Options& options) {
  if (tasks.empty())
    throw Error({.what = "inverse kinematics", .found = "no task", .wanted = "at least one"});
  requireSize("start posture", start.size(), model.nq());
  requireFinite("start posture", start);
  requireCount("inverse kinematics: iterations", options.maxIterations, 1);
  requireCount("inverse kinematics: restarts", options.maxRestarts, 0);
  requirePositive("inverse kinematics: step tolerance", options.stepTolerance);
}

std::string message(std::span<const Task> tasks, const Result& result) {
  const std::string effort =
      fmt::format("after {} iterations and {} restarts", result.iterations, result.restarts);
  if (result.status == Result::Status::kSolved) return "solved " + effort;
  std::string misses;
  for (std::size_t i = 0; i < tasks.size(); ++i) {
    if (result.residuals[i] <= tasks[i].tolerance) continue;
    misses += fmt::format("{}task '{}' misses its target by {:.3g}", misses.empty() ? "" : ", ",
                          tasks[i].name, result.residuals[i]);
  }
  return (misses.empty() ? "tasks without tolerance might still improve " : misses + " ") + effort;
}

Result resultOf(std::span<const Task> tasks, const Descent& descent, Descent::End end, int restarts) {
  using Status = Result::Status;
  const Point& at = descent.here();
  Result result{.q = at.q, .cost = at.cost, .iterations = descent.iterations(), .restarts = restarts};
  for (std::size_t i = 0; i < tasks.size(); ++i)
    result.residuals.push_back(taskError(tasks[i], at.values[i]));
  if (end == Descent::End::kConverged) result.status = at.fulfilled ? Status::kSolved : Status::kUnreached;
  result.message = message(tasks, result);
  return result;
}

Result refusedResult(Result refused, const Descent& descent, int restarts) {
  refused.status = Result::Status::kRefused;
  refused.iterations = descent.iterations();
  refused.restarts = restarts;
  refused.message =
      fmt::format("no posture that reaches the target is allowed: found after {} iterations and {} restarts",
                  refused.iterations, refused.restarts);
  return refused;
}

using IsAllowed = std::function<bool(const Eigen::VectorXd& q)>;

Result search(const Model& model, std::span<const Task> tasks, const VectorArg& start, const Options& options,
              Rng& rng, const IsAllowed& isAllowed, std::optional<Result> refused = {}) {
  requireProblem(model, tasks, start, options);
  Descent descent(model, tasks, options);
  PostureSampler sampler(model, start);
  Eigen::VectorXd q = start, nearest = start;
  double leastCost = std::numeric_limits<double>::infinity();
  for (int restarts = 0; restarts <= options.maxRestarts; ++restarts) {
    if (restarts > 0) q = sampler.draw(rng);
    const Descent::End end = descent.run(q, false);
    if (descent.here().fulfilled) {
      if (!isAllowed || isAllowed(descent.here().q)) return resultOf(tasks, descent, end, restarts);
      if (!refused) refused = resultOf(tasks, descent, end, restarts);
    }
    if (descent.here().cost >= leastCost) continue;
    leastCost = descent.here().cost;
    nearest = descent.here().q;
  }
  if (refused) return refusedResult(*refused, descent, options.maxRestarts);
  const Descent::End end = descent.run(nearest, true);
  return resultOf(tasks, descent, end, options.maxRestarts);
}

// Moves angles of a closed form by full turns towards `start`. It has done so itself between two limits.
void turnTowards(const Model& model, const ClosedFormArm& arm, const Eigen::VectorXd& start,
                 Eigen::VectorXd& q) {
  constexpr double kTurn = 2 * std::numbers::pi;
  for (const JointId joint : arm.joints()) {
    const int iq = model[joint].qIndex;
    const double lower = model.lowerLimits()[iq], upper = model.upperLimits()[iq];
    if (std::isfinite(lower) && std::isfinite(upper)) continue;
    const double turns = std::nearbyint((start[iq] - q[iq]) / kTurn);
    q[iq] +=
        kTurn * std::clamp(turns, std::ceil((lower - q[iq]) / kTurn), std::floor((upper - q[iq]) / kTurn));
  }
}

// The allowed posture in closed form that is nearest to `start`, or else, kRefused, the nearest of all.
std::optional<Result> solveInClosedForm(const Model& model, const PoseTarget& target, const Task& task,
                                        const Eigen::VectorXd& start) {
  const std::optional<ClosedFormArm> arm = ClosedFormArm::of(model, target.body);
  if (!arm) return std::nullopt;
  std::vector<Eigen::VectorXd> postures;
  for (ClosedFormPosture& one : arm->postures(target.X_WB, start)) {
    turnTowards(model, *arm, start, one.q);
    postures.push_back(std::move(one.q));
  }
  std::sort(postures.begin(), postures.end(), [&](const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
    return (a - start).squaredNorm() < (b - start).squaredNorm();
  });
  std::optional<Result> refused;
  for (const Eigen::VectorXd& q : postures) {
    std::vector<TaskValue> values;
    TaskValue phi;
    stackTasks({&task, 1}, {model, q, forwardKinematics(model, q)}, values, phi);
    const double error = taskError(task, values.front());
    if (error > target.tolerance) continue;
    const bool isAllowed = !target.isAllowed || target.isAllowed(q);
    if (!isAllowed && refused) continue;
    Result result{.status = isAllowed ? Result::Status::kSolved : Result::Status::kRefused,
                  .q = q,
                  .residuals = {error},
                  .cost = phi.y.squaredNorm(),
                  .message = "solved in closed form"};
    if (isAllowed) return result;
    refused = std::move(result);
  }
  return refused;
}

}  // namespace

Result solveInverseKinematics(const Model& model, std::span<const Task> tasks, const VectorArg& start,
                              const Options& options, Rng& rng) {
  return search(model, tasks, start, options, rng, {});
}

Result solveInverseKinematics(const Model& model, const PoseTarget& target, const VectorArg& start,
                              const Options& options, Rng& rng) {
  requirePositive("inverse kinematics: tolerance", target.tolerance);
  const Task task{.name = model[target.body].name,
                  .map = poseTask(target.body, target.X_WB),
                  .tolerance = target.tolerance};
  requireProblem(model, {&task, 1}, start, options);
  Eigen::VectorXd clamped = start;
  internal::clampToLimits(internal::limitedCoordinates(model), clamped);
  std::optional<Result> closed = solveInClosedForm(model, target, task, clamped);
  if (closed && closed->status == Result::Status::kSolved) return *closed;
  return search(model, {&task, 1}, start, options, rng, target.isAllowed, std::move(closed));
}

}  // namespace rex
