#pragma once

#include <string>
#include <vector>

#include "cli/robot/path_search.h"
#include "cli/robot/path_timing.h"
#include "cli/robot/plan.h"

namespace rex::cli {

/// A few lines for one search; for several a table of minima, medians and maxima, with lengths and
/// clearances only of the paths found. `timing` is that of the shortest path.
[[nodiscard]] std::string summaryOf(const PathTask& task, const PlanOptions& options, const FoundPaths& found,
                                    const PathTiming& timing);

/// The same as JSON, with the shortest path.
[[nodiscard]] std::string jsonSummaryOf(const PathTask& task, const PlanOptions& options,
                                        const FoundPaths& found, const PathTiming& timing,
                                        const std::vector<std::string>& files);

}  // namespace rex::cli
