#pragma once

#include <functional>

#include "scene/model.h"

namespace rex {

/// Whether all configurations, one per column of Q, are valid, for example free of collision. It may stop
/// at the first invalid one, and is called with any number of columns.
using AllValid = std::function<bool(const MatrixArg& Q)>;

/// Makes one from a function of a single configuration.
[[nodiscard]] AllValid eachColumn(std::function<bool(const VectorArg& q)> isValid);

/// Valid if a clearance is positive. If it is not a number, Error names the configuration.
[[nodiscard]] AllValid whereClear(std::function<double(const VectorArg& q)> clearance);

}  // namespace rex
