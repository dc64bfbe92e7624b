#pragma once

#include <string>
#include <vector>

#include "learning/mazes.h"
#include "render/figure.h"

namespace rex {

/// The values of the states of a grid world as colours with numbers; walls are dark. You may change the
/// title and everything else afterwards. Throws Error for the wrong number of values, for values that are
/// not finite, and for a world smaller than 2 x 2 cells.
[[nodiscard]] Figure valueFigure(const GridWorld& world, const Eigen::VectorXd& values);

/// The same with an arrow for each action, whose length shows its probability; terminal states have none.
/// Throws Error as valueFigure, and for a policy of the wrong size.
[[nodiscard]] Figure policyFigure(const GridWorld& world, const Eigen::VectorXd& values,
                                  const Eigen::MatrixXd& policy);

/// The learning curves of several runs, drawn as a line for the mean and a band from the 10th to the 90th
/// percentile.
struct LearningCurves {
  std::string label{};
  std::vector<std::vector<double>> runs{};  ///< of equal length
};
/// Throws Error for a curve without runs, runs of different length, and numbers that are not finite.
[[nodiscard]] Figure learningFigure(const std::vector<LearningCurves>& curves);

}  // namespace rex
