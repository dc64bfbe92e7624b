#pragma once
// Trees of motions that controls produce, for systems such as cars.
#include <functional>
#include <vector>

#include "planning/car_curves.h"
#include "planning/path_problem.h"
#include "systems/car.h"

namespace rex {

class Rng;
struct MotionModel;

/// A control that is held for some time.
struct HeldControl {
  Eigen::VectorXd u{};
  double seconds = 0;
};

/// A system that moves by its controls, such as a car.
struct ControlSystem {
  Space space;                       ///< the space of its states
  Eigen::VectorXd lower{}, upper{};  ///< bounds of the controls
  /// The state after `seconds` from x with constant u.
  std::function<Eigen::VectorXd(const VectorArg& x, const VectorArg& u, double seconds)> motion{};
  /// The distance between two states, which need not be symmetric; empty: the metric of the space.
  std::function<double(const VectorArg& from, const VectorArg& to)> distance{};
  /// The controls, one after the other, that lead from one state to another if nothing is in the way, or
  /// none if it finds no path: the local planner of slide 4:58. Empty: shooting, which takes the best of some
  /// random controls.
  std::function<std::vector<HeldControl>(const VectorArg& from, const VectorArg& to)> steer{};
};

/// The system that moves as a model says, without its noise; steered by shooting. Throws Error for a space of
/// another size than the model's state, bounds of another size than its controls, and a model without f.
[[nodiscard]] ControlSystem controlSystem(const MotionModel& model, const Space& space,
                                          const VectorArg& lower, const VectorArg& upper);

struct ControlTreeOptions {
  double shortest = 0.1, longest = 0.5;  ///< tau: seconds of a step towards a target, drawn between these
  double checkEvery = 0.05;              ///< most seconds between states that are checked
  int trials = 10;                       ///< controls that shooting tries for a target
  bool towardsTargets = true;            ///< false: any node, any control (slide 4:52)
  double goalBias = 0.05;
  double tolerance = 0.1;  ///< the goal counts as reached within this distance of the system
  int maxSamples = 20000;
};

/// A path with its controls.
struct ControlPath {
  PathResult found{};                   ///< path: the states between controls
  std::vector<HeldControl> controls{};  ///< one for each piece of the path
  std::vector<HeldControl> edges{};     ///< that lead to each node of the tree from its parent; root: none
};

/// Grows a tree of states by applying controls: towards random targets (slide 4:58; LaValle and Kuffner,
/// Randomized kinodynamic planning, 2001), or with random controls from random nodes (slide 4:52). If the
/// system can steer, each new node also tries to reach the goal. Throws like growRrt, for a system without a
/// motion, bounds of different sizes, a motion or distance that is not finite, and steering beyond the
/// bounds or by a negative time, naming the state.
[[nodiscard]] ControlPath growControlTree(const ControlSystem& system, const PathProblem& problem,
                                          const ControlTreeOptions& options, Rng& rng);

/// The controls (speed, steering angle) that drive a car along a curve at `speed` m/s, backward where the
/// curve goes backward. Throws Error for a curve that is tighter than the car can turn, and a speed that is
/// not positive.
[[nodiscard]] std::vector<HeldControl> controlsAlong(const Curve& curve, const Car& car, double speed = 1);

/// A car that drives at up to `speed` m/s, for trees of controls: steered along Dubins curves, and thus
/// forward only, or along those of Reeds and Shepp. Their lengths are the distances. Slide 4:61. `space`
/// holds (x, y, heading). Throws Error for a space of another size, and like controlsAlong.
[[nodiscard]] ControlSystem dubinsCar(const Space& space, const Car& car, double speed = 1);
[[nodiscard]] ControlSystem reedsSheppCar(const Space& space, const Car& car, double speed = 1);

}  // namespace rex
