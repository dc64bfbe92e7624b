#pragma once

#include <string>

#include "cli/robot/posture_option.h"

namespace rex::cli {

/// parsePostureOf() with quaternions brought to length one. Throws UsageError besides for a quaternion of
/// zeros, and for a joint outside its limits, by how much.
[[nodiscard]] Eigen::VectorXd postureWithinLimits(const Model& model, const std::string& option,
                                                  const std::string& text);

}  // namespace rex::cli
