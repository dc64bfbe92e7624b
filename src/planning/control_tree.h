#pragma once

#include <functional>

#include "planning/path_problem.h"

namespace rex {

class Rng;

/// A system that moves by its controls, such as a car.
struct ControlSystem {
  Space space;                       ///< the space of its states
  Eigen::VectorXd lower{}, upper{};  ///< bounds of the controls
  /// The state after `seconds` from x with constant u.
  std::function<Eigen::VectorXd(const VectorArg& x, const VectorArg& u, double seconds)> motion{};
  /// The distance between two states, which need not be symmetric; empty: the metric of the space.
  std::function<double(const VectorArg& from, const VectorArg& to)> distance{};
};

struct ControlTreeOptions {
  double duration = 0.5;       ///< tau: seconds for which a control is held
  int checks = 10;             ///< states that are checked during that time
  int trials = 10;             ///< controls that are tried for a target; the best one is taken
  bool towardsTargets = true;  ///< false: any node, any control (slide 4:52)
  double goalBias = 0.05;
  double tolerance = 0.1;  ///< the goal counts as reached within this distance of the system
  int maxSamples = 20000;
};

/// A path with its controls.
struct ControlPath {
  PathResult found{};          ///< path: the states between controls
  Eigen::MatrixXd controls{};  ///< one column for each piece of the path
  double duration = 0;         ///< seconds of each piece
};

/// Grows a tree of states by applying controls: towards random targets (slide 4:58; LaValle and Kuffner,
/// Randomized kinodynamic planning, 2001), or with random controls from random nodes (slide 4:52). Throws
/// like growRrt, for a system without a motion, bounds of different sizes, and a motion or distance that is
/// not finite, naming the state.
[[nodiscard]] ControlPath growControlTree(const ControlSystem& system, const PathProblem& problem,
                                          const ControlTreeOptions& options, Rng& rng);

}  // namespace rex
