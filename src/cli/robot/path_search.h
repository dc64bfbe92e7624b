#pragma once
// Searches a path for `rex plan`, shortens it, and measures its clearance.
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "collision/motion_clearance.h"
#include "planning/path_problem.h"
#include "planning/path_spline.h"
#include "scene/model.h"

namespace rex::cli {

/// Tolerance of the bounds of a clearance, metres, unless that takes too long: see pathClearance().
inline constexpr double kClearanceTolerance = 1e-4;

/// How far the straight segments of a path may deviate from its curve, in each coordinate.
inline constexpr double kChordTolerance = 5e-5;

enum class Planner {
  kRrt,
  kRrtConnect,
  kRrtStar,
  kPrm,
  kPrmStar,
  kLazyPrm,
  kHybridAStar,      ///< of cars: plan_car.cpp
  kOptimize,         ///< of whole motions, by augmented Lagrangians: plan_motion.cpp
  kOptimizePenalty,  ///< the same with squared penalties, and with barriers
  kOptimizeBarrier
};

/// What `--planner NAME` means.
[[nodiscard]] const std::vector<std::pair<std::string, Planner>>& plannerNames();
[[nodiscard]] const std::string& toString(Planner planner);
/// Whether it draws samples: one of the first six.
[[nodiscard]] bool drawsSamples(Planner planner);
/// Whether the planner grows trees step by step; the others that draw samples make a roadmap.
[[nodiscard]] bool growsTrees(Planner planner);

/// A robot, its shapes that may collide, and the planning problem.
struct PathTask {
  Model model;
  ContactModel contacts;
  PathProblem problem;
};

/// Throws UsageError with the nearest shapes, the margin and, if there is one, a smaller one that would do if
/// the posture that `option` gives is not valid.
void requireClear(const char* option, const VectorArg& q, const Model& model, const ContactModel& contacts,
                  const AllValid& allValid, double margin);
/// The same for both ends of a path.
void requireClearEnds(const PathTask& task, double margin);

/// How `rex plan` searches.
struct PathSearch {
  Planner planner = Planner::kRrtConnect;
  double step = 0.3;      ///< of trees, in the metric of the space
  int samples = 100'000;  ///< maximum number of random configurations; for a roadmap, of candidate nodes
  bool smooth = true;     ///< shortcuts, then a spline that cuts corners
  double timeLimit = 10;  ///< seconds of CPU time for one search, without smoothing
};

/// Configurations, one per column, and their connections.
struct PathGraph {
  Eigen::MatrixXd nodes{};
  std::vector<std::pair<int, int>> edges{};
};

/// What a search with one seed found.
struct FoundPath {
  std::uint64_t seed = 0;
  /// Postures along the curve, one per column, with unwrapped angles; empty: none found. The straight
  /// segments between them are within kChordTolerance of the curve.
  Eigen::MatrixXd path{};
  PathCurve curve{};  ///< the path as a curve to follow
  double length = 0;  ///< of the path, and below of the planner's path before smoothing
  double plannedLength = 0;
  ClearanceBounds clearance{};  ///< along the whole path
  int samples = 0;
  int nodes = 0;
  bool isTimeUp = false;              ///< whether the time limit ended the search
  long checks = 0;                    ///< configurations that were checked, including those for smoothing
  double planningTime = 0;            ///< seconds of CPU time
  double smoothingTime = 0;           ///< the same, for smoothing
  std::vector<PathGraph> explored{};  ///< trees (the first is that of the start), or a roadmap

  [[nodiscard]] bool isFound() const { return path.cols() > 0; }
};

/// Searches once, and shows on a terminal how far it is. The same seed gives the same result, except for the
/// times, and for what a search finds that its time limit ended. Throws Error like the planner, and
/// Interrupted.
[[nodiscard]] FoundPath searchPath(const PathTask& task, const PathSearch& search, std::uint64_t seed);

/// The results of searches with several seeds. Only the best one keeps what it explored.
struct FoundPaths {
  std::vector<FoundPath> all{};  ///< at least one
  std::size_t best = 0;          ///< the one with the shortest path; if none was found, the first

  [[nodiscard]] const FoundPath& shortest() const { return all[best]; }
  /// The number of searches that found a path.
  [[nodiscard]] int successes() const;
};

/// Searches with `count` seeds, at least one, from `firstSeed` on. Throws like searchPath().
[[nodiscard]] FoundPaths searchPaths(const PathTask& task, const PathSearch& search, std::uint64_t firstSeed,
                                     int count);

}  // namespace rex::cli
