#pragma once

#include "planning/path_problem.h"

namespace rex {

class Rng;

struct RrtOptions {
  double stepSize = 0.1;    ///< alpha: how far a tree grows in one step, in the metric of the space
  double goalBias = 0.05;   ///< beta: probability that the goal is the target
  int maxSamples = 100000;  ///< the budget
};

/// Grows a tree from the start towards random targets and, now and then, the goal: slides 4:39 and 4:40,
/// with steps that do not overshoot and edges that are checked along their whole length (erratum 8). LaValle
/// 1998. A goal within a step of the start is connected before any target is drawn. Throws like
/// requireSound, and for options out of range.
[[nodiscard]] PathResult growRrt(const PathProblem& problem, const RrtOptions& options, Rng& rng);

/// Grows two trees, from start and goal: one takes a step towards a random target, the other grows towards
/// the new node as far as possible. Slide 4:42; Kuffner and LaValle, RRT-Connect, 2000. Throws like
/// growRrt.
[[nodiscard]] PathResult connectRrts(const PathProblem& problem, const RrtOptions& options, Rng& rng);

struct RrtStarOptions {
  RrtOptions growth{};
  /// Nodes within gamma (log n / n)^exponent, and within a step, are considered as parents and rewired; 0: as
  /// large as optimality requires in a space of this size (Karaman and Frazzoli 2011, theorem 38).
  double gamma = 0;
  /// 0: theirs, 1/d in d dimensions. 1/(d+1) is what Solovey et al. 2020 prove to be enough, who found a gap
  /// in that theorem, for a gamma of their own, which is not the default; it considers more nodes.
  double exponent = 0;
  /// Once there is a path, draw only targets through which a shorter path may lead (Gammell, Srinivasa and
  /// Barfoot, Informed RRT*, 2014); in spaces of lines the search radius shrinks accordingly.
  bool isInformed = true;
};

/// A tree whose nodes choose the best parent nearby and are rewired as it grows, so that its path converges
/// to the shortest. Slide 4:45 with erratum 9. It spends the whole budget. Throws like
/// growRrt.
[[nodiscard]] PathResult growRrtStar(const PathProblem& problem, const RrtStarOptions& options, Rng& rng);

}  // namespace rex
