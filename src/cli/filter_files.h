#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "cli/commands.h"
#include "cli/filter_run.h"
#include "cli/filter_statistics.h"

namespace rex::cli {

/// Which steps of a run the film shows: at most 150, evenly, the last included.
[[nodiscard]] std::vector<int> filmedSteps(int steps);

/// Makes the folder, and takes away the film and frames that an earlier run left there. Throws UsageError
/// naming -o for one that cannot be made or written to.
void makeFilterFolder(const std::filesystem::path& folder);

/// Every step of a run as a table: true and estimated pose, covariance, dead reckoning, NEES and NIS.
[[nodiscard]] std::string csvOf(const FilterRun& run, double tau);

/// Writes into options.out the table, figures of the errors, of NEES over all runs and of the map, and the
/// film of `views`, which belong to filmedSteps(). Gives back the files, as a user would type them. Throws
/// Error as those who write them.
[[nodiscard]] std::vector<std::string> writeFilterFiles(const FilterOptions& options, const FilterRun& run,
                                                        const FilterStatistics& statistics,
                                                        std::vector<CarView> views);

}  // namespace rex::cli
