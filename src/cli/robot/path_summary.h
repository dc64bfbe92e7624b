#pragma once

#include <string>
#include <vector>

#include "cli/robot/path_search.h"
#include "cli/robot/path_timing.h"
#include "cli/robot/plan.h"

namespace rex::cli {

/// One search in some lines; several in a table of minima, medians and maxima, of lengths and clearances
/// among the paths that were found. `timing` is that of the shortest path.
[[nodiscard]] std::string summaryOf(const PathTask& task, const PlanOptions& options, const FoundPaths& found,
                                    const PathTiming& timing);

/// The same for programs, with the shortest path.
[[nodiscard]] std::string jsonSummaryOf(const PathTask& task, const PlanOptions& options,
                                        const FoundPaths& found, const PathTiming& timing,
                                        const std::vector<std::string>& files);

}  // namespace rex::cli
