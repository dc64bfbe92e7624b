#pragma once

#include "estimation/scan_matching.h"

namespace rex::internal {

/// Throws Error for points or a guess that are not finite, and options that are not positive.
void requireScans(const Eigen::Matrix2Xd& reference, const Eigen::Matrix2Xd& moving,
                  const Eigen::Vector3d& guess, const ScanMatchOptions& options);

}  // namespace rex::internal
