#include "locomotion/walk_controller.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "base/error.h"
#include "base/require.h"
#include "dynamics/centroidal.h"
#include "kinematics/jacobians.h"
#include "kinematics/motion_profile.h"

namespace rex {
namespace {

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::VectorXd;

// Gains of unit masses on springs, 1/s^2 and 1/s: bodies that follow something, and the height.
constexpr double kSwingKp = 400, kSwingKd = 40, kTrunkKp = 100, kTrunkKd = 20, kHeightKp = 60, kHeightKd = 15;
// Standing feet adapt to the ground: only their velocities are damped, 1/s. So are those of the legs' joints.
constexpr double kStandingKd = 20, kLegKd = 2, kMomentumKd = 5;
// A foot stands from this load on, N, once most of its way has passed; one that comes too late goes on down,
// m/s.
constexpr double kTouch = 5, kMayTouch = 0.6, kSearch = 0.1;
// The zero moment point stays this far inside the soles, metres.
constexpr double kSoleMargin = 0.01;
// Errors of the capture point above this share of half the sole displace the landing, until the last part of
// the step.
constexpr double kShareOfSole = 0.5, kDecided = 0.85;
// Where a foot may land beside the other one, metres: in front of and behind it, and to its side.
constexpr double kReach = 0.5, kNearest = 0.15, kFarthest = 0.45;
// For differences of the swing motion, seconds.
constexpr double kDifference = 1e-3;

Matrix3d headed(double yaw) { return Eigen::AngleAxisd(yaw, Vector3d::UnitZ()).toRotationMatrix(); }

// The rotation vector from R to `wanted`, in W.
Vector3d turnTo(const Matrix3d& wanted, const Matrix3d& R) {
  const Eigen::AngleAxisd turn(wanted * R.transpose());
  return turn.angle() * turn.axis();
}

double minimumJerk(double share) { return profileAt({.shape = ProfileShape::kMinimumJerk}, share).position; }

void requireWalkControl(const Model& model, const VectorArg& home, const WalkControlOptions& options) {
  requireSize("walk controller: home", home.size(), model.nq());
  requireFinite("walk controller: home", VectorXd(home));
  requirePositive("walk controller: lift", options.lift);
  requirePositive("walk controller: gain of the capture point", options.captureGain);
}

}  // namespace

WalkController::WalkController(const Model& model, const Legs& legs, const WalkPlan& plan,
                               const VectorArg& home, const WalkControlOptions& options)
    : model_(model),
      legs_(legs),
      plan_(plan),
      home_(home),
      options_(options),
      body_(model, legs, plan.sole, options.body),
      motion_(followZmp(zmpReference(plan, options.preview.step), options.preview)),
      pendulum_{.height = options.preview.height, .g = options.preview.g},
      isLeg_(static_cast<std::size_t>(model.nv())) {
  requireWalkControl(model, home, options);
  if (motion_.status != RiccatiStatus::kSolved)
    throw Error({.what = "walk controller: preview control", .found = motion_.message, .wanted = "gains"});
  for (const BodyId foot : {legs.leftFoot, legs.rightFoot})
    for (BodyId body = foot; body != legs.trunk; body = model[body].parent)
      if (model[body].joint != kNoJoint) {
        const Joint& joint = model[model[body].joint];
        for (int i = 0; i < joint.nv; ++i) isLeg_[static_cast<std::size_t>(joint.vIndex + i)] = true;
      }
  feet_[1].side = Side::kRight;
}

WalkControl WalkController::control(const State& state, const FootLoads& loads) {
  const WalkPhase phase = phaseAt(plan_, state.time);
  update(state, loads, phase);
  WalkControl now;
  follow(state, now);
  if (phase.swing && options_.adjustsSteps) adjustStep(phase, now.captureError);
  if (phase.swing) {
    now.landing = phase.swing;
    now.landing->p += displacement_ + adjustment_;
  }
  now.displacement = displacement_;
  now.forces = body_.forces(state, goalAt(state, phase, now.zmp), active_);
  active_ = now.forces.active;
  return now;
}

// Where the feet are, and which of them stand.
void WalkController::update(const State& state, const FootLoads& loads, const WalkPhase& phase) {
  forwardKinematics(model_, state.q, poses_);
  for (Foot& foot : feet_) {
    const bool isLeft = foot.side == Side::kLeft;
    const BodyId body = isLeft ? legs_.leftFoot : legs_.rightFoot;
    foot.X_WS = {poses_[body].R, poses_[body] * legs_.p_FS};
    foot.velocity = poseJacobian(model_, poses_, body, legs_.p_FS) * state.v;
    const bool swings = phase.swing && phase.swing->side == foot.side;
    if (swings && !foot.swings) {
      foot.stands = false;
      foot.lifted << foot.X_WS.p.head<2>() - (isLeft ? phase.left : phase.right).p - displacement_,
          foot.X_WS.p.z();
    }
    if (!swings && foot.swings) {
      displacement_ += adjustment_;
      adjustment_.setZero();
    }
    foot.swings = swings;
    const bool mayTouch = !swings || phase.share > kMayTouch;
    if (mayTouch && (isLeft ? loads.left : loads.right) > kTouch) foot.stands = true;
  }
}

// The plan, the capture point's deviation from it, and the zero moment point that answers it.
void WalkController::follow(const State& state, WalkControl& now) const {
  const double at = state.time / options_.preview.step;
  const Index last = motion_.c.cols() - 1, before = std::min(static_cast<Index>(std::max(at, 0.)), last);
  const Index after = std::min(before + 1, last);
  const double share = std::clamp(at - static_cast<double>(before), 0., 1.);
  const auto between = [&](const Eigen::Matrix2Xd& track) -> Vector2d {
    return (1 - share) * track.col(before) + share * track.col(after);
  };
  const Centroidal center = centroidal(model_, poses_, state.v);
  const Vector2d planned = pendulum_.capturePoint({between(motion_.c), between(motion_.v)}) + displacement_;
  now.captureError = pendulum_.capturePoint({center.center.head<2>(), center.velocity.head<2>()}) - planned;
  now.plannedZmp = between(motion_.zmp) + displacement_;
  now.zmp = withinSoles(now.plannedZmp + (1 + options_.captureGain / pendulum_.omega()) * now.captureError);
}

Vector2d WalkController::withinSoles(const Vector2d& p) const {
  Eigen::Matrix2Xd corners(2, 0);
  for (const Foot& foot : feet_) {
    if (!foot.stands) continue;
    for (const double x : {-0.5, 0.5})
      for (const double y : {-0.5, 0.5}) {
        const Vector3d p_SC(x * std::max(plan_.sole.length - 2 * kSoleMargin, 0.),
                            y * std::max(plan_.sole.width - 2 * kSoleMargin, 0.), 0);
        corners.conservativeResize(2, corners.cols() + 1);
        corners.rightCols<1>() = (foot.X_WS * p_SC).head<2>();
      }
  }
  if (corners.cols() == 0) return p;
  const SupportMargin margin = supportMargin(supportPolygon(corners), p);
  return margin.isInside ? p : margin.nearest;
}

// While the zero moment point is at the border of the sole, the error grows as exp(omega t) until the foot
// lands.
void WalkController::adjustStep(const WalkPhase& phase, const Vector2d& captureError) {
  if (phase.share > kDecided) return;
  const bool leftSwings = phase.swing->side == Side::kLeft;
  const Footstep& stance = leftSwings ? phase.right : phase.left;
  const Eigen::Rotation2Dd R_WS(stance.yaw);
  const Vector2d error = R_WS.inverse() * captureError;
  const Vector2d bound = kShareOfSole / 2 * Vector2d(plan_.sole.length, plan_.sole.width);
  const double growth = std::exp(pendulum_.omega() * (1 - phase.share) * plan_.singleSupport);
  const Vector2d planned = R_WS.inverse() * (phase.swing->p - stance.p);
  Vector2d landing = planned + growth * (error - error.cwiseMax(-bound).cwiseMin(bound));
  const double side = leftSwings ? 1 : -1;
  // A plan may step closer or farther than that.
  landing.x() = std::clamp(landing.x(), std::min(-kReach, planned.x()), std::max(kReach, planned.x()));
  landing.y() = side * std::clamp(side * landing.y(), std::min(kNearest, side * planned.y()),
                                  std::max(kFarthest, side * planned.y()));
  adjustment_ = R_WS * (landing - planned);
}

// The planned motion of the sole, from where it really lifted off to where it shall land.
Vector3d WalkController::swingPlace(const Foot& foot, double t) const {
  const WalkPhase phase = phaseAt(plan_, t);
  const bool swings = phase.swing && phase.swing->side == foot.side;
  // Beyond the ends of the swing it rests.
  const bool isBefore = !swings && phaseAt(plan_, t + 2 * kDifference).swing;
  const double way = swings ? minimumJerk(phase.share) : isBefore ? 0 : 1;
  Vector3d p = solePose(plan_, foot.side, t, options_.lift).p;
  p.head<2>() += displacement_ + (1 - way) * foot.lifted.head<2>() + way * adjustment_;
  // Faster up than solePose(), so that the toes clear the next tile before they move forward.
  const double rise = swings ? 4 * phase.share * (1 - phase.share) : 0;
  p.z() = options_.lift * rise * rise + (1 - way) * foot.lifted.z();
  return p;
}

FootGoal WalkController::footGoal(const Foot& foot, const WalkPhase& phase, double t) const {
  FootGoal goal{.stands = foot.stands};
  if (foot.stands) {
    goal.acceleration = -kStandingKd * foot.velocity;
    return goal;
  }
  const Footstep& planned = foot.side == Side::kLeft ? phase.left : phase.right;
  double yaw = planned.yaw;
  Vector3d p, v, a = Vector3d::Zero();
  if (foot.swings) {
    yaw += minimumJerk(phase.share) * std::remainder(phase.swing->yaw - yaw, 2 * std::numbers::pi);
    const Vector3d ahead = swingPlace(foot, t + kDifference), behind = swingPlace(foot, t - kDifference);
    p = swingPlace(foot, t);
    v = (ahead - behind) / (2 * kDifference);
    a = (ahead - 2 * p + behind) / (kDifference * kDifference);
  } else {
    p << planned.p + displacement_, foot.X_WS.p.z();
    v = Vector3d(0, 0, -kSearch);
  }
  goal.acceleration.head<3>() = a + kSwingKp * (p - foot.X_WS.p) + kSwingKd * (v - foot.velocity.head<3>());
  goal.acceleration.tail<3>() =
      kSwingKp * turnTo(headed(yaw), foot.X_WS.R) - kSwingKd * foot.velocity.tail<3>();
  return goal;
}

WholeBodyGoal WalkController::goalAt(const State& state, const WalkPhase& phase, const Vector2d& zmp) const {
  WholeBodyGoal goal{.left = footGoal(feet_[0], phase, state.time),
                     .right = footGoal(feet_[1], phase, state.time)};
  double ground = 0;
  const int standing = feet_[0].stands + feet_[1].stands;
  for (const Foot& foot : feet_)
    if (foot.stands) ground += foot.X_WS.p.z() / standing;
  const Centroidal center = centroidal(model_, poses_, state.v);
  goal.center_W << pendulum_.acceleration(center.center.head<2>(), zmp),
      kHeightKp * (ground + pendulum_.height - center.center.z()) - kHeightKd * center.velocity.z();
  goal.angularMomentum_W = -kMomentumKd * center.angularMomentum;
  const Matrix3d R_left = solePose(plan_, Side::kLeft, state.time, options_.lift).R,
                 R_right = solePose(plan_, Side::kRight, state.time, options_.lift).R;
  const Matrix3d middle = headed(turnTo(R_right, R_left).z() / 2) * R_left;
  const Vector3d angular = angularJacobian(model_, poses_, legs_.trunk) * state.v;
  goal.trunk_W = kTrunkKp * turnTo(middle, poses_[legs_.trunk].R) - kTrunkKd * angular;
  goal.joints = kTrunkKp * difference(model_, state.q, home_) - kTrunkKd * state.v;
  for (Index i = 0; i < goal.joints.size(); ++i)
    if (isLeg_[static_cast<std::size_t>(i)]) goal.joints[i] = -kLegKd * state.v[i];
  return goal;
}

}  // namespace rex
