#include "base/error.h"
#include "course/contact_world_internal.h"

namespace rex::internal {

void ContactWorld::step(const Model& model, const Eigen::Vector3d& gravity_W, const Eigen::VectorXd& u,
                        double tau, State& state) {
  requireSize("stepPhysics: joint forces u", u.size(), model.nv());
  if (world_ == nullptr || gravity_W != gravity_W_) {
    world_ = std::make_unique<PhysicsWorld>(model, PhysicsOptions{.gravity_W = gravity_W});
    gravity_W_ = gravity_W;
  }
  motors_.assign(static_cast<std::size_t>(model.nv()), Motor{});
  for (Eigen::Index i = 0; i < u.size(); ++i) motors_[static_cast<std::size_t>(i)].target = u[i];
  world_->setMotors(motors_);
  // Contacts of the last step help the next one, so that only a jump makes the world start anew.
  const State last = world_->state();
  if (last.q != state.q || last.v != state.v || last.time != state.time) world_->setState(state);
  world_->step(tau);
  state = world_->state();
}

}  // namespace rex::internal
