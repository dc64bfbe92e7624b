#pragma once

#include "planning/path_problem.h"

namespace rex {

class Rng;

struct RrtOptions {
  double stepSize = 0.1;    ///< alpha: how far a tree grows at once, in the metric of the space
  double goalBias = 0.05;   ///< beta: how often the goal is the target, 0 to 1
  int maxSamples = 100000;  ///< the budget
};

/// A tree from the start that grows towards random targets and, now and then, the goal: slides 4:39 and 4:40,
/// with steps that do not overshoot and edges that are checked all along (errata). LaValle 1998. A goal
/// within a step of the start is joined before any target is drawn. Throws as requireSound, and for options
/// out of range.
[[nodiscard]] PathResult growRrt(const PathProblem& problem, const RrtOptions& options, Rng& rng);

/// Two trees, from start and goal: one takes a step towards a random target, the other runs towards the new
/// node as far as it comes. Slide 4:42; Kuffner and LaValle, RRT-Connect, 2000. Throws as growRrt.
[[nodiscard]] PathResult connectRrts(const PathProblem& problem, const RrtOptions& options, Rng& rng);

struct RrtStarOptions {
  RrtOptions growth{};
  /// Nodes within gamma (log n / n)^(1/d), and within a step, are considered as parents and rewired; 0: as
  /// large as optimality asks for in a space of this size (Karaman and Frazzoli 2011, theorem 38).
  double gamma = 0;
  /// Once there is a path, draw only targets between start and goal through which a shorter one may lead
  /// (Gammell, Srinivasa and Barfoot, Informed RRT*, 2014), and in spaces of lines look only as far as they
  /// ask for.
  bool isInformed = true;
};

/// A tree whose nodes keep the best parent around, rewired as it grows, so that its path to the goal becomes
/// the shortest. Slide 4:45 with the correction of the errata. It spends the whole budget. Throws as growRrt.
[[nodiscard]] PathResult growRrtStar(const PathProblem& problem, const RrtStarOptions& options, Rng& rng);

}  // namespace rex
