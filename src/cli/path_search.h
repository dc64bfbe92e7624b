#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "collision/contact_model.h"
#include "planning/path_problem.h"

namespace rex::cli {

enum class Planner { kRrt, kRrtConnect, kRrtStar, kPrm, kPrmStar, kLazyPrm };

/// What `--planner NAME` means. Throws UsageError naming the choices and the nearest.
[[nodiscard]] Planner plannerOf(const std::string& name);
/// Whether it grows trees, by steps; otherwise it makes a roadmap.
[[nodiscard]] bool growsTrees(Planner planner);

/// How `rex plan` searches.
struct PathSearch {
  Planner planner = Planner::kRrtConnect;
  double step = 0.3;      ///< of trees, in the metric of the space
  int samples = 100'000;  ///< random configurations, at most; of a roadmap, all that may become nodes
  bool smooth = true;     ///< shortcuts, then rounded corners
};

/// Configurations, one per column, and which of them are joined.
struct PathGraph {
  Eigen::MatrixXd nodes{};
  std::vector<std::pair<int, int>> edges{};
};

/// What a search with one seed found.
struct FoundPath {
  std::uint64_t seed = 0;
  Eigen::MatrixXd path{};  ///< one posture per column, angles that run on across whole turns; empty: none found
  double length = 0;       ///< of the path, and of what the planner gave before it was smoothed
  double plannedLength = 0;
  double clearance = 0;  ///< metres, all along the path: see pathClearance()
  int samples = 0;
  int nodes = 0;
  long checks = 0;           ///< configurations that were looked at, those for smoothing included
  double planningTime = 0;   ///< seconds of CPU time
  double smoothingTime = 0;  ///< the same, of what comes after
  std::string message{};
  std::vector<PathGraph> explored{};  ///< trees (of two, the first is that of the start), or a roadmap

  [[nodiscard]] bool isFound() const { return path.cols() > 0; }
};

/// Searches once. The same seed finds the same, but for the times. Throws Error as the planner, and
/// Interrupted.
[[nodiscard]] FoundPath searchPath(const Model& model, const ContactModel& contacts,
                                   const PathProblem& problem, const PathSearch& search, std::uint64_t seed);

}  // namespace rex::cli
