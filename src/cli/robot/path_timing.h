#pragma once

#include "cli/robot/path_search.h"
#include "cli/robot/plan.h"
#include "planning/motion_limits.h"
#include "planning/time_parametrization.h"

namespace rex::cli {

/// How fast a path is followed, and within which limits.
struct PathTiming {
  JointLimits limits{};
  TimingResult result{};

  [[nodiscard]] bool isFound() const { return result.status == TimingStatus::kFound; }
};

/// The fastest motion along what was found, within the limits of the scene and of the options. Throws Error
/// as jointLimits().
[[nodiscard]] PathTiming timingOf(const PathTask& task, const PlanOptions& options, const FoundPath& found);

/// Says which limits are not those of the scene, on one line; empty if all are.
[[nodiscard]] std::string assumptionsOf(const PathTiming& timing, const PlanOptions& options);

/// Which limits were kept to, on one line.
[[nodiscard]] std::string limitsTextOf(const PathTiming& timing, const PlanOptions& options);

}  // namespace rex::cli
