#pragma once

#include "base/vector_arg.h"
#include "scene/model.h"

namespace rex::cli {

/// How far the two points of each pin are apart at q, metres.
[[nodiscard]] Eigen::VectorXd pinGaps(const Model& model, const VectorArg& q);

}  // namespace rex::cli
