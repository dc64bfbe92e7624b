#pragma once

#include <string_view>

#include <Eigen/Core>

namespace rex {

/// Throws Error "what: found nan, wanted a finite number" unless it is one.
void requireFinite(std::string_view what, double number);

/// The same for all numbers of a vector, saying which: "what: number 3: found nan, wanted a finite number".
void requireFinite(std::string_view what, const Eigen::Ref<const Eigen::VectorXd>& numbers);

}  // namespace rex
