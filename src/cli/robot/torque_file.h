#pragma once

#include <filesystem>
#include <vector>

#include "scene/model.h"

namespace rex::cli {

/// Joint forces over time.
struct TorqueTable {
  int nv = 0;
  std::vector<int> columns{};               ///< the indices into v that have one
  std::vector<double> times{};              ///< seconds, increasing
  std::vector<std::vector<double>> rows{};  ///< N m or N, one entry per column

  /// The forces (nv) at that time: those of the latest row, zero before the first.
  [[nodiscard]] Eigen::VectorXd at(double time) const;
};

/// Reads a table of numbers (cli/numbers.h): a heading "time,shoulder,elbow" with names from velocityNames(),
/// then one row per time. Throws UsageError with file:line:column like readNumberTable(), for a joint that is
/// unknown (with the nearest names), a mimic, free or repeated, a wrong count, and times that are negative or
/// do not increase.
[[nodiscard]] TorqueTable readTorques(const Model& model, const std::filesystem::path& file);

}  // namespace rex::cli
