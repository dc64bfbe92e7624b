#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "cli/methods/filter_run.h"
#include "estimation/consistency.h"

namespace rex::cli {

/// Root mean square errors of one run, metres and radians, and its mean NEES.
struct RunErrors {
  std::uint64_t seed = 0;
  double position = 0, heading = 0;
  std::optional<double> nees{};  ///< empty: all covariances are singular, or nearly so
};

/// How well a filter did in runs that differ in the seed only. Of a consistent filter, squared errors in the
/// metric of their covariances (NEES) are chi-square of 3 degrees, those of innovations (NIS) of as many as
/// they have numbers. Bands are of 95 %.
struct FilterStatistics {
  std::vector<RunErrors> runs{};
  double position = 0, heading = 0, deadReckoning = 0;  ///< root mean squares over runs and steps
  double map = 0;                  ///< the same of the landmarks that were found in the end, metres
  std::optional<double> nees{};    ///< mean over runs and steps, where the covariance is not singular
  std::vector<double> stepNees{};  ///< of each step, the mean over runs
  ConsistencyBand stepBand{};      ///< for such a mean
  double insideBand = 0;           ///< share of the steps
  double nis = 0;                  ///< for one number of an innovation
  double innovations = 0;          ///< how many numbers; without any, there is no NIS
  ConsistencyBand nisBand{};
  int foundLandmarks = 0;
  int singular = 0;  ///< steps with covariances that are, or nearly so
};

/// Adds up runs one by one, so that not all must be kept.
class FilterStatisticsBuilder {
 public:
  /// Expects as many steps as in the run before.
  void add(const FilterRun& run);
  /// Expects a run.
  [[nodiscard]] FilterStatistics statistics() const;

 private:
  FilterStatistics sums_;
  double nees_ = 0;
  std::vector<int> regular_;  // runs whose covariance is not singular, for each step
};

}  // namespace rex::cli
