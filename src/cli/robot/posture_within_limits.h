#pragma once

#include <string>

#include "cli/robot/posture_option.h"

namespace rex::cli {

/// parsePostureOf() with normalised quaternions. Also throws UsageError for a zero quaternion, and for a
/// joint outside its limits, saying by how much.
[[nodiscard]] Eigen::VectorXd postureWithinLimits(const Model& model, const std::string& option,
                                                  const std::string& text);

}  // namespace rex::cli
