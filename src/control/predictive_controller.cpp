#include "control/predictive_controller.h"

#include <algorithm>
#include <limits>

#include <fmt/format.h>

#include "base/error.h"
#include "base/require.h"
#include "control/require_internal.h"

namespace rex {
namespace {

constexpr double kNoBound = std::numeric_limits<double>::infinity();

// Fills in what is empty: no limit.
void completeLimits(const char* name, int size, Eigen::VectorXd& lower, Eigen::VectorXd& upper) {
  if (lower.size() == 0) lower.setConstant(size, -kNoBound);
  if (upper.size() == 0) upper.setConstant(size, kNoBound);
  requireSize(fmt::format("predictive control: {}Min", name), lower.size(), size);
  requireSize(fmt::format("predictive control: {}Max", name), upper.size(), size);
  for (int i = 0; i < size; ++i)
    if (!(lower[i] <= upper[i]))
      throw Error({.what = fmt::format("predictive control: limits of {}[{}]", name, i),
                   .found = fmt::format("{:g} and {:g}", lower[i], upper[i]),
                   .wanted = "a lower one that is not above the upper one"});
}

LinearSystem inDiscreteTime(const LinearSystem& system) {
  if (!system.step)
    throw Error({.what = "predictive control",
                 .found = "a system in continuous time",
                 .wanted = "one in discrete time: discretized()"});
  return completed(system);
}

}  // namespace

PredictiveController::PredictiveController(const LinearSystem& system, const PredictiveOptions& options)
    : system_(inDiscreteTime(system)),
      options_(options),
      n_(static_cast<int>(system_.A.rows())),
      m_(static_cast<int>(system_.B.cols())),
      N_(options.horizon) {
  requireCount("horizon of predictive control", N_, 1);
  requireNotNegative("slack weight of predictive control", options_.slackWeight);
  internal::requireSymmetric("R", options_.R, m_);
  internal::requirePositiveDefinite("R", options_.R);
  // Also looks at Q.
  if (options_.F.size() == 0) {
    const RiccatiResult regulator = lqr(system_, options_.Q, options_.R);
    if (regulator.status != RiccatiStatus::kSolved)
      throw Error({.what = "predictive control: no cost after the horizon", .found = regulator.message});
    options_.F = regulator.X;
  }
  internal::requireSymmetric("Q", options_.Q, n_);
  internal::requireSymmetric("F", options_.F, n_);
  completeLimits("u", m_, options_.uMin, options_.uMax);
  completeLimits("x", n_, options_.xMin, options_.xMax);
  limits_ = limitsPerStep();

  response_ = Eigen::MatrixXd::Zero(N_ * n_, N_ * m_);
  weighted_ = response_;
  Eigen::MatrixXd effect = system_.B;  // of u_k on x_{k+age+1}
  for (int age = 0; age < N_; ++age, effect = (system_.A * effect).eval())
    for (int k = 0; k + age < N_; ++k) response_.block((k + age) * n_, k * m_, n_, m_) = effect;
  for (int t = 0; t < N_; ++t) {
    const Eigen::MatrixXd part = response_.middleRows(t * n_, n_);
    weighted_.middleRows(t * n_, n_) = (t + 1 < N_ ? options_.Q : options_.F) * part;
  }
  const int slacks = options_.slackWeight > 0 ? N_ : 0, controls = N_ * m_;
  Eigen::MatrixXd H = Eigen::MatrixXd::Zero(controls + slacks, controls + slacks);
  const Eigen::MatrixXd curvature = response_.transpose() * weighted_;
  H.topLeftCorner(controls, controls) = 2 * curvature;
  for (int t = 0; t < N_; ++t) H.block(t * m_, t * m_, m_, m_) += 2 * options_.R;
  H.diagonal().tail(slacks).setConstant(2 * options_.slackWeight);
  program_.emplace(H, limitRows());
}

std::vector<PredictiveController::Limit> PredictiveController::limitsPerStep() const {
  const auto isLimited = [](double lower, double upper) { return lower > -kNoBound || upper < kNoBound; };
  std::vector<Limit> limits;
  for (int i = 0; i < m_; ++i)
    if (isLimited(options_.uMin[i], options_.uMax[i]))
      limits.push_back({Of::kControl, i, options_.uMin[i], options_.uMax[i], 0});
  for (int i = 0; i < n_; ++i) {
    const double lower = options_.xMin[i], upper = options_.xMax[i];
    if (options_.slackWeight > 0) {
      if (upper < kNoBound) limits.push_back({Of::kState, i, -kNoBound, upper, -1});
      if (lower > -kNoBound) limits.push_back({Of::kState, i, lower, kNoBound, 1});
    } else if (isLimited(lower, upper)) {
      limits.push_back({Of::kState, i, lower, upper, 0});
    }
  }
  if (options_.slackWeight > 0) limits.push_back({Of::kSlack, 0, 0, kNoBound, 1});
  return limits;
}

Eigen::MatrixXd PredictiveController::limitRows() const {
  const int controls = N_ * m_, perStep = static_cast<int>(limits_.size());
  Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(N_ * perStep, controls + (options_.slackWeight > 0 ? N_ : 0));
  for (int t = 0; t < N_; ++t)
    for (int j = 0; j < perStep; ++j) {
      const Limit& limit = limits_[static_cast<std::size_t>(j)];
      auto row = rows.row(t * perStep + j);
      if (limit.of == Of::kControl) row[t * m_ + limit.index] = 1;
      if (limit.of == Of::kState) row.head(controls) = response_.row(t * n_ + limit.index);
      if (limit.slack != 0) row[controls + t] = limit.slack;
    }
  return rows;
}

PredictedMotion PredictiveController::plan(const VectorArg& x, const PredictedMotion* last) const {
  return plan(x, {.x = Eigen::VectorXd::Zero(n_), .u = Eigen::VectorXd::Zero(m_)}, last);
}

PredictedMotion PredictiveController::plan(const VectorArg& x, const RestPoint& target,
                                           const PredictedMotion* last) const {
  requireSize("predictive control: state", x.size(), n_);
  requireSize("predictive control: target state", target.x.size(), n_);
  requireSize("predictive control: target control", target.u.size(), m_);
  requireFinite("predictive control: state", x);
  requireFinite("predictive control: target state", target.x);
  requireFinite("predictive control: target control", target.u);

  // The motion under the target's control, to which the program adds the response to other controls.
  Eigen::MatrixXd free(n_, N_ + 1);
  free.col(0) = x;
  for (int t = 0; t < N_; ++t) free.col(t + 1) = system_.A * free.col(t) + system_.B * target.u;
  const Eigen::MatrixXd error = free.rightCols(N_).colwise() - target.x;
  const Eigen::VectorXd slope = weighted_.transpose() * Eigen::VectorXd(error.reshaped());
  const int perStep = static_cast<int>(limits_.size()), controls = N_ * m_;
  Eigen::VectorXd g =
      Eigen::VectorXd::Constant(controls + (options_.slackWeight > 0 ? N_ : 0), options_.slackWeight);
  g.head(controls) = 2 * slope;
  Eigen::VectorXd lower(N_ * perStep), upper(N_ * perStep);
  for (int row = 0; row < N_ * perStep; ++row) {
    const int t = row / perStep;
    const Limit& limit = limits_[static_cast<std::size_t>(row % perStep)];
    const double there = limit.of == Of::kControl ? target.u[limit.index]
                         : limit.of == Of::kState ? free(limit.index, t + 1)
                                                  : 0;
    lower[row] = limit.lower - there;
    upper[row] = limit.upper - there;
  }
  std::vector<int> guess;  // what was active, a step earlier
  if (last)
    for (const int row : last->active)
      if (row >= perStep && row < N_ * perStep) guess.push_back(row - perStep);

  PredictedMotion motion;
  describe(motion, program_->minimize(g, lower, upper, guess), target, x);
  return motion;
}

void PredictiveController::describe(PredictedMotion& motion, const QuadraticSolution& solution,
                                    const RestPoint& target, const Eigen::VectorXd& x) const {
  motion.status = solution.status;
  motion.iterations = solution.iterations;
  if (solution.status == QuadraticStatus::kInfeasible) motion.message = whyNot(solution.y);
  if (solution.status == QuadraticStatus::kStalled) motion.message = "the quadratic program was not solved";
  if (solution.status != QuadraticStatus::kOptimal) return;
  motion.active = solution.active;
  motion.residual = solution.residual;
  motion.U = solution.x.head(N_ * m_).reshaped(m_, N_).colwise() + target.u;
  motion.X.resize(n_, N_ + 1);
  motion.X.col(0) = x;
  for (int t = 0; t < N_; ++t) {
    motion.X.col(t + 1) = system_.A * motion.X.col(t) + system_.B * motion.U.col(t);
    const Eigen::VectorXd e = motion.X.col(t) - target.x, v = motion.U.col(t) - target.u;
    motion.cost += e.dot(options_.Q * e) + v.dot(options_.R * v);
  }
  const Eigen::VectorXd e = motion.X.col(N_) - target.x;
  motion.cost += e.dot(options_.F * e);
  for (const double s : solution.x.tail(solution.x.size() - N_ * m_)) {
    motion.cost += options_.slackWeight * (s + s * s);
    motion.violation = std::max(motion.violation, s);
  }
  motion.message = fmt::format("{} of {} limits are active", motion.active.size(), N_ * limits_.size());
}

// By the limit of a state that weighs most in the proof; without limits of states there always is a motion.
std::string PredictiveController::whyNot(const Eigen::VectorXd& y) const {
  const int perStep = static_cast<int>(limits_.size());
  int worst = -1;
  for (int row = 0; row < y.size(); ++row) {
    const bool isState = limits_[static_cast<std::size_t>(row % perStep)].of == Of::kState;
    if (isState && y[row] != 0 && (worst < 0 || std::abs(y[row]) > std::abs(y[worst]))) worst = row;
  }
  const Limit& limit = limits_[static_cast<std::size_t>(worst % perStep)];
  return fmt::format("no controls within the limits bring x[{}] {} {:g} at step {}", limit.index,
                     y[worst] > 0 ? "above" : "below", y[worst] > 0 ? limit.lower : limit.upper,
                     worst / perStep + 1);
}

}  // namespace rex
