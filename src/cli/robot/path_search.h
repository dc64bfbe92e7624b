#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "collision/motion_clearance.h"
#include "planning/path_curve.h"
#include "planning/path_problem.h"
#include "scene/model.h"

namespace rex::cli {

/// Bounds of a clearance are as near together, metres, unless that takes too long: see pathClearance().
inline constexpr double kClearanceTolerance = 1e-4;

/// How far, in each number of a posture, straight ways between postures of a path are from its curve.
inline constexpr double kChordTolerance = 5e-5;

enum class Planner { kRrt, kRrtConnect, kRrtStar, kPrm, kPrmStar, kLazyPrm };

/// What `--planner NAME` means. Throws UsageError naming the choices and the nearest.
[[nodiscard]] Planner plannerOf(const std::string& name);
/// Whether it grows trees, by steps; otherwise it makes a roadmap.
[[nodiscard]] bool growsTrees(Planner planner);

/// A robot, which of its shapes may collide, and from where to where it shall go.
struct PathTask {
  Model model;
  ContactModel contacts;
  PathProblem problem;
};

/// How `rex plan` searches.
struct PathSearch {
  Planner planner = Planner::kRrtConnect;
  double step = 0.3;      ///< of trees, in the metric of the space
  int samples = 100'000;  ///< random configurations, at most; of a roadmap, all that may become nodes
  bool smooth = true;     ///< shortcuts, then a spline that cuts corners
};

/// Configurations, one per column, and which of them are joined.
struct PathGraph {
  Eigen::MatrixXd nodes{};
  std::vector<std::pair<int, int>> edges{};
};

/// What a search with one seed found.
struct FoundPath {
  std::uint64_t seed = 0;
  /// Postures along the curve, one per column, with angles that run on across whole turns; empty: none found.
  /// The straight ways between them are no farther than kChordTolerance from the curve.
  Eigen::MatrixXd path{};
  PathCurve curve{};  ///< what was found, to be followed
  double length = 0;  ///< of the path, and of what the planner gave before it was smoothed
  double plannedLength = 0;
  ClearanceBounds clearance{};  ///< all along the path
  int samples = 0;
  int nodes = 0;
  long checks = 0;                    ///< configurations that were looked at, those for smoothing included
  double planningTime = 0;            ///< seconds of CPU time
  double smoothingTime = 0;           ///< the same, of what comes after
  std::vector<PathGraph> explored{};  ///< trees (of two, the first is that of the start), or a roadmap

  [[nodiscard]] bool isFound() const { return path.cols() > 0; }
};

/// Searches once. The same seed finds the same, but for the times. Throws Error as the planner, and
/// Interrupted.
[[nodiscard]] FoundPath searchPath(const PathTask& task, const PathSearch& search, std::uint64_t seed);

/// What searches with several seeds found. Only the best one keeps what it explored.
struct FoundPaths {
  std::vector<FoundPath> all{};  ///< at least one
  std::size_t best = 0;          ///< has the shortest path; where none was found, the first

  [[nodiscard]] const FoundPath& shortest() const { return all[best]; }
  /// How many have a path.
  [[nodiscard]] int successes() const;
};

/// Searches with `count` seeds, at least one, from `firstSeed` on. Throws as searchPath().
[[nodiscard]] FoundPaths searchPaths(const PathTask& task, const PathSearch& search, std::uint64_t firstSeed,
                                     int count);

}  // namespace rex::cli
