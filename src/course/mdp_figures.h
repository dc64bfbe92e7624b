#pragma once

#include <string>
#include <vector>

#include "learning/mazes.h"
#include "render/figure.h"

namespace rex {

/// Values of the states of a grid world as colours with numbers; walls are dark. Title and all else may be
/// changed afterwards. Throws Error for another number of values, for some that are not finite, and for a
/// world of less than 2 x 2 cells.
[[nodiscard]] Figure valueFigure(const GridWorld& world, const Eigen::VectorXd& values);

/// The same with an arrow for each action, as long as it is likely; none in terminal states. Throws Error as
/// valueFigure, and for a policy of another size.
[[nodiscard]] Figure policyFigure(const GridWorld& world, const Eigen::VectorXd& values,
                                  const Eigen::MatrixXd& policy);

/// Learning curves of several runs each: the mean as a line, in a band from the 10th to the 90th percentile.
struct LearningCurves {
  std::string label{};
  std::vector<std::vector<double>> runs{};  ///< of equal length
};
/// Throws Error for a curve without runs, runs of different length, and numbers that are not finite.
[[nodiscard]] Figure learningFigure(const std::vector<LearningCurves>& curves);

}  // namespace rex
