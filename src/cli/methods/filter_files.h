#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "cli/methods/filter.h"
#include "cli/methods/filter_run.h"
#include "cli/methods/filter_statistics.h"

namespace rex::cli {

/// The views of a filter during a run, and of the last step.
struct ShownRun {
  std::vector<CarView> frames{};
  CarView end{};
};

/// Whether the film shows step 1, 2, ... of a run: at most 150, evenly spaced.
[[nodiscard]] bool isFilmed(int step, int steps);

/// Every step of a run as a table: true and estimated pose, covariance, dead reckoning, NEES and NIS.
[[nodiscard]] std::string csvOf(const FilterRun& run);

/// Writes into options.out the table, figures of the errors, of NEES over all runs and of the map, and the
/// film. Returns the files, as a user would type them. Throws Error like the functions that write them.
[[nodiscard]] std::vector<std::string> writeFilterFiles(const FilterOptions& options, const FilterRun& run,
                                                        const FilterStatistics& statistics,
                                                        ShownRun shownRun);

}  // namespace rex::cli
