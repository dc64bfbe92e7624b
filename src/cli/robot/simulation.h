#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "base/require.h"
#include "cli/robot/posture_option.h"
#include "dynamics/energy.h"
#include "dynamics/stepper.h"
#include "live/hold.h"
#include "physics/physics_world.h"
#include "scene/model.h"

namespace rex::cli {

/// Joint forces over time.
struct TorqueTable {
  int nv = 0;
  std::vector<int> columns{};               ///< the indices into v that have one
  std::vector<double> times{};              ///< seconds, increasing
  std::vector<std::vector<double>> rows{};  ///< N m or N, one entry per column

  /// The forces (nv) at that time: those of the latest row, zero before the first.
  [[nodiscard]] Eigen::VectorXd at(double time) const;
};

/// Reads a table of numbers (cli/numbers.h): a heading "time,shoulder,elbow" with names from velocityNames(),
/// then one row per time. Throws UsageError with file:line:column like readNumberTable(), for a joint that is
/// unknown (with the nearest names), a mimic, free or repeated, a wrong count, and times that are negative or
/// do not increase.
[[nodiscard]] TorqueTable readTorques(const Model& model, const std::filesystem::path& file);

/// The settings of `rex simulate`.
struct SimulationPlan {
  State start{};
  StepperOptions stepper{};
  std::optional<PhysicsOptions> physics{};  ///< if set, PhysicsWorld is used instead, without noise
  double tau = 1e-3;                        ///< seconds per step
  int steps = 0;
  Hold hold = Hold::kNone;               ///< for the initial posture; kMotor needs `physics`
  std::optional<TorqueTable> torques{};  ///< added to the holding forces; no effect with kMotor
  std::uint64_t seed = 0;                ///< of the noise
};

/// A state and its energy.
struct Moment {
  State state;
  Energy energy;
};

/// Energy that nothing has given: the solver made it.
struct EnergyGain {
  double time = 0;    ///< seconds
  double gained = 0;  ///< joules, since the total energy was lowest
  double given =
      0;  ///< joules: the most that the start, gravity, torques and whatever holds joints can have given
};

/// Calls visit(moment) at the start and after each step. Stops as soon as the energy has grown by more than
/// twice what it can have been given, and returns that gain. Throws Error like Stepper or PhysicsWorld, what
/// `visit` throws, and Interrupted.
std::optional<EnergyGain> simulate(const Model& model, const SimulationPlan& plan,
                                   const std::function<void(const Moment&)>& visit);

/// Selects the postures of a film during a simulation: `rate` per second, each the one nearest in time.
class FilmPostures {
 public:
  /// For `steps` steps of tau seconds.
  FilmPostures(double tau, int steps, double rate);
  /// Call it with the initial posture, and then after each step.
  void add(const Eigen::VectorXd& q);
  /// The postures selected so far.
  [[nodiscard]] const Motion& motion() const { return motion_; }

 private:
  [[nodiscard]] long nearestStep() const;

  double tau_, rate_;
  int steps_;
  std::size_t count_;
  long step_ = 0;
  Motion motion_{};
};

/// How far the two points of each pin are apart at q, metres.
[[nodiscard]] Eigen::VectorXd loopClosureErrors(const Model& model, const VectorArg& q);

/// Two overlapping bodies, or shapes of the world.
struct BodyOverlap {
  std::string a, b;
  double depth = 0;  ///< metres, at its deepest
};

/// The pairs that may collide and overlap by more than 0.1 mm in that state, deepest first. Throws Error
/// like PhysicsWorld.
[[nodiscard]] std::vector<BodyOverlap> startOverlaps(const Model& model, const PhysicsOptions& options,
                                                     const State& start);

/// "2 pairs: 'a' and 'b' by 0.012 m, ...", for at most the deepest dozen.
[[nodiscard]] std::string toString(const std::vector<BodyOverlap>& overlaps);

}  // namespace rex::cli
