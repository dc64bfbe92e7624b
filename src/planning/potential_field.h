#pragma once

#include <vector>

#include "planning/grid_map.h"

namespace rex {

struct PotentialFieldOptions {
  double attraction = 1;  ///< k of k |p - goal|^2 / 2
  double repulsion = 1;   ///< eta of eta (1 / d - 1 / reach)^2 / 2, d metres from the nearest obstacle
  double reach = 1;       ///< metres: obstacles farther away have no effect
};

/// A potential that attracts to a goal and repels from obstacles: slides 4:13 to 4:16; Khatib 1986.
/// Everything outside the map is free.
class PotentialField {
 public:
  /// Throws Error for a goal that is not free, and options that are not positive and finite.
  PotentialField(const GridMap& map, const Eigen::Vector2d& goal, const PotentialFieldOptions& options = {});

  const Eigen::Vector2d& goal() const { return goal_; }
  /// Infinite inside obstacles.
  [[nodiscard]] double potential(const Eigen::Vector2d& p) const;
  /// -F, the derivative of the potential. It jumps where another obstacle becomes the nearest.
  [[nodiscard]] Eigen::Vector2d gradient(const Eigen::Vector2d& p) const;

 private:
  struct Obstacle {
    double distance;
    Eigen::Vector2d direction;  // away from it
  };
  Obstacle nearestObstacle(const Eigen::Vector2d& p) const;

  GridMap map_;
  Eigen::Vector2d goal_;
  PotentialFieldOptions options_;
};

enum class DescentStatus {
  kReached,
  kLocalMinimum,  ///< no direction leads down, and it is not the goal: slide 4:16
  kBudgetSpent
};

struct Descent {
  DescentStatus status = DescentStatus::kBudgetSpent;
  std::vector<Eigen::Vector2d> points{};  ///< the path, beginning with the start
};

/// Gradient descent with steps of at most `stepSize` metres, shorter where the potential would not
/// decrease, until it is within a step of the goal. Throws Error for a start inside an obstacle, and for a
/// step size that is not positive.
[[nodiscard]] Descent descend(const PotentialField& field, const Eigen::Vector2d& start, double stepSize,
                              int maxSteps = 10000);

}  // namespace rex
