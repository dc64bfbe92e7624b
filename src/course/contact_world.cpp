#include <cmath>

#include <fmt/format.h>

#include "base/error.h"
#include "course/contact_world_internal.h"
#include "scene/state.h"

namespace rex::internal {

void ContactWorld::step(const Model& model, const Eigen::Vector3d& gravity_W,
                        const std::vector<Motor>& motors, const Eigen::VectorXd& u, double tau,
                        State& state) {
  requireSize("stepPhysics: joint forces u", u.size(), model.nv());
  if (world_ == nullptr || gravity_W != gravity_W_) {
    world_ = std::make_unique<PhysicsWorld>(model, PhysicsOptions{.gravity_W = gravity_W});
    gravity_W_ = gravity_W;
  }
  motors_ = motors;
  for (Eigen::Index i = 0; i < u.size(); ++i) {
    Motor& motor = motors_[static_cast<std::size_t>(i)];
    if (motor.kind == Motor::Kind::kForce)
      motor.target = u[i];
    else if (u[i] != 0)
      throw Error({.what = fmt::format("stepPhysics: force of joint '{}'", jointOfVelocity(model, i).name),
                   .found = fmt::format("{:g}", u[i]),
                   .wanted = "zero, because it has a motor"});
  }
  world_->setMotors(motors_);
  // Contacts of the last step help the next one, so only a jump makes the world start anew.
  const State last = world_->state();
  if (last.q != state.q || last.v != state.v || last.time != state.time) world_->setState(state);
  world_->step(tau);
  state = world_->state();
  contacts_ = world_->contacts();
  innerStep_ = tau / std::ceil(tau / 1e-3 * (1 - 1e-9));  // as PhysicsWorld::step() cuts it
}

}  // namespace rex::internal
