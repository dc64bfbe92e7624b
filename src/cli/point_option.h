#pragma once

#include <string>

#include <Eigen/Core>

namespace rex::cli {

/// The three numbers that `option` gives, called by `form`. Throws UsageError for another count, or naming
/// the word that cannot be read as a number.
[[nodiscard]] Eigen::Vector3d parsePoint(const std::string& text, const std::string& option,
                                         const std::string& form = "x,y,z");

}  // namespace rex::cli
