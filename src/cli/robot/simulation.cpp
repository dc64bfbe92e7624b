#include "cli/robot/simulation.h"

#include <algorithm>
#include <cmath>

#include "base/interruption.h"
#include "base/rng.h"
#include "control/computed_torque.h"

namespace rex::cli {
namespace {

constexpr double kStiffness = 0.1;  // seconds: the wave length of held joints, which are critically damped

// What moves the state: a stepper, or a world with contacts.
class Plant {
 public:
  Plant(const Model& model, const SimulationPlan& plan) : tau_(plan.tau), rng_(plan.seed) {
    if (!plan.physics) {
      stepper_.emplace(model, plan.stepper);
      return;
    }
    world_.emplace(model, *plan.physics);
    world_->setState(plan.start);
  }

  void step(State& state, const Eigen::VectorXd& u) {
    if (stepper_) return stepper_->step(state, u, tau_, rng_);
    motors_.clear();
    for (const double force : u) motors_.push_back({.target = force});
    world_->setMotors(motors_);
    world_->step(tau_);
    state = world_->state();
  }

 private:
  double tau_;
  Rng rng_;
  std::optional<Stepper> stepper_;
  std::optional<PhysicsWorld> world_;
  std::vector<Motor> motors_;
};

}  // namespace

std::vector<Moment> simulate(const Model& model, const SimulationPlan& plan) {
  Plant plant(model, plan);
  const Eigen::Vector3d& gravity_W = plan.stepper.gravity_W;
  const Reference target = standAt(model, plan.start.q);
  const PdGains gains = pdGains(1, kStiffness, 1);
  Eigen::VectorXd u = Eigen::VectorXd::Zero(model.nv());

  State state = plan.start;
  std::vector<Moment> moments{{state, energy(model, state.q, state.v, gravity_W)}};
  for (int i = 0; i < plan.steps; ++i) {
    throwIfInterrupted();
    if (plan.isHeld) u = computedTorque(model, state, target, gains, gravity_W);
    plant.step(state, u);
    moments.push_back({state, energy(model, state.q, state.v, gravity_W)});
  }
  return moments;
}

Motion motionOf(const std::vector<Moment>& moments, double tau, double rate) {
  const double length = static_cast<double>(moments.size() - 1) * tau;
  const auto count = static_cast<std::size_t>(std::floor(length * rate + 1e-9)) + 1;
  Motion motion;
  for (std::size_t i = 0; i < count; ++i) {
    const double time = static_cast<double>(i) / rate;
    const auto nearest = static_cast<std::size_t>(std::lround(time / tau));
    motion.times.push_back(time);
    motion.postures.push_back(moments[std::min(nearest, moments.size() - 1)].state.q);
  }
  return motion;
}

}  // namespace rex::cli
