#pragma once

#include <vector>

#include "classroom/class_statistics.h"
#include "render/figure.h"

namespace rex::cli {

/// The points of every student in each exercise, in percent of the maximum, over the exercise's number
/// ("01-kinematics" is 1; one without a number gets the next after the largest). Equal points are drawn
/// side by side, with a line at each median. Grader errors are left out. Throws Error if nothing is left.
[[nodiscard]] Figure pointsFigure(const std::vector<grading::StudentResult>& results);

}  // namespace rex::cli
