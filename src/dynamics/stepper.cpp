#include "dynamics/stepper.h"

#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "base/error.h"
#include "base/require.h"
#include "base/rng.h"
#include "dynamics/integrators_internal.h"
#include "scene/coordinates.h"

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
