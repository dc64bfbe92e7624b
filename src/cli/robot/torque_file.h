#pragma once

#include <filesystem>
#include <vector>

#include "scene/model.h"

namespace rex::cli {

/// Forces of joints over time.
struct TorqueTable {
  int nv = 0;
  std::vector<int> columns{};               ///< the numbers of v that have one
  std::vector<double> times{};              ///< seconds, increasing
  std::vector<std::vector<double>> rows{};  ///< N m or N, a number for each column

  /// The forces (nv) at that time: those of the latest row, and none before the first.
  [[nodiscard]] Eigen::VectorXd at(double time) const;
};

/// Reads a table with commas between its fields: a line "time,shoulder,elbow" that names joints, as of
/// velocityNames(), then a line per time. Lines that begin with '#' are skipped. Throws UsageError with
/// file:line:column for a missing file, an unknown joint (with the nearest names), one that mimics another,
/// is free or stands twice, a wrong count, what is not a finite number, and times that are negative or do not
/// increase.
[[nodiscard]] TorqueTable readTorques(const Model& model, const std::filesystem::path& file);

}  // namespace rex::cli
