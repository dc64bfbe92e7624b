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
  std::optional<double> nees{};  ///< empty: all covariances are (nearly) singular
};

/// The performance of a filter in runs that differ only in the seed. For a consistent filter, squared
/// errors in the metric of their covariances (NEES) are chi-square with 3 degrees of freedom, and those of
/// innovations (NIS) with as many as they have entries. Bands are 95 %.
struct FilterStatistics {
  std::vector<RunErrors> runs{};
  double position = 0, heading = 0, deadReckoning = 0;  ///< root mean squares over runs and steps
  double map = 0;                ///< the same for the landmarks found at the end, or from the nearest, metres
  std::optional<double> nees{};  ///< mean over runs and steps with regular covariance
  std::vector<double> stepNees{};  ///< for each step, the mean over runs
  ConsistencyBand stepBand{};      ///< for these means
  double insideBand = 0;           ///< fraction of the steps
  double nis = 0;                  ///< per entry of an innovation
  double innovations = 0;          ///< number of entries; if zero, there is no NIS
  ConsistencyBand nisBand{};
  int foundLandmarks = 0;
  int singular = 0;  ///< steps with (nearly) singular covariance
};

/// Accumulates runs one by one, so that not all must be kept.
class FilterStatisticsBuilder {
 public:
  /// Each run must have as many steps as the one before.
  void add(const FilterRun& run);
  /// There must be at least one run.
  [[nodiscard]] FilterStatistics statistics() const;

 private:
  FilterStatistics sums_;
  double nees_ = 0;
  std::vector<int> regular_;  // runs whose covariance is not singular, for each step
};

}  // namespace rex::cli
