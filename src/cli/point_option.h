#pragma once

#include <string>

#include <Eigen/Core>

namespace rex::cli {

/// The three numbers in the text of `option`; `form` describes them in messages. Throws UsageError for
/// another count, or naming the word that is not a number.
[[nodiscard]] Eigen::Vector3d parsePoint(const std::string& text, const std::string& option,
                                         const std::string& form = "x,y,z");

}  // namespace rex::cli
