#include <algorithm>
#include <cmath>
#include <utility>

#include "base/error.h"
#include "physics/contact_free_motion_internal.h"

namespace rex::internal {
namespace {

// A position motor approaches its target at this rate, 1/s: slowly enough for arms to brake.
constexpr double kPositionRate = 20;
// Joints beyond a limit come back at this rate, 1/s, and at most this fast, rad/s or m/s: they keep that
// speed when they are back, so a higher one would throw a robot that starts beyond its limits.
constexpr double kLimitRate = 20, kLimitSpeed = 1;

// A spring that is felt where the coordinate is at the start of a step keeps its energy, and is stable while
// stiffness * h^2 is below four times the inertia; springs of several joints may add up. So what exceeds half
// of the inertia is felt at the end of the step instead, which damps at any stiffness.
constexpr double kSpringShare = 0.5;

// How much less the impulse is per unit of the new velocity.
double slopeOf(const JointLaw& law, const JointPlace& at, double h) {
  return law.damping * h + std::max(law.stiffness * h * h - kSpringShare * at.inertia, 0.0);
}

}  // namespace

JointLaw jointLaw(const Model& model, const Joint& joint, int coordinate, const PhysicsOptions& options) {
  JointLaw law{.maxVelocity = joint.maxVelocity, .armature = joint.armature, .stiffness = joint.stiffness};
  if (options.jointFriction) {
    law.damping = joint.damping;
    law.friction = joint.friction;
  }
  if (options.jointLimits && joint.nq == joint.nv) {
    law.lower = model.lowerLimits()[joint.qIndex + coordinate];
    law.upper = model.upperLimits()[joint.qIndex + coordinate];
  }
  return law;
}

JointGoals jointGoals(const JointLaw& law, const Motor& motor, const JointPlace& at, double h) {
  JointGoals goals;
  const double q = at.q, v = at.v;
  if (motor.kind != Motor::Kind::kForce) {
    const double rate = std::min(kPositionRate, 1 / h);
    const double wanted = motor.kind == Motor::Kind::kVelocity ? motor.target : rate * (motor.target - q);
    goals[kMotor] = {std::clamp(wanted, -law.maxVelocity, law.maxVelocity), -motor.maxForce * h,
                     motor.maxForce * h};
  }
  if (const double slope = slopeOf(law, at, h); slope > 0)
    goals[kDamping] = {0, -kInfinity, kInfinity, 1 / slope};
  if (law.friction > 0) goals[kFriction] = {0, -law.friction * h, law.friction * h};
  const double reach = kLimitReach + 2 * h * std::abs(v);
  const auto backOff = [&](double beyond) {
    return beyond > 0 ? std::min(kLimitRate * beyond, kLimitSpeed) : beyond / h;
  };
  if (law.lower - q > -reach) goals[kLowerLimit] = {backOff(law.lower - q), 0, kInfinity};
  if (q - law.upper > -reach) goals[kUpperLimit] = {-backOff(q - law.upper), -kInfinity, 0};
  return goals;
}

namespace {

// So many times all move at once, which nearly always ends it; then one at a time, which cannot cycle.
constexpr int kRoundsTogether = 8, kRounds = 200;
// Impulses and velocities lie outside if they do so by more, relative to their size.
constexpr double kRounding = 1e-12;

bool isBelow(double x, double bound) {
  return std::isinf(bound) ? x < bound : x < bound - kRounding * (1 + std::abs(bound));
}

}  // namespace

JointImpulses::JointImpulses(Eigen::Index count)
    : coordinates_(static_cast<std::size_t>(count)),
      A_(count, count),
      b_(count),
      impulse_(count),
      llt_(count) {}

void JointImpulses::reset() {
  for (Coordinate& one : coordinates_) one.last = -1;
}

void JointImpulses::insert(Coordinate& one, const Edge& edge) {
  Edge* at = one.edges.data();
  Edge* const end = at + one.count;
  while (at != end && at->velocity < edge.velocity) ++at;
  if (at != end && at->velocity == edge.velocity) {
    at->lowest += edge.lowest;
    at->highest += edge.highest;
    return;
  }
  std::move_backward(at, end, end + 1);
  *at = edge;
  ++one.count;
}

void JointImpulses::set(Eigen::Index i, const JointGoals& goals) {
  Coordinate& one = coordinates_[static_cast<std::size_t>(i)];
  one.count = 0;
  one.softening = goals[kDamping] ? 1 / goals[kDamping]->softness : 0;
  for (const int purpose : {kLowerLimit, kUpperLimit, kFriction, kMotor}) {
    if (!goals[purpose]) continue;
    Edge edge{goals[purpose]->velocity, goals[purpose]->lowest, goals[purpose]->highest, purpose};
    // However strong a motor is, limits stop it.
    if (purpose == kMotor && goals[kLowerLimit])
      edge.velocity = std::max(edge.velocity, goals[kLowerLimit]->velocity);
    if (purpose == kMotor && goals[kUpperLimit])
      edge.velocity = std::min(edge.velocity, goals[kUpperLimit]->velocity);
    insert(one, edge);
  }
}

// The impulse above so many edges.
double JointImpulses::impulseAbove(const Coordinate& one, int edges) {
  double sum = 0;
  for (int k = 0; k < one.count; ++k)
    sum += k < edges ? one.edges[static_cast<std::size_t>(k)].lowest
                     : one.edges[static_cast<std::size_t>(k)].highest;
  return sum;
}

// Whether it lies beyond a limit or where a motor of any strength does not let it.
bool JointImpulses::isForbidden(const Coordinate& one) {
  return one.place % 2 == 0 && std::isinf(impulseAbove(one, one.place / 2));
}

// Begins where the last step ended.
void JointImpulses::begin(const Eigen::VectorXd& v) {
  for (std::size_t i = 0; i < coordinates_.size(); ++i) {
    Coordinate& one = coordinates_[i];
    one.place = 0;
    for (int k = 0; k < one.count; ++k) {
      const Edge& edge = one.edges[static_cast<std::size_t>(k)];
      if (edge.purpose == one.last) {
        one.place = 2 * k + 1;
        break;
      }
      if (edge.velocity < v[static_cast<Eigen::Index>(i)]) one.place = 2 * k + 2;
    }
    if (isForbidden(one)) one.place += impulseAbove(one, one.place / 2) > 0 ? 1 : -1;
  }
}

// Moves coordinate i to the next place if it does not belong where it is.
bool JointImpulses::move(Eigen::Index i, double v, double impulse) {
  Coordinate& one = coordinates_[static_cast<std::size_t>(i)];
  const int k = one.place / 2;
  int way = 0;
  if (one.place % 2 == 1) {
    if (isBelow(impulseAbove(one, k), impulse)) way = -1;
    if (isBelow(impulse, impulseAbove(one, k + 1))) way = 1;
  } else {
    if (k < one.count && isBelow(one.edges[static_cast<std::size_t>(k)].velocity, v)) way = 1;
    if (k > 0 && isBelow(v, one.edges[static_cast<std::size_t>(k) - 1].velocity)) way = -1;
  }
  one.place += way;
  if (isForbidden(one)) one.place += way;
  return way != 0;
}

bool JointImpulses::solve(Eigen::MatrixXd& M, const Eigen::VectorXd& p, Eigen::VectorXd& v) {
  const Eigen::Index count = v.size();
  begin(v);
  for (Eigen::Index i = 0; i < count; ++i) M(i, i) += coordinates_[static_cast<std::size_t>(i)].softening;
  for (int round = 0; round < kRounds; ++round) {
    // Coordinates at an edge have its velocity; the others move as their impulses tell.
    A_ = M;
    b_ = p;
    for (Eigen::Index i = 0; i < count; ++i) {
      const Coordinate& one = coordinates_[static_cast<std::size_t>(i)];
      if (one.place % 2 == 0) {
        b_[i] += impulseAbove(one, one.place / 2);
      } else {
        v[i] = one.edges[static_cast<std::size_t>(one.place / 2)].velocity;
        b_.noalias() -= M.col(i) * v[i];
      }
    }
    for (Eigen::Index i = 0; i < count; ++i) {
      const Coordinate& one = coordinates_[static_cast<std::size_t>(i)];
      if (one.place % 2 == 0) continue;
      A_.row(i).setZero();
      A_.col(i).setZero();
      A_(i, i) = 1;
      b_[i] = v[i];
    }
    llt_.compute(A_);
    if (llt_.info() != Eigen::Success) return false;
    llt_.solveInPlace(b_);
    v = b_;
    impulse_.noalias() = M * v;
    impulse_ -= p;
    bool hasMoved = false;
    for (Eigen::Index i = 0; i < count && (round < kRoundsTogether || !hasMoved); ++i)
      hasMoved = move(i, v[i], impulse_[i]) || hasMoved;
    if (hasMoved) continue;
    for (Coordinate& one : coordinates_)
      one.last = one.place % 2 == 1 ? one.edges[static_cast<std::size_t>(one.place / 2)].purpose : -1;
    return true;
  }
  return false;
}

namespace {

// Turns of a joint in a step, radians: up to the first, Beeman's method keeps the energy; beyond, steps are
// cut so that Runge's and Kutta's does, up to the last.
constexpr double kSmallTurn = 0.01, kMostTurn = 1;
// Up to this turn, one step does where only limits hold joints: its error is of first order, so that an arm
// which swings at 20 rad/s with one joint at a limit would gain 1 % of its energy in a second.
constexpr double kSmallTurnAtLimits = 0.0025;
// The same for the phase of springs; beyond the last they are damped.
constexpr double kSmallPhase = 0.1, kMostPhase = 2;

int partsOf(double share) { return std::max(1, static_cast<int>(std::ceil(share))); }

bool isHinge(const Joint& joint) {
  return !joint.mimics && (joint.type == JointType::kHinge || joint.type == JointType::kRigid);
}

}  // namespace

ContactFreeMotion::ContactFreeMotion(const Model& model, const PhysicsOptions& options)
    : model_(&model),
      gravity_W_(options.gravity_W),
      isAble_(model.pins().empty() && std::ranges::all_of(model.joints(), isHinge)),
      motors_(static_cast<std::size_t>(model.nv())),
      impulses_(isAble_ ? model.nv() : 0),
      u_(Eigen::VectorXd::Zero(model.nv())),
      p_(u_),
      v_(u_) {
  if (!isAble_) return;
  stepper_.emplace(model, StepperOptions{.integrator = Integrator::kBeeman, .gravity_W = options.gravity_W});
  fastStepper_.emplace(model, StepperOptions{.gravity_W = options.gravity_W});
  laws_.resize(static_cast<std::size_t>(model.nv()));
  stiffness_ = rest_ = Eigen::VectorXd::Zero(model.nv());
  for (const Joint& joint : model.joints()) {
    if (joint.nv == 0) continue;
    const JointLaw law = jointLaw(model, joint, 0, options);
    laws_[static_cast<std::size_t>(joint.vIndex)] = law;
    resists_ = resists_ || law.damping > 0 || law.friction > 0;
    stiffness_[joint.vIndex] = joint.stiffness;
    rest_[joint.vIndex] = joint.springReference[0];
  }
}

void ContactFreeMotion::setMotors(std::span<const Motor> motors) {
  motors_.assign(motors.begin(), motors.end());
  hasForcesOnly_ = true;
  for (std::size_t i = 0; i < motors.size(); ++i) {
    const bool isForce = motors[i].kind == Motor::Kind::kForce;
    hasForcesOnly_ = hasForcesOnly_ && isForce;
    u_[static_cast<Eigen::Index>(i)] = isForce ? motors[i].target : 0;
  }
}

void ContactFreeMotion::reset() {
  if (stepper_) stepper_->reset();
  impulses_.reset();
}

bool ContactFreeMotion::onlyForcesAct(const State& state, double h) const {
  if (resists_ || !hasForcesOnly_) return false;
  for (Eigen::Index i = 0; i < state.q.size(); ++i) {
    const JointLaw& law = laws_[static_cast<std::size_t>(i)];
    const double reach = kLimitReach + 2 * h * std::abs(state.v[i]);
    if (state.q[i] - law.lower <= reach || law.upper - state.q[i] <= reach) return false;
  }
  return true;
}

void ContactFreeMotion::findMobility(const State& state) {
  const Eigen::Index n = state.v.size();
  motion_.M.resize(n, n);
  massMatrix(*model_, state.q, workspace_, motion_.M);
  mobility_ = motion_.M.llt().solve(Eigen::MatrixXd::Identity(n, n)).diagonal();
}

void ContactFreeMotion::stepFreely(State& state, double h, int count) {
  if (count == 1) return stepper_->step(state, u_, h);
  next_ = state;
  for (int i = 0; i < count; ++i) fastStepper_->step(next_, u_, h / count);
  std::swap(state, next_);
}

bool ContactFreeMotion::stepWithGoals(State& state, double h, int count) {
  if (count == 1) return stepWithGoals(state, h);
  State now = state;
  for (int i = 0; i < count; ++i)
    if (!stepWithGoals(now, h / count)) return false;
  std::swap(state, now);
  return true;
}

bool ContactFreeMotion::stepWithGoals(State& state, double h) {
  equationOfMotion(*model_, state.q, state.v, gravity_W_, workspace_, motion_);
  p_ = h * (u_ - motion_.F);
  p_.noalias() += motion_.M * state.v;
  for (Eigen::Index i = 0; i < p_.size(); ++i) {
    const auto k = static_cast<std::size_t>(i);
    JointPlace at{.q = state.q[i], .v = state.v[i]};
    if (laws_[k].stiffness > 0) {
      at.stretch = state.q[i] - rest_[i];
      at.inertia = 1 / mobility_[i];
      p_[i] += springImpulse(laws_[k], at.stretch, h);
    }
    impulses_.set(i, jointGoals(laws_[k], motors_[k], at, h));
  }
  v_ = state.v;
  if (!impulses_.solve(motion_.M, p_, v_) || !v_.allFinite()) return false;
  state.v = v_;
  state.q += h * v_;
  return true;
}

bool ContactFreeMotion::step(State& state, double h) {
  const double turn = state.v.lpNorm<Eigen::Infinity>() * h;
  if (!isAble_ || !(turn < kMostTurn)) return false;
  try {
    double phase = 0;  // of the fastest oscillation, or more: h^2 times the trace of M^-1 K bounds its square
    if (model_->hasSprings()) {
      findMobility(state);
      phase = h * std::sqrt(stiffness_.dot(mobility_));
    }
    if (!onlyForcesAct(state, h) || !(phase < kMostPhase))
      return stepWithGoals(state, h, hasForcesOnly_ && !resists_ ? partsOf(turn / kSmallTurnAtLimits) : 1);
    stepFreely(state, h, partsOf(std::max(turn / kSmallTurn, phase / kSmallPhase)));
    return true;
  } catch (const Error&) {
    return false;  // the state is as it was, and the caller's own step tells what is wrong
  }
}

}  // namespace rex::internal
