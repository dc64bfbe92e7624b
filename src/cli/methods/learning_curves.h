#pragma once

#include <string>
#include <vector>

#include "render/figure.h"

namespace rex::cli {

/// The course of one search: after evaluations[i] (ascending) the best value was values[i]. It is constant
/// after the last one.
struct LearningCurve {
  std::vector<double> evaluations{};
  std::vector<double> values{};
};

/// The median of several curves with a band from the worst to the best, and each curve as a thin line, on a
/// logarithmic axis. Values of 0 and below are drawn at its lower end, 1e-20. A dashed line shows the
/// target if it is above that. The curves must not be empty.
[[nodiscard]] Figure figureOf(const std::vector<LearningCurve>& curves, double target,
                              const std::string& title);

}  // namespace rex::cli
