#pragma once

#include "render/figure.h"

namespace rex::internal {

/// Throws Error unless something of the data lies within the ranges of the figure, lines between points
/// included. Expects finite data, positive on logarithmic axes.
void requireDataInView(const Figure& figure, const std::string& name);

}  // namespace rex::internal
