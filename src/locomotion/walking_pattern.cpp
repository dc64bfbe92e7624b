#include "locomotion/walking_pattern.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "base/error.h"
#include "base/require.h"
#include "kinematics/hierarchical_step.h"
#include "kinematics/motion_profile.h"
#include "kinematics/task_maps.h"
#include "scene/state.h"

namespace rex {
namespace {

using Eigen::Matrix3d;
using Eigen::Matrix4d;
using Eigen::RowVector3d;
using Eigen::Vector3d;
using Eigen::Vector4d;

constexpr double kMostSteps = 1e5;

void requireOptions(const PreviewOptions& options) {
  requirePositive("preview control: height", options.height);
  requirePositive("preview control: g", options.g);
  requirePositive("preview control: step", options.step);
  requirePositive("preview control: preview", options.preview);
  requirePositive("preview control: weight Qe", options.Qe);
  requirePositive("preview control: weight R", options.R);
  const double steps = std::round(options.preview / options.step);
  if (!(steps >= 1 && steps <= kMostSteps))
    throw Error({.what = "preview control: preview",
                 .found = fmt::format("{:g} steps", steps),
                 .wanted = fmt::format("1 to {:g}", kMostSteps)});
}

// The cart on a table: x_{k+1} = A x_k + B u_k, p_k = C x_k.
struct Cart {
  Matrix3d A;
  Vector3d B;
  RowVector3d C;

  explicit Cart(const PreviewOptions& options) {
    const double h = options.step;
    A << 1, h, h * h / 2, 0, 1, h, 0, 0, 1;
    B << h * h * h / 6, h * h / 2, h;
    C << 1, 0, -options.height / options.g;
  }
};

}  // namespace

PreviewGains previewGains(const PreviewOptions& options) {
  requireOptions(options);
  const Cart cart(options);
  // The system of the error of p and the changes of x, driven by changes of u: there a constant error costs
  // without end.
  Matrix4d A = Matrix4d::Zero(), Q = Matrix4d::Zero();
  A(0, 0) = 1;
  A.topRightCorner<1, 3>() = cart.C * cart.A;
  A.bottomRightCorner<3, 3>() = cart.A;
  Vector4d B;
  B << cart.C * cart.B, cart.B;
  Q(0, 0) = options.Qe;
  const RiccatiResult riccati = solveDare(A, B, Q, Eigen::MatrixXd::Constant(1, 1, options.R));
  PreviewGains gains{.status = riccati.status, .message = riccati.message};
  if (riccati.status != RiccatiStatus::kSolved) return gains;
  const Matrix4d X = riccati.X;
  gains.Gi = riccati.K(0, 0);
  gains.Gx = riccati.K.rightCols<3>();
  const double weight = options.R + B.dot(X * B);
  const Matrix4d loop = A - B * riccati.K;
  gains.Gp.resize(std::lround(options.preview / options.step));
  // What a change of the reference adds to the cost, step by step backwards in time.
  Vector4d ahead = X.col(0);
  for (double& gain : gains.Gp) {
    gain = B.dot(ahead) / weight;
    ahead = (loop.transpose() * ahead).eval();
  }
  return gains;
}

PreviewMotion followZmp(const Eigen::Ref<const Eigen::Matrix2Xd>& reference, const PreviewOptions& options) {
  const Eigen::Index count = reference.cols();
  if (count == 0)
    throw Error({.what = "preview control: reference", .found = "no columns", .wanted = "at least one"});
  for (const auto& column : reference.colwise()) requireFinite("preview control: reference", column);
  const PreviewGains gains = previewGains(options);
  PreviewMotion motion{.status = gains.status, .message = gains.message};
  if (gains.status != RiccatiStatus::kSolved) return motion;
  const Cart cart(options);
  for (Eigen::Matrix2Xd* track : {&motion.c, &motion.v, &motion.a, &motion.zmp}) track->resize(2, count);
  for (Eigen::Index axis = 0; axis < 2; ++axis) {
    // Relative to the start, so that positions far away lose no digits.
    const double start = reference(axis, 0);
    Vector3d x = Vector3d::Zero(), change = Vector3d::Zero();
    double u = 0;
    for (Eigen::Index k = 0; k < count; ++k) {
      const double p = cart.C * x, error = p - (reference(axis, k) - start);
      motion.c(axis, k) = start + x[0];
      motion.v(axis, k) = x[1];
      motion.a(axis, k) = x[2];
      motion.zmp(axis, k) = start + p;
      motion.largestError = std::max(motion.largestError, std::abs(error));
      u -= gains.Gi * error + gains.Gx * change;
      for (Eigen::Index j = 0; j < gains.Gp.size() && k + j + 1 < count; ++j)
        u += gains.Gp[j] * (reference(axis, k + j + 1) - reference(axis, k + j));
      const Vector3d next = cart.A * x + cart.B * u;
      change = next - x;
      x = next;
    }
  }
  return motion;
}

namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Eigen::VectorXd;

// The share of the way back to the start posture that each posture takes in its free directions.
constexpr double kHomeward = 0.1;

Matrix3d turned(double yaw) { return Eigen::AngleAxisd(yaw, Vector3d::UnitZ()).toRotationMatrix(); }

// The turn from one yaw to another by the shorter way.
double turnBetween(double from, double to) { return std::remainder(to - from, 2 * std::numbers::pi); }

// Yaw and position of the centre of a sole.
struct SolePlace {
  Vector3d p;
  double yaw;
};

SolePlace solePlace(const WalkPhase& phase, Side side, double lift) {
  const Footstep& foot = side == Side::kLeft ? phase.left : phase.right;
  SolePlace at{.p = {foot.p.x(), foot.p.y(), 0}, .yaw = foot.yaw};
  if (!phase.swing || phase.swing->side != side) return at;
  const double share = profileAt({.shape = ProfileShape::kMinimumJerk}, phase.share).position;
  at.p.head<2>() += share * (phase.swing->p - foot.p);
  at.p.z() = lift * std::pow(4 * phase.share * (1 - phase.share), 3);
  at.yaw += share * turnBetween(foot.yaw, phase.swing->yaw);
  return at;
}

// The tasks of a posture at one time: first the feet and the centre of mass, then the trunk.
struct Targets {
  std::array<Task, 3> places;
  Task trunk;
};

Targets targetsAt(const Legs& legs, const WalkPhase& phase, const Vector3d& center, double lift) {
  const SolePlace left = solePlace(phase, Side::kLeft, lift), right = solePlace(phase, Side::kRight, lift);
  const auto foot = [&](const char* name, BodyId body, const SolePlace& at) {
    return Task{.name = name, .map = poseTask(body, {turned(at.yaw), at.p}, legs.p_FS)};
  };
  const double middle = left.yaw + turnBetween(left.yaw, right.yaw) / 2;
  return {.places = {foot("left foot", legs.leftFoot, left), foot("right foot", legs.rightFoot, right),
                     Task{.name = "centre of mass", .map = centerOfMassTask(), .target = center}},
          .trunk = {.name = "trunk", .map = orientationTask(legs.trunk, turned(middle))}};
}

// Brings q to the targets, and returns how far feet and centre of mass are off.
double solve(const Model& model, const Targets& targets, const VectorXd& home, const WalkOptions& options,
             VectorXd& q) {
  double error = 0;
  for (int i = 0;; ++i) {
    const BodyPoses poses = forwardKinematics(model, q);
    const Posture posture{model, q, poses};
    const TaskValue places = stackTasks(targets.places, posture);
    const TaskValue trunk = stackTasks(std::span(&targets.trunk, 1), posture);
    error = places.y.cwiseAbs().maxCoeff();
    if ((error <= options.tolerance / 10 && i > 0) || i == options.maxIterations) return error;
    const std::vector<TaskLevel> levels = {{.J = places.J, .dy = -places.y}, {.J = trunk.J, .dy = -trunk.y}};
    // Only once: moving home leads away from the targets, and must not keep Newton's steps from converging.
    const VectorXd a = (i == 0 ? kHomeward : 0) * difference(model, q, home);
    const VectorXd step = hierarchicalStep(levels, {.W = {}, .a = a});
    q = integrate(model, q, step).cwiseMax(model.lowerLimits()).cwiseMin(model.upperLimits());
  }
}

void requireOptions(const Model& model, const VectorArg& start, const WalkOptions& options) {
  requireSize("walking pattern: start", start.size(), model.nq());
  requirePositive("walking pattern: lift", options.lift);
  requirePositive("walking pattern: tolerance", options.tolerance);
  requireCount("walking pattern: iterations", options.maxIterations, 1);
}

}  // namespace

Pose solePose(const WalkPlan& plan, Side side, double t, double lift) {
  const SolePlace at = solePlace(phaseAt(plan, t), side, lift);
  return {turned(at.yaw), at.p};
}

WalkingPattern walkingPattern(const Model& model, const Legs& legs, const WalkPlan& plan,
                              const VectorArg& start, const WalkOptions& options) {
  requireOptions(model, start, options);
  const double step = options.preview.step;
  WalkingPattern pattern{.center = followZmp(zmpReference(plan, step), options.preview)};
  if (pattern.center.status != RiccatiStatus::kSolved) {
    pattern.status = WalkingPattern::Status::kNoPreview;
    pattern.message = pattern.center.message;
    return pattern;
  }
  const VectorXd home = start;
  VectorXd q = home;
  const Eigen::Index count = pattern.center.c.cols();
  pattern.Q.resize(model.nq(), count);
  for (Eigen::Index k = 0; k < count; ++k) {
    const double t = static_cast<double>(k) * step;
    const Vector3d center(pattern.center.c(0, k), pattern.center.c(1, k), options.preview.height);
    const Targets targets = targetsAt(legs, phaseAt(plan, t), center, options.lift);
    const double error = solve(model, targets, home, options, q);
    if (!(error <= options.tolerance)) {
      pattern.Q.conservativeResize(model.nq(), k);
      pattern.message = fmt::format("at {:.6g} s feet or centre of mass are off by {:.3g}", t, error);
      return pattern;
    }
    pattern.largestError = std::max(pattern.largestError, error);
    pattern.Q.col(k) = q;
  }
  pattern.status = WalkingPattern::Status::kWalks;
  pattern.message = fmt::format("walks for {:.6g} s", duration(plan));
  return pattern;
}

}  // namespace rex
