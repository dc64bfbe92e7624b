#include "cli/simulation.h"

#include <algorithm>
#include <cmath>

#include "base/interruption.h"
#include "base/rng.h"
#include "control/computed_torque.h"

namespace rex::cli {
namespace {

constexpr double kStiffness = 0.1;  // seconds: the wave length of held joints, which are critically damped

}  // namespace

std::vector<Moment> simulate(const Model& model, const SimulationPlan& plan) {
  Stepper stepper(model, plan.stepper);
  Rng rng(plan.seed);
  const Eigen::Vector3d& gravity_W = plan.stepper.gravity_W;
  const Reference target = standAt(model, plan.start.q);
  const PdGains gains = pdGains(1, kStiffness, 1);
  Eigen::VectorXd u = Eigen::VectorXd::Zero(model.nv());

  State state = plan.start;
  std::vector<Moment> moments{{state, energy(model, state.q, state.v, gravity_W)}};
  for (int i = 0; i < plan.steps; ++i) {
    throwIfInterrupted();
    if (plan.isHeld) u = computedTorque(model, state, target, gains, gravity_W);
    stepper.step(state, u, plan.tau, rng);
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
