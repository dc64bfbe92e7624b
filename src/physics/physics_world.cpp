#include "physics/physics_world.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/error.h"
#include "base/require.h"
#include "collision/motion_clearance.h"
#include "physics/bullet_shape_internal.h"
#include "physics/bullet_world_internal.h"
#include "physics/contact_free_motion_internal.h"
#include "scene/state.h"

namespace rex::internal {

/// Follows which shapes touch, and notes what begins and ends.
class ContactEvents {
 public:
  /// Forgets what touched.
  void reset();
  /// Forgets the events, before a step.
  void clear() { events_.clear(); }
  /// What touches in the next inner step, in any order and as often as it likes, is put into touching() by
  /// the caller; update() then compares it with the last one.
  std::vector<std::pair<int, int>>& touching() { return now_; }
  void update(double time);
  [[nodiscard]] const std::vector<ContactEvent>& events() const { return events_; }

 private:
  void add(ContactEvent::Kind kind, const std::vector<std::pair<int, int>>& from,
           const std::vector<std::pair<int, int>>& except, double time);

  std::vector<std::pair<int, int>> now_, before_;
  std::vector<ContactEvent> events_;
};

void ContactEvents::reset() {
  before_.clear();
  events_.clear();
}

void ContactEvents::update(double time) {
  std::sort(now_.begin(), now_.end());
  now_.erase(std::unique(now_.begin(), now_.end()), now_.end());
  add(ContactEvent::Kind::kEnd, before_, now_, time);
  add(ContactEvent::Kind::kBegin, now_, before_, time);
  std::swap(now_, before_);
}

void ContactEvents::add(ContactEvent::Kind kind, const std::vector<std::pair<int, int>>& from,
                        const std::vector<std::pair<int, int>>& except, double time) {
  for (const auto& pair : from) {
    if (!std::binary_search(except.begin(), except.end(), pair))
      events_.push_back({kind, pair.first, pair.second, time});
  }
}

}  // namespace rex::internal

namespace rex {
namespace {

// Bullet turns free bodies by at most 45 degrees per step, and its contacts need steps of about a
// millisecond.
constexpr double kInnerStep = 1e-3;
// Seconds. Bullet skips steps that are much shorter. Longer ones are mistakes, such as milliseconds taken
// for seconds, and take minutes.
constexpr double kShortestStep = 1e-9, kLongestStep = 1000;
// Nothing that is simulated well moves faster than this, in rad/s or m/s.
constexpr double kRunawaySpeed = 1e6;
// What stays farther away than this, in metres, beside twice its motion in a step, cannot touch in that step.
constexpr double kNear = 5e-3;

void requireQuaternions(const Model& model, const Eigen::VectorXd& q) {
  forEachQuaternion(model, [&](int iq, int iv) {
    if (!q.segment<4>(iq).isZero(0)) return;
    throw Error({.what = fmt::format("physics: quaternion of joint '{}'", jointOfVelocity(model, iv).name),
                 .found = "zero",
                 .wanted = "four numbers that are not all zero"});
  });
}

void requireOptions(const PhysicsOptions& options) {
  requireFinite("physics: gravity", options.gravity_W);
  requireNotNegative("physics: friction", options.friction);
  requireCount("physics: iterations", options.iterations, 1);
  if (!(options.restitution >= 0 && options.restitution <= 1))
    throw Error({.what = "physics: restitution",
                 .found = fmt::format("{:g}", options.restitution),
                 .wanted = "a number from 0 to 1"});
}

void requireMotor(const Model& model, int iv, const Motor& motor) {
  const Joint& joint = jointOfVelocity(model, iv);
  const std::string what = fmt::format("physics: motor of joint '{}'", joint.name);
  requireFinite(what + ": target", motor.target);
  if (motor.kind == Motor::Kind::kForce) return;
  requireNotNegativeOrInfinite(what + ": maxForce", motor.maxForce);
  if (joint.nq == joint.nv) return;
  throw Error({.what = what,
               .found = fmt::format("a target for a {} joint", toString(joint.type)),
               .wanted = "forces: only plain coordinates can be held"});
}

}  // namespace

struct PhysicsWorld::Parts {
  Model model;
  std::vector<Motor> motors;
  double time = 0;
  internal::BulletWorld world;
  internal::ContactEvents events{};
  ClearanceWatch watch;
  internal::ContactFreeMotion untouched;
  // While nothing touches and only forces act, the state is here, and Bullet's is older.
  bool isUntouched = false;
  State now, start;
  bool startsUntouched = false;  // whether the last step began so, at `start`

  Parts(const Model& m, const PhysicsOptions& options)
      : model(m),
        motors(static_cast<std::size_t>(m.nv())),
        world(model, options),
        watch(model),
        untouched(model, options),
        now(initialState(model)),
        start(now) {}

  void reset(const State& state) {
    isUntouched = false;
    watch.reset();
    untouched.reset();
    world.reset(state);
    events.reset();
  }

  void read(State& state) const {
    if (isUntouched) {
      state.q = now.q;
      state.v = now.v;
    } else {
      for (const auto& tree : world.trees()) tree->read(state);
    }
  }

  // Tells Bullet the state.
  void handOver() {
    if (!isUntouched) return;
    isUntouched = false;
    world.reset(now);
  }

  void innerStep(double h, double at) {
    bool isApart = false;
    if (watch.isAble()) {
      if (!isUntouched) read(now);
      isApart = watch.isApart(model, now.q, now.v, 2 * h, kNear);
    }
    if (isApart && untouched.step(now, h)) {
      isUntouched = true;
      events.touching().clear();
    } else {
      handOver();
      for (const auto& tree : world.trees()) tree->drive(motors, h);
      world.step(h, isApart);
      world.collectTouching(events.touching());
      moveUntouched(h);
    }
    events.update(at);
  }

  // Where shapes are near each other but nothing has touched, our own motion counts: Bullet's has an error of
  // first order in the step, by which an arm that swings fast gains up to a hundredth of its energy.
  void moveUntouched(double h) {
    if (!watch.isAble() || !events.touching().empty() || !untouched.step(now, h)) return;
    for (const auto& tree : world.trees()) tree->place(now);
  }

  void remember() {
    startsUntouched = isUntouched;
    if (isUntouched) {
      start = now;
    } else {
      for (const auto& tree : world.trees()) tree->remember();
    }
  }

  void undo() {
    if (startsUntouched) return reset(start);
    for (const auto& tree : world.trees()) tree->undo();
    isUntouched = false;
    read(now);
    reset(State(now));
  }

  // The index in v of a velocity that has become too large, or -1.
  [[nodiscard]] int runaway() const {
    if (isUntouched) {
      for (Eigen::Index i = 0; i < now.v.size(); ++i)
        if (!(std::abs(now.v[i]) < kRunawaySpeed)) return static_cast<int>(i);
      return -1;
    }
    for (const auto& tree : world.trees()) {
      const int iv = tree->runaway(kRunawaySpeed);
      if (iv >= 0) return iv;
    }
    return -1;
  }
};

PhysicsWorld::PhysicsWorld(const Model& model, const PhysicsOptions& options) {
  requireOptions(options);
  parts_ = std::make_unique<Parts>(model, options);
  setState(initialState(model));
}
PhysicsWorld::PhysicsWorld(PhysicsWorld&&) noexcept = default;
PhysicsWorld& PhysicsWorld::operator=(PhysicsWorld&&) noexcept = default;
PhysicsWorld::~PhysicsWorld() = default;

State PhysicsWorld::state() const {
  State state = initialState(parts_->model);
  parts_->read(state);
  state.time = parts_->time;
  return state;
}

void PhysicsWorld::setState(const State& state) {
  const Model& model = parts_->model;
  requireSize("physics: joint positions q", state.q.size(), model.nq());
  requireSize("physics: joint velocities v", state.v.size(), model.nv());
  requireFinite("physics: joint positions q", state.q);
  requireFinite("physics: joint velocities v", state.v);
  requireQuaternions(model, state.q);
  requireFinite("physics: time", state.time);
  parts_->reset(state);
  parts_->time = state.time;
}

void PhysicsWorld::setMotors(std::span<const Motor> motors) {
  requireSize("physics: motors", static_cast<long>(motors.size()), parts_->model.nv());
  for (std::size_t i = 0; i < motors.size(); ++i) requireMotor(parts_->model, static_cast<int>(i), motors[i]);
  parts_->motors.assign(motors.begin(), motors.end());
  parts_->untouched.setMotors(motors);
}

void PhysicsWorld::step(double h) {
  if (!(h >= kShortestStep && h <= kLongestStep)) {
    throw Error({.what = "physics: time step",
                 .found = fmt::format("{:g}", h),
                 .wanted = fmt::format("{:g} to {:g} seconds", kShortestStep, kLongestStep)});
  }
  const double count = std::ceil(h / kInnerStep * (1 - 1e-9));
  parts_->events.clear();
  parts_->remember();
  for (double i = 0; i < count; ++i) {
    parts_->innerStep(h / count, parts_->time + i * h / count);
    const int iv = parts_->runaway();
    if (iv < 0) continue;
    parts_->undo();
    throw Error(
        {.what = fmt::format("physics: joint '{}' at {:.6g} s", jointOfVelocity(parts_->model, iv).name,
                             parts_->time + (i + 1) * h / count),
         .found = "a motion that grows without bounds",
         .wanted = "shorter steps or smaller forces"});
  }
  parts_->time += h;
}

std::vector<PhysicsContact> PhysicsWorld::contacts() const {
  if (parts_->isUntouched) return {};
  return parts_->world.contacts();
}

std::vector<PhysicsContact> PhysicsWorld::overlaps(double depth) {
  const State state = this->state();
  parts_->reset(state);
  return parts_->world.overlaps(state, depth);
}

std::vector<ContactEvent> PhysicsWorld::events() const { return parts_->events.events(); }

std::optional<RayHit> PhysicsWorld::rayCast(const Eigen::Vector3d& from_W,
                                            const Eigen::Vector3d& to_W) const {
  requireFinite("physics: start of the ray", from_W);
  requireFinite("physics: end of the ray", to_W);
  parts_->handOver();
  if (parts_->watch.isAble()) parts_->world.updateBounds();
  return parts_->world.rayCast(from_W, to_W);
}

}  // namespace rex
