#pragma once

#include <string>
#include <vector>

#include "render/figure.h"

namespace rex::cli {

/// How one search went: after evaluations[i], which ascend, the best value was values[i]. Afterwards it
/// stays.
struct LearningCurve {
  std::vector<double> evaluations{};
  std::vector<double> values{};
};

/// The median of several curves with the band from the worst to the best, and each thinly, over a logarithmic
/// axis; values of 0 and below are drawn at its foot, 1e-20. The dashed line is the target, if above that.
/// The curves must not be empty.
[[nodiscard]] Figure figureOf(const std::vector<LearningCurve>& curves, double target,
                              const std::string& title);

}  // namespace rex::cli
