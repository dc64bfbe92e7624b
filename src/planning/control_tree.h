#pragma once

#include <functional>

#include "planning/path_problem.h"

namespace rex {

class Rng;

/// A system that goes where its controls drive it, such as a car.
struct ControlSystem {
  Space space;                       ///< of its states
  Eigen::VectorXd lower{}, upper{};  ///< bounds of the controls
  /// The state after driving from x with constant u for so many seconds.
  std::function<Eigen::VectorXd(const VectorArg& x, const VectorArg& u, double seconds)> motion{};
  /// How far a state is from another; empty: the metric of the space. It need not be symmetric.
  std::function<double(const VectorArg& from, const VectorArg& to)> distance{};
};

struct ControlTreeOptions {
  double duration = 0.5;       ///< tau, seconds with the same controls
  int checks = 10;             ///< states that are checked in that time
  int trials = 10;             ///< controls that are tried on the way to a target; the best is taken
  bool towardsTargets = true;  ///< false: any node, any control (slide 4:52)
  double goalBias = 0.05;
  double tolerance = 0.1;  ///< the goal is reached this near, in the distance of the system
  int maxSamples = 20000;
};

/// A path with what drives it.
struct ControlPath {
  PathResult found{};          ///< path: the states between controls
  Eigen::MatrixXd controls{};  ///< one column for each piece of the path
  double duration = 0;         ///< seconds of each piece
};

/// A tree of states that controls lead to: towards random targets (slide 4:58; LaValle and Kuffner,
/// Randomized kinodynamic planning, 2001), or by random controls from random nodes (slide 4:52). Throws as
/// growRrt, for a system without motion, bounds of different sizes, and a motion or distance that is not
/// finite, naming the state.
[[nodiscard]] ControlPath growControlTree(const ControlSystem& system, const PathProblem& problem,
                                          const ControlTreeOptions& options, Rng& rng);

}  // namespace rex
