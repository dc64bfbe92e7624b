#pragma once

#include <string>

#include <Eigen/Core>

namespace rex {

/// A problem with constraints at a point: its cost, and the values of g(x) <= 0 and h(x) = 0.
struct ConstrainedValues {
  double cost = 0;
  Eigen::VectorXd g{}, h{};
};

/// The function w cost + a^T g + b^T h whose derivatives are asked for, and the weights c, d of squared
/// gradients of constraints that its second derivatives get besides: sum c_i dg_i^T dg_i + d_i dh_i^T dh_i.
struct ConstraintWeights {
  double cost = 1;             ///< w
  Eigen::VectorXd g{}, h{};    ///< a, b
  Eigen::VectorXd gg{}, hh{};  ///< c, d, not negative
};

/// What solvers ask of a problem with constraints: dense ones and those of trajectories, which are banded,
/// share their methods through it. Implementations keep room to work in.
class ConstrainedSystem {
 public:
  virtual ~ConstrainedSystem() = default;

  /// Evaluates functions and their derivatives at x.
  virtual void evaluate(const Eigen::VectorXd& x, ConstrainedValues& values) = 0;
  /// The gradient of the weighted function where evaluate() was called last.
  virtual void gradientOf(const ConstraintWeights& weights, Eigen::VectorXd& gradient) const = 0;
  /// Keeps its second derivatives A there, exact or by Gauss and Newton, for solve().
  virtual void assemble(const ConstraintWeights& weights) = 0;
  /// By how much g would change with a step if it were linear, as at that place: dg/dx step.
  virtual void changeOfG(const Eigen::VectorXd& step, Eigen::VectorXd& change) const = 0;
  /// step = -(A + damping s I)^-1 gradient, with s the largest number on A's diagonal, at least one. False
  /// if that matrix is not positive definite.
  virtual bool solve(double damping, const Eigen::VectorXd& gradient, Eigen::VectorXd& step) = 0;
  /// What to call a row of g or h in messages.
  [[nodiscard]] virtual std::string inequalityName(Eigen::Index row) const = 0;
  [[nodiscard]] virtual std::string equalityName(Eigen::Index row) const = 0;
};

}  // namespace rex
