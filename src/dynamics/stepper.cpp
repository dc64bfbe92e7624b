#include "dynamics/stepper.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "base/error.h"
#include "base/lane_math.h"
#include "base/require.h"
#include "base/rng.h"
#include "dynamics/forward_dynamics.h"
#include "dynamics/inverse_dynamics.h"
#include "dynamics/joint_springs.h"
#include "geometry/rotation.h"
#include "scene/state.h"

namespace rex::internal {

/// How the states of a model change while the forces u of its joints are held: the right-hand side that
/// integrators step along. It allocates only when it is made.
class HeldMotion {
 public:
  /// Where a quaternion stands in q, and its angular velocity in v.
  struct QuaternionPlace {
    int qIndex = 0, vIndex = 0;
  };

  HeldMotion(const Model& model, const Eigen::Vector3d& gravity_W, const JointForces& jointForces);

  const Model& model() const { return model_; }
  double time() const { return time_; }
  const std::vector<QuaternionPlace>& quaternions() const { return quaternions_; }

  /// What holds until the next call: u, and the time that errors name.
  void hold(const VectorArg& u, double time);
  /// What pushes until the next call: none at first.
  void push(std::vector<Wrench> wrenches) { wrenches_ = std::move(wrenches); }

  /// dv/dt (nv), with the forces that joints and wrenches add. Throws Error as forwardDynamics and
  /// requireBounded.
  void accelerate(const Eigen::VectorXd& q, const Eigen::VectorXd& v, Eigen::VectorXd& a);
  /// dq/dt (nq): v, and of quaternions q o (0, v) / 2. Linear in q, so they need not be unit ones.
  void rate(const Eigen::VectorXd& q, const Eigen::VectorXd& v, Eigen::VectorXd& dq) const;
  /// Moves q on by d (nv), as rex::integrate, and makes quaternions unit ones.
  void move(Eigen::VectorXd& q, const Eigen::VectorXd& d) const;
  void normalize(Eigen::VectorXd& q) const;

  /// Throws Error naming time and joint where a velocity is beyond that of light, or a number is not finite.
  void requireBounded(const Eigen::VectorXd& q, const Eigen::VectorXd& v) const;

 private:
  Model model_;
  Eigen::Vector3d gravity_W_;
  JointForces jointForces_;
  bool hasJointForces_;
  std::vector<QuaternionPlace> quaternions_;
  std::vector<Wrench> wrenches_{};
  DynamicsWorkspace workspace_{};
  Eigen::VectorXd u_, forces_, added_;  // forces_: u_ and all that is added
  double time_ = 0;
};

// Each moves q and v on by h, from one state to another that has its sizes already; time is the caller's.

/// Euler's steps: q moves by the old velocity or by the new one.
class Euler {
 public:
  void step(HeldMotion& motion, const State& from, double h, bool withNewVelocity, State& to);

 private:
  Eigen::VectorXd a_{}, d_{};
};

/// The classic one of fourth order. Quaternions take part as four numbers and are made unit ones at the end.
class RungeKutta {
 public:
  void step(HeldMotion& motion, const State& from, double h, State& to);
  /// The acceleration at `from`.
  const Eigen::VectorXd& firstAcceleration() const { return firstAcceleration_; }

 private:
  State stage_{};
  Eigen::VectorXd dq_{}, dv_{}, firstAcceleration_{};
};

/// After Beeman (Some multistep methods for use in molecular dynamics calculations, 1976), with velocities
/// predicted by Adams and Bashforth and corrected by Adams and Moulton. The acceleration at the predicted
/// velocity serves this step and the next.
class Beeman {
 public:
  void step(HeldMotion& motion, const State& from, const VectorArg& u, double h, State& to);
  void reset() { steps_ = 0; }

 private:
  bool continues(const State& from, const VectorArg& u, double h) const;
  void extrapolate(HeldMotion& motion, const State& from, double h, State& to);

  RungeKutta start_{};
  int steps_ = 0;                               // since the start, up to three
  Eigen::VectorXd now_{}, before_{}, first_{};  // the acceleration at `from`, and those at two states before
  Eigen::VectorXd next_{}, d_{};
  State last_{};  // what the last step led to, and what it was told
  Eigen::VectorXd u_{};
  double h_ = 0;
};

/// Half a step with the old velocity, a kick, half a step with the new one. The acceleration of the kick is
/// that in the middle, at the mean of both velocities: with h and -h the same. Where forces depend on q only,
/// this is the textbook's.
class Leapfrog {
 public:
  /// Throws Error naming time, h and the joint that changes most if that acceleration is not found.
  void step(HeldMotion& motion, const State& from, double h, State& to);

 private:
  void findMiddle(HeldMotion& motion, const Eigen::VectorXd& v, double h);

  Eigen::VectorXd q_{}, v_{}, a_{}, next_{}, d_{};
};

}  // namespace rex::internal

namespace rex {
namespace {

// A joint that mimics moves at `ratio` times v, and its force acts on v with that lever.
void addFriction(const Model& model, const VectorArg& v, double frictionSpeed,
                 Eigen::Ref<Eigen::VectorXd> u) {
  for (const Joint& joint : model.joints()) {
    for (int i = joint.vIndex; i < joint.vIndex + joint.nv; ++i) {
      const double rate = joint.ratio * v[i];
      u[i] -= joint.ratio * (joint.damping * rate + joint.friction * std::tanh(rate / frictionSpeed));
    }
  }
}

void addLimits(const Model& model, const VectorArg& q, const VectorArg& v, const JointForces& forces,
               Eigen::Ref<Eigen::VectorXd> u) {
  forEachPlainCoordinate(model, [&](int iq, int iv, const DegreeOfFreedom&) {
    const double below = model.lowerLimits()[iq] - q[iq], above = q[iq] - model.upperLimits()[iq];
    if (below > 0) u[iv] += forces.limitStiffness * below - forces.limitDamping * v[iv];
    if (above > 0) u[iv] -= forces.limitStiffness * above + forces.limitDamping * v[iv];
  });
}

}  // namespace

void requireValid(const JointForces& forces) {
  requirePositive("joint forces: friction speed", forces.frictionSpeed);
  requireNotNegative("joint forces: limit stiffness", forces.limitStiffness);
  requireNotNegative("joint forces: limit damping", forces.limitDamping);
}

void jointForces(const Model& model, const VectorArg& q, const VectorArg& v, const JointForces& forces,
                 Eigen::Ref<Eigen::VectorXd> u) {
  requireSize("joint positions q", q.size(), model.nq());
  requireSize("joint velocities v", v.size(), model.nv());
  requireSize("joint forces u", u.size(), model.nv());
  requireValid(forces);
  u.setZero();
  if (forces.springs) addSpringForces(model, q, u);
  if (forces.friction) addFriction(model, v, forces.frictionSpeed, u);
  if (forces.limitStiffness > 0 || forces.limitDamping > 0) addLimits(model, q, v, forces, u);
}

Eigen::VectorXd jointForces(const Model& model, const VectorArg& q, const VectorArg& v,
                            const JointForces& forces) {
  Eigen::VectorXd u(model.nv());
  jointForces(model, q, v, forces, u);
  return u;
}

}  // namespace rex

namespace rex::internal {
namespace {

// m/s, or rad/s at one metre from the axis. Nothing moves faster, so any larger value is a numerical failure
// and would soon overflow.
constexpr double kSpeedOfLight = 299792458;

// Visits the parts of q and v that lie between quaternions: from, to, and how many numbers.
template <class Visit>
void forEachPlainPart(const std::vector<HeldMotion::QuaternionPlace>& quaternions, Eigen::Index nv,
                      const Visit& visit) {
  Eigen::Index iq = 0, iv = 0;
  for (const HeldMotion::QuaternionPlace& at : quaternions) {
    visit(iq, iv, at.vIndex - iv);
    iq = at.qIndex + 4;
    iv = at.vIndex + 3;
  }
  visit(iq, iv, nv - iv);
}

Quaternion turnBy(const Eigen::Vector3d& rotationVector) {
  const double angle = rotationVector.norm();
  const SinCos<double> half = sinCos(angle / 2);
  Quaternion turn;
  turn << half.cosine, (angle > 0 ? half.sine / angle : 0.5) * rotationVector;
  return turn;
}

}  // namespace

HeldMotion::HeldMotion(const Model& model, const Eigen::Vector3d& gravity_W, const JointForces& jointForces)
    : model_(model),
      gravity_W_(gravity_W),
      jointForces_(jointForces),
      hasJointForces_(jointForces.any(model)),
      u_(Eigen::VectorXd::Zero(model.nv())),
      forces_(Eigen::VectorXd::Zero(model.nv())),
      added_(Eigen::VectorXd::Zero(model.nv())) {
  forEachQuaternion(model, [&](int iq, int iv) { quaternions_.push_back({iq, iv}); });
}

void HeldMotion::hold(const VectorArg& u, double time) {
  u_ = u;
  time_ = time;
}

void HeldMotion::accelerate(const Eigen::VectorXd& q, const Eigen::VectorXd& v, Eigen::VectorXd& a) {
  requireBounded(q, v);
  forces_ = u_;
  if (hasJointForces_) {
    jointForces(model_, q, v, jointForces_, added_);
    forces_ += added_;
  }
  if (!wrenches_.empty()) {
    forwardKinematics(model_, q, workspace_.poses);
    wrenchForces(model_, workspace_.poses, wrenches_, workspace_, added_);
    forces_ += added_;
  }
  forwardDynamics(model_, q, v, forces_, gravity_W_, workspace_, a);
}

void HeldMotion::rate(const Eigen::VectorXd& q, const Eigen::VectorXd& v, Eigen::VectorXd& dq) const {
  forEachPlainPart(quaternions_, v.size(), [&](Eigen::Index iq, Eigen::Index iv, Eigen::Index count) {
    dq.segment(iq, count) = v.segment(iv, count);
  });
  for (const QuaternionPlace& at : quaternions_) {
    Quaternion w;
    w << 0, v.segment<3>(at.vIndex);
    dq.segment<4>(at.qIndex) = 0.5 * quaternionProduct(q.segment<4>(at.qIndex), w);
  }
}

void HeldMotion::move(Eigen::VectorXd& q, const Eigen::VectorXd& d) const {
  forEachPlainPart(quaternions_, d.size(), [&](Eigen::Index iq, Eigen::Index iv, Eigen::Index count) {
    q.segment(iq, count) += d.segment(iv, count);
  });
  for (const QuaternionPlace& at : quaternions_) {
    q.segment<4>(at.qIndex) = quaternionProduct(q.segment<4>(at.qIndex), turnBy(d.segment<3>(at.vIndex)));
  }
  normalize(q);
}

void HeldMotion::normalize(Eigen::VectorXd& q) const {
  for (const QuaternionPlace& at : quaternions_) q.segment<4>(at.qIndex).normalize();
}

void HeldMotion::requireBounded(const Eigen::VectorXd& q, const Eigen::VectorXd& v) const {
  const auto fail = [&](const std::string& joint, const char* what, double value) {
    throw Error({.what = fmt::format("joint '{}': its motion grows without bounds at {:g} s", joint, time_),
                 .found = fmt::format("a {} of {:g}", what, value),
                 .wanted = "less than the speed of light: take shorter steps or smaller forces"});
  };
  for (Eigen::Index i = 0; i < v.size(); ++i)
    if (!(std::abs(v[i]) < kSpeedOfLight)) fail(jointOfVelocity(model_, i).name, "velocity", v[i]);
  for (Eigen::Index i = 0; i < q.size(); ++i)
    if (!std::isfinite(q[i])) fail(jointOfPosition(model_, i).name, "position", q[i]);
}

void Euler::step(HeldMotion& motion, const State& from, double h, bool withNewVelocity, State& to) {
  a_.resizeLike(from.v);
  motion.accelerate(from.q, from.v, a_);
  to.v = from.v + h * a_;
  d_ = h * (withNewVelocity ? to.v : from.v);
  to.q = from.q;
  motion.move(to.q, d_);
}

void RungeKutta::step(HeldMotion& motion, const State& from, double h, State& to) {
  constexpr std::array<double, 4> kShareOfStep{0, 0.5, 0.5, 1}, kWeight{1. / 6, 1. / 3, 1. / 3, 1. / 6};
  dq_.setZero(from.q.size());
  dv_.setZero(from.v.size());
  to.q = from.q;
  to.v = from.v;
  for (std::size_t i = 0; i < kWeight.size(); ++i) {
    stage_.q = from.q + kShareOfStep[i] * h * dq_;
    stage_.v = from.v + kShareOfStep[i] * h * dv_;
    motion.rate(stage_.q, stage_.v, dq_);
    motion.accelerate(stage_.q, stage_.v, dv_);
    if (i == 0) firstAcceleration_ = dv_;
    to.q += kWeight[i] * h * dq_;
    to.v += kWeight[i] * h * dv_;
  }
  motion.normalize(to.q);
}

bool Beeman::continues(const State& from, const VectorArg& u, double h) const {
  return steps_ > 0 && h == h_ && from.q == last_.q && from.v == last_.v && u == u_;
}

void Beeman::step(HeldMotion& motion, const State& from, const VectorArg& u, double h, State& to) {
  constexpr int kStartingSteps = 2;
  if (!continues(from, u, h)) steps_ = 0;
  if (steps_ < kStartingSteps) {
    start_.step(motion, from, h, to);
    first_.swap(before_);
    before_ = start_.firstAcceleration();
  } else {
    now_.resizeLike(from.v);
    if (steps_ == kStartingSteps) motion.accelerate(from.q, from.v, now_);
    extrapolate(motion, from, h, to);
  }
  steps_ = std::min(steps_ + 1, kStartingSteps + 1);
  last_.q = to.q;
  last_.v = to.v;
  u_ = u;
  h_ = h;
}

void Beeman::extrapolate(HeldMotion& motion, const State& from, double h, State& to) {
  to.q = from.q;
  to.v = from.v + h / 12 * (23 * now_ - 16 * before_ + 5 * first_);
  d_ = h * from.v + h * h / 24 * (19 * now_ - 10 * before_ + 3 * first_);
  // Turns about a moving axis do not simply add up: this is the next term of Magnus (1954).
  for (const HeldMotion::QuaternionPlace& at : motion.quaternions())
    d_.segment<3>(at.vIndex) += h * h / 12 * from.v.segment<3>(at.vIndex).cross(to.v.segment<3>(at.vIndex));
  motion.move(to.q, d_);
  next_.resizeLike(from.v);
  motion.accelerate(to.q, to.v, next_);
  to.v = from.v + h / 24 * (9 * next_ + 19 * now_ - 5 * before_ + first_);
  first_.swap(before_);
  before_.swap(now_);
  now_.swap(next_);
}

void Leapfrog::step(HeldMotion& motion, const State& from, double h, State& to) {
  q_ = from.q;
  d_ = h / 2 * from.v;
  motion.move(q_, d_);
  findMiddle(motion, from.v, h);
  to.v = from.v + h * a_;
  to.q = q_;
  d_ = h / 2 * to.v;
  motion.move(to.q, d_);
}

void Leapfrog::findMiddle(HeldMotion& motion, const Eigen::VectorXd& v, double h) {
  constexpr int kMostIterations = 100;
  constexpr double kSmall = 1e-9;
  a_.resizeLike(v);
  next_.resizeLike(v);
  motion.accelerate(q_, v, a_);
  double change = std::numeric_limits<double>::infinity();
  for (int i = 0; i < kMostIterations; ++i) {
    v_ = v + h / 2 * a_;
    motion.accelerate(q_, v_, next_);
    const double before = change;
    change = (next_ - a_).lpNorm<Eigen::Infinity>();
    a_.swap(next_);
    // Changes that are small and no longer shrink are rounding.
    const bool isSmall =
        change <= kSmall * (a_.lpNorm<Eigen::Infinity>() + v.lpNorm<Eigen::Infinity>() / std::abs(h));
    if (change == 0 || (isSmall && change >= before / 2)) return;
  }
  Eigen::Index most = 0;
  (next_ - a_).cwiseAbs().maxCoeff(&most);
  throw Error(
      {.what = fmt::format(
           "joint '{}': its acceleration in the middle of the leapfrog step to {:g} s does not converge",
           jointOfVelocity(motion.model(), most).name, motion.time()),
       .found = fmt::format("a step of {:g} s", h),
       .wanted = "a shorter one"});
}

}  // namespace rex::internal

namespace rex {
namespace {

// `jointOf` says which joint a number belongs to.
template <class JointOf>
void requireAllFinite(const char* what, const Model& model, const VectorArg& numbers,
                      const JointOf& jointOf) {
  for (Eigen::Index i = 0; i < numbers.size(); ++i) {
    if (!std::isfinite(numbers[i]))
      requireFinite(fmt::format("{}: number {}, of joint '{}'", what, i, jointOf(model, i).name), numbers[i]);
  }
}

void requireValid(const StepperOptions& options) {
  requireFinite("gravity", options.gravity_W);
  requireValid(options.jointForces);
  requireNotNegative("noise", options.noise);
}

void requireStep(double h, bool mayBeNegative) {
  if (!mayBeNegative) return requirePositive("time step", h, kSeconds);
  requireFinite("time step", h, kSeconds);
  if (h == 0)
    throw Error({.what = "time step", .found = "0 s", .wanted = "a finite number of seconds other than 0"});
}

void requireState(const Model& model, const State& state) {
  requireSize("joint positions q", state.q.size(), model.nq());
  requireSize("joint velocities v", state.v.size(), model.nv());
  requireAllFinite("joint positions q", model, state.q, jointOfPosition);
  requireAllFinite("joint velocities v", model, state.v, jointOfVelocity);
  requireFinite("time of the state", state.time);
}

}  // namespace

struct Stepper::Parts {
  internal::HeldMotion motion;
  Integrator integrator;
  double noise;
  internal::Euler euler{};
  internal::RungeKutta rungeKutta{};
  internal::Beeman beeman{};
  internal::Leapfrog leapfrog{};
  State next{};

  // Into `next`.
  void advance(const State& state, const VectorArg& u, double h) {
    requireStep(h, integrator == Integrator::kLeapfrog);
    requireState(motion.model(), state);
    requireSize("joint forces u", u.size(), motion.model().nv());
    requireAllFinite("joint forces u", motion.model(), u, jointOfVelocity);
    next.time = state.time + h;
    motion.hold(u, next.time);
    switch (integrator) {
      case Integrator::kEuler:
      case Integrator::kSemiImplicitEuler:
        euler.step(motion, state, h, integrator == Integrator::kSemiImplicitEuler, next);
        break;
      case Integrator::kRungeKutta4:
        rungeKutta.step(motion, state, h, next);
        break;
      case Integrator::kBeeman:
        beeman.step(motion, state, u, h, next);
        break;
      case Integrator::kLeapfrog:
        leapfrog.step(motion, state, h, next);
        break;
    }
    motion.requireBounded(next.q, next.v);
  }
};

Stepper::Stepper(const Model& model, const StepperOptions& options) {
  requireValid(options);
  parts_.reset(new Parts{internal::HeldMotion(model, options.gravity_W, options.jointForces),
                         options.integrator, options.noise});
}
Stepper::Stepper(const Stepper& other) : parts_(std::make_unique<Parts>(*other.parts_)) {}
Stepper& Stepper::operator=(const Stepper& other) {
  if (this != &other) parts_ = std::make_unique<Parts>(*other.parts_);
  return *this;
}
Stepper::Stepper(Stepper&&) noexcept = default;
Stepper& Stepper::operator=(Stepper&&) noexcept = default;
Stepper::~Stepper() = default;

void Stepper::step(State& state, const VectorArg& u, double h) {
  parts_->advance(state, u, h);
  state = parts_->next;
}

void Stepper::step(State& state, const VectorArg& u, double h, Rng& rng) {
  parts_->advance(state, u, h);
  if (parts_->noise > 0) {
    Rng drawn = rng;
    for (double& v : parts_->next.v) v += std::sqrt(std::abs(h)) * parts_->noise * drawn.normal();
    parts_->motion.requireBounded(parts_->next.q, parts_->next.v);
    rng = drawn;
  }
  state = parts_->next;
}

void Stepper::setWrenches(std::vector<Wrench> wrenches) {
  requireValid(parts_->motion.model(), wrenches);
  parts_->motion.push(std::move(wrenches));
  reset();
}

void Stepper::reset() { parts_->beeman.reset(); }

}  // namespace rex
