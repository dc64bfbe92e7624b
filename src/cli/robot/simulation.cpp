#include "cli/robot/simulation.h"

#include <algorithm>
#include <cmath>

#include "base/interruption.h"
#include "base/rng.h"

namespace rex::cli {
namespace {

// Advances the state by a stepper, or in a world with contacts.
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

  void step(State& state, const Eigen::VectorXd& u, const Holder& holder) {
    if (stepper_) return stepper_->step(state, u, tau_, rng_);
    world_->setMotors(holder.motors(u));
    world_->step(tau_);
    state = world_->state();
  }

 private:
  double tau_;
  Rng rng_;
  std::optional<Stepper> stepper_;
  std::optional<PhysicsWorld> world_;
};

}  // namespace

void simulate(const Model& model, const SimulationPlan& plan,
              const std::function<void(const Moment&)>& visit) {
  Plant plant(model, plan);
  const Eigen::Vector3d& gravity_W = plan.stepper.gravity_W;
  const Holder holder(model, plan.hold, plan.start.q, gravity_W);
  DynamicsWorkspace workspace;

  State state = plan.start;
  const auto show = [&] { visit({state, energy(model, state.q, state.v, gravity_W, workspace)}); };
  show();
  for (int i = 0; i < plan.steps; ++i) {
    throwIfInterrupted();
    Eigen::VectorXd u = holder.forces(state);
    if (plan.torques) u += plan.torques->at(state.time - plan.start.time);
    plant.step(state, u, holder);
    show();
  }
}

FilmPostures::FilmPostures(double tau, int steps, double rate)
    : tau_(tau),
      rate_(rate),
      steps_(steps),
      count_(static_cast<std::size_t>(std::floor(steps * tau * rate + 1e-9)) + 1) {}

long FilmPostures::nearestStep() const {
  const double time = static_cast<double>(motion_.times.size()) / rate_;
  return std::min(std::lround(time / tau_), static_cast<long>(steps_));
}

void FilmPostures::add(const Eigen::VectorXd& q) {
  while (motion_.times.size() < count_ && nearestStep() == step_) {
    motion_.times.push_back(static_cast<double>(motion_.times.size()) / rate_);
    motion_.postures.push_back(q);
  }
  ++step_;
}

}  // namespace rex::cli
