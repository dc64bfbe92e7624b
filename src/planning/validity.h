#pragma once

#include <functional>

#include "scene/model.h"

namespace rex {

/// Whether all configurations are valid, one per column of Q: free of collision, say. It may stop at the
/// first that is not, and be called with any number of columns.
using AllValid = std::function<bool(const MatrixArg& Q)>;

/// From a function of one configuration.
[[nodiscard]] AllValid eachColumn(std::function<bool(const VectorArg& q)> isValid);

/// Valid where a clearance is positive. What is not a number throws Error naming the configuration.
[[nodiscard]] AllValid whereClear(std::function<double(const VectorArg& q)> clearance);

}  // namespace rex
