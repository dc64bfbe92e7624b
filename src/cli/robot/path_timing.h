#pragma once

#include "cli/robot/path_search.h"
#include "cli/robot/plan.h"
#include "planning/motion_limits.h"
#include "planning/time_parametrization.h"

namespace rex::cli {

/// The timing of a path, and its limits.
struct PathTiming {
  JointLimits limits{};
  TimingResult result{};

  [[nodiscard]] bool isFound() const { return result.status == TimingStatus::kFound; }
};

/// The fastest motion along the path found, within the limits of the scene and of the options. Throws Error
/// like jointLimits().
[[nodiscard]] PathTiming timingOf(const PathTask& task, const PlanOptions& options, const FoundPath& found);

/// One line about limits that do not come from the scene; empty if all do.
[[nodiscard]] std::string assumptionsOf(const PathTiming& timing, const PlanOptions& options);

/// One line about the limits that were respected.
[[nodiscard]] std::string limitsTextOf(const PathTiming& timing, const PlanOptions& options);

}  // namespace rex::cli
