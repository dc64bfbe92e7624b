#include "cli/robot/simulation.h"

#include <algorithm>
#include <cmath>

#include "base/interruption.h"
#include "base/rng.h"
#include "dynamics/mass_matrix.h"
#include "scene/coordinates.h"

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

// Compares the energy of a motion with what it can have been given: kinetic energy at the start, the fall of
// its masses, the work of torques, springs or motors that are away from the posture they hold, and contacts,
// pins and limits that are wrong at the start and come right at 1 m/s. The bounds are generous, because a
// solver that makes energy soon makes many times as much.
class EnergyBudget {
 public:
  EnergyBudget(const Model& model, const SimulationPlan& plan, const Moment& start)
      : model_(model),
        target_(plan.start.q),
        zero_(start.energy.potential),
        kinetic_(start.energy.kinetic),
        lowest_(start.energy.total()) {
    masses_ = massMatrix(model, target_).diagonal();
    if (plan.physics) parting_ = 0.5 * model.mass();
    noise_ = 0.5 * plan.stepper.noise * plan.stepper.noise * plan.tau * masses_.sum();
    holdRate_ = fastestReturn(plan.hold);
    rounding_ = 1e-9 * (1 + std::abs(start.energy.total()));
  }

  /// After a step that gave this much work. Returns the gain before that step if it is too much: explicit
  /// steps change velocities first, and masses fall in the next one.
  std::optional<EnergyGain> add(const Moment& moment, double work) {
    work_ += work + noise_;
    supplied_ += std::abs(work) + 3 * noise_;
    fall_ = std::max(fall_, zero_ - moment.energy.potential);
    if (holdRate_ > 0) {
      const Eigen::VectorXd away = difference(model_, target_, moment.state.q);
      const double held =
          0.5 * static_cast<double>(model_.nv()) * holdRate_ * holdRate_ * drivenSquares(away);
      held_ = std::max(held_, held);
    }
    const EnergyGain before = gain_;
    const double balance = moment.energy.total() - work_;
    lowest_ = std::min(lowest_, balance);
    gain_ = {.time = moment.state.time,
             .gained = balance - lowest_,
             .given = kinetic_ + fall_ + supplied_ + held_ + parting_};
    if (before.gained > 2 * gain_.given + rounding_)
      return EnergyGain{before.time, before.gained, gain_.given};
    return std::nullopt;
  }

 private:
  // How fast a joint that is held returns, per unit of its distance; 1/s.
  static double fastestReturn(Hold hold) {
    constexpr double kMotorReturn = 20;  // see Motor
    if (hold == Hold::kNone) return 0;
    return hold == Hold::kMotor ? kMotorReturn : 1 / kHoldWave;
  }

  [[nodiscard]] double drivenSquares(const Eigen::VectorXd& away) const {
    double sum = 0;
    for (const Joint& joint : model_.joints()) {
      if (joint.type == JointType::kFree || joint.mimics) continue;
      for (int i = joint.vIndex; i < joint.vIndex + joint.nv; ++i) sum += masses_[i] * away[i] * away[i];
    }
    return sum;
  }

  const Model& model_;
  Eigen::VectorXd target_, masses_;
  double zero_, kinetic_, lowest_;
  double parting_ = 0, noise_ = 0, holdRate_ = 0, rounding_ = 0;
  double work_ = 0, supplied_ = 0, fall_ = 0, held_ = 0;
  EnergyGain gain_{};
};

}  // namespace

std::optional<EnergyGain> simulate(const Model& model, const SimulationPlan& plan,
                                   const std::function<void(const Moment&)>& visit) {
  Plant plant(model, plan);
  const Eigen::Vector3d& gravity_W = plan.stepper.gravity_W;
  const Holder holder(model, plan.hold, plan.start.q, gravity_W, plan.tau);
  DynamicsWorkspace workspace;

  State state = plan.start;
  const auto momentNow = [&] { return Moment{state, energy(model, state.q, state.v, gravity_W, workspace)}; };
  Moment moment = momentNow();
  visit(moment);
  EnergyBudget budget(model, plan, moment);
  for (int i = 0; i < plan.steps; ++i) {
    throwIfInterrupted();
    Eigen::VectorXd u = holder.forces(state), torques = Eigen::VectorXd::Zero(model.nv());
    if (plan.torques) torques = plan.torques->at(state.time - plan.start.time);
    u += torques;
    plant.step(state, u, holder);
    const double work = 0.5 * plan.tau * torques.dot(moment.state.v + state.v);
    moment = momentNow();
    visit(moment);
    if (const std::optional<EnergyGain> gain = budget.add(moment, work)) return gain;
  }
  return std::nullopt;
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
