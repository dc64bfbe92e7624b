#pragma once

#include <vector>

#include "classroom/class_statistics.h"
#include "render/figure.h"

namespace rex::cli {

/// The points of every student in each exercise, in percent of the possible ones, over the number of the
/// exercise ("01-kinematics" is 1; one without a number gets the next after the largest); equal ones side by
/// side, and a line at each median. Faults of the grader are left out. Throws Error if nothing is left.
[[nodiscard]] Figure pointsFigure(const std::vector<grading::StudentResult>& results);

}  // namespace rex::cli
