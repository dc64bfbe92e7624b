#include "dynamics/stepper.h"

#include <cmath>

#include <fmt/format.h>

#include "base/error.h"
#include "base/rng.h"
#include "dynamics/forward_dynamics.h"

namespace rex {

struct Stepper::Parts {
  Model model;
  StepperOptions options;
};

Stepper::Stepper(const Model& model, const StepperOptions& options)
    : parts_(std::make_unique<Parts>(Parts{model, options})) {}
Stepper::Stepper(Stepper&&) noexcept = default;
Stepper& Stepper::operator=(Stepper&&) noexcept = default;
Stepper::~Stepper() = default;

void Stepper::step(State& state, const VectorArg& u, double h) {
  if (!(h > 0) || !std::isfinite(h)) {
    throw Error(
        {.what = "time step", .found = fmt::format("{:g}", h), .wanted = "a positive number of seconds"});
  }
  const Model& model = parts_->model;
  requireSize("joint forces u", u.size(), model.nv());
  const auto acceleration = [&](const Eigen::VectorXd& q, const Eigen::VectorXd& v) {
    return forwardDynamics(model, q, v, u, parts_->options.gravity_W);
  };
  const Eigen::VectorXd &q = state.q, &v1 = state.v;
  const Eigen::VectorXd a1 = acceleration(q, v1), v2 = v1 + h / 2 * a1;
  const Eigen::VectorXd a2 = acceleration(integrate(model, q, h / 2 * v1), v2), v3 = v1 + h / 2 * a2;
  const Eigen::VectorXd a3 = acceleration(integrate(model, q, h / 2 * v2), v3), v4 = v1 + h * a3;
  const Eigen::VectorXd a4 = acceleration(integrate(model, q, h * v3), v4);
  State next{integrate(model, q, h / 6 * (v1 + 2 * v2 + 2 * v3 + v4)),
             v1 + h / 6 * (a1 + 2 * a2 + 2 * a3 + a4), state.time + h};
  state = std::move(next);
}

void Stepper::step(State& state, const VectorArg& u, double h, Rng& rng) {
  step(state, u, h);
  state.v += std::sqrt(h) * parts_->options.noise * rng.normalVector(static_cast<int>(state.v.size()));
}

void Stepper::reset() {}

}  // namespace rex
