#pragma once

#include <vector>

#include "classroom/class_statistics.h"
#include "render/figure.h"

namespace rex::cli {

/// The points of every student in each exercise, in percent of the maximum, over the exercise's number
/// ("01-kinematics" is 1; one without a number gets the next after the largest). Equal points are drawn
/// side by side, with a line at each median. Grader errors are left out. Throws Error if nothing is left.
[[nodiscard]] Figure pointsFigure(const std::vector<grading::StudentResult>& results);

/// A row of fields for each exercise, one for each part, with its name and the mean of its points in percent;
/// the fewer points, the darker. Throws Error if there is nothing to draw.
[[nodiscard]] Figure partsFigure(const std::vector<grading::ExerciseStatistics>& all);

}  // namespace rex::cli
