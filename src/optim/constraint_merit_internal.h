#pragma once

#include "optim/constrained_solver.h"

namespace rex::internal {

/// The function without constraints that a method minimises in place of a problem with some, for one value of
/// its parameters: of g, h and cost at a point, and with its derivatives as weights of theirs.
struct ConstraintMerit {
  bool hasBarrier = false;
  double costWeight = 1;
  double penalty = 1, barrier = 1;
  double margin = 0;                  ///< g + margin <= 0 is wanted, where there is no barrier
  Eigen::VectorXd lambda{}, kappa{};  ///< multipliers that shift the squared penalties

  /// Infinite where a barrier does not hold.
  [[nodiscard]] double value(const ConstrainedValues& at) const;
  void weigh(const ConstrainedValues& at, ConstraintWeights& weights) const;
  /// The same, but without a barrier, and with the inequalities that count for a step being those that would
  /// where g has `change`d. Whether they are others than before.
  [[nodiscard]] bool weighAhead(const ConstrainedValues& at, const Eigen::VectorXd& change,
                                ConstraintWeights& weights) const;
  /// Multipliers that make the gradient of the Lagrangian that of this function.
  void updateMultipliers(const ConstrainedValues& at, Eigen::VectorXd& ofG, Eigen::VectorXd& ofH) const;
};

}  // namespace rex::internal
