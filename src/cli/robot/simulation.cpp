#include "cli/robot/simulation.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <span>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "base/error.h"
#include "base/interruption.h"
#include "base/rng.h"
#include "cli/numbers.h"
#include "cli/robot/posture_option.h"
#include "cli/terminal.h"
#include "collision/collision_pairs.h"
#include "dynamics/equations_of_motion.h"
#include "kinematics/forward_kinematics.h"
#include "scene/state.h"

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

Eigen::VectorXd loopClosureErrors(const Model& model, const VectorArg& q) {
  const BodyPoses poses = forwardKinematics(model, q);
  Eigen::VectorXd gaps(static_cast<Eigen::Index>(model.pins().size()));
  for (Eigen::Index i = 0; i < gaps.size(); ++i) {
    const Pin& pin = model.pins()[static_cast<std::size_t>(i)];
    gaps[i] = (poses[pin.a] * pin.p_AP - poses[pin.b] * pin.p_BQ).norm();
  }
  return gaps;
}

std::vector<BodyOverlap> startOverlaps(const Model& model, const PhysicsOptions& options,
                                       const State& start) {
  PhysicsWorld world(model, options);
  world.setState(start);
  const auto nameOf = [&](int shape) {
    const BodyId body = model.shapes()[static_cast<std::size_t>(shape)].body;
    return body == kWorld ? shapeLabel(model, shape) : model[body].name;
  };
  std::map<std::pair<std::string, std::string>, double> depths;
  for (const PhysicsContact& contact : world.overlaps()) {
    double& depth = depths[{nameOf(contact.shapeA), nameOf(contact.shapeB)}];
    depth = std::max(depth, -contact.distance);
  }
  std::vector<BodyOverlap> overlaps;
  for (const auto& [pair, depth] : depths) overlaps.push_back({pair.first, pair.second, depth});
  std::ranges::stable_sort(overlaps, std::greater(), &BodyOverlap::depth);
  return overlaps;
}

std::string toString(const std::vector<BodyOverlap>& overlaps) {
  constexpr std::size_t kMost = 12;
  std::string text = fmt::format("{} pair{}: ", overlaps.size(), overlaps.size() == 1 ? "" : "s");
  for (std::size_t i = 0; i < std::min(overlaps.size(), kMost); ++i)
    text += fmt::format("{}'{}' and '{}' by {:.3g} m", i == 0 ? "" : ", ", escapeForTerminal(overlaps[i].a),
                        escapeForTerminal(overlaps[i].b), overlaps[i].depth);
  if (overlaps.size() > kMost) text += fmt::format(" and {} more", overlaps.size() - kMost);
  return text;
}

namespace {

constexpr const char* kHeadWanted = "'time', then names of joints, separated by commas";

class TorqueReader {
 public:
  TorqueReader(const Model& model, const NumberTable& numbers)
      : model_(model), names_(printableVelocityNames(model)), numbers_(numbers) {}

  TorqueTable read() {
    table_.nv = model_.nv();
    if (numbers_.namesLine == 0) refuse({}, "torques", "no line of column names", kHeadWanted);
    readNames();
    if (numbers_.rows.empty()) refuse({}, "torques", "no row of numbers", "a time and torques");
    for (const NumberTable::Row& row : numbers_.rows) addRow(row);
    return std::move(table_);
  }

 private:
  [[noreturn]] void refuse(std::pair<int, int> lineAndColumn, const std::string& what,
                           const std::string& found, const std::string& wanted,
                           std::vector<std::string> nearest = {}) const {
    throw UsageError({.what = what,
                      .where = {numbers_.file, lineAndColumn.first, lineAndColumn.second},
                      .found = found,
                      .wanted = wanted,
                      .nearest = std::move(nearest)});
  }

  void readNames() {
    const NumberTable::Name& first = numbers_.names.front();
    const auto at = [&](const NumberTable::Name& name) { return std::pair(numbers_.namesLine, name.column); };
    if (first.text != "time")
      refuse(at(first), "torques: first column", "'" + escapeForTerminal(first.text) + "'", kHeadWanted);
    if (numbers_.names.size() == 1) refuse(at(first), "torques", "no joint after 'time'", kHeadWanted);
    for (const NumberTable::Name& name : std::span(numbers_.names).subspan(1)) {
      const int place = placeOf(name.text, at(name));
      if (std::ranges::find(table_.columns, place) != table_.columns.end())
        refuse(at(name), "torques", "'" + escapeForTerminal(name.text) + "' twice", "a column per joint");
      table_.columns.push_back(place);
    }
  }

  int placeOf(const std::string& name, std::pair<int, int> at) const {
    for (const Joint& joint : model_.joints()) {
      if (joint.name != name) continue;
      const std::string what = "torques: joint '" + escapeForTerminal(name) + "'";
      if (joint.mimics)
        refuse(at, what, "a joint that mimics another",
               "'" + escapeForTerminal(jointOfVelocity(model_, joint.vIndex).name) +
                   "', whose torque moves both");
      if (joint.type == JointType::kFree) refuse(at, what, "a free joint", "joints with a motor");
      if (joint.nv > 1)
        refuse(at, what, fmt::format("{} coordinates", joint.nv),
               fmt::format("'{} [0]' or another", escapeForTerminal(name)));
    }
    const auto found = std::ranges::find(names_, name);
    if (found != names_.end() && !name.empty()) {
      const int place = static_cast<int>(found - names_.begin());
      if (jointOfVelocity(model_, place).type != JointType::kFree) return place;
    }
    refuse(at, "torques", "'" + escapeForTerminal(name) + "'",
           "a joint of " + escapeForTerminal(model_.name()) + " with a motor", nearestNames(name, driven()));
  }

  std::vector<std::string> driven() const {
    std::vector<std::string> names;
    for (int i = 0; i < model_.nv(); ++i)
      if (jointOfVelocity(model_, i).type != JointType::kFree)
        names.push_back(names_[static_cast<std::size_t>(i)]);
    return names;
  }

  void addRow(const NumberTable::Row& row) {
    const std::pair at(row.line, row.column);
    if (row.values.size() != numbers_.names.size())
      refuse(at, "torques", fmt::format("{} number{}", row.values.size(), row.values.size() == 1 ? "" : "s"),
             fmt::format("{} as in line {}", numbers_.names.size(), numbers_.namesLine));
    const double time = row.values[0];
    if (time < 0) refuse(at, "torques: time", fmt::format("{:g}", time), "0 or later");
    if (!table_.times.empty() && time <= table_.times.back())
      refuse(at, "torques: time", fmt::format("{:g} after {:g}", time, table_.times.back()),
             "times that increase");
    table_.times.push_back(time);
    table_.rows.emplace_back(row.values.begin() + 1, row.values.end());
  }

  const Model& model_;
  std::vector<std::string> names_;
  const NumberTable& numbers_;
  TorqueTable table_{};
};

}  // namespace

Eigen::VectorXd TorqueTable::at(double time) const {
  constexpr double kRounding = 1e-9;  // seconds: times are sums of steps, which are not exact
  Eigen::VectorXd u = Eigen::VectorXd::Zero(nv);
  const auto next = std::upper_bound(times.begin(), times.end(), time + kRounding);
  if (next == times.begin()) return u;
  const std::vector<double>& row = rows[static_cast<std::size_t>(next - times.begin()) - 1];
  for (std::size_t i = 0; i < columns.size(); ++i) u[columns[i]] = row[i];
  return u;
}

TorqueTable readTorques(const Model& model, const std::filesystem::path& file) {
  const NumberTable numbers = readNumberTable(file, "torques");
  return TorqueReader(model, numbers).read();
}

}  // namespace rex::cli
