#pragma once

#include <string>

#include <Eigen/Core>

namespace rex {

/// A problem with constraints at a point: its cost, and the values of g(x) <= 0 and h(x) = 0.
struct ConstrainedValues {
  double cost = 0;
  Eigen::VectorXd g{}, h{};
};

/// Weights of the function w cost + a^T g + b^T h whose derivatives are needed, and weights c, d of squared
/// constraint gradients that are added to its second derivatives: sum c_i dg_i^T dg_i + d_i dh_i^T dh_i.
struct ConstraintWeights {
  double cost = 1;             ///< w
  Eigen::VectorXd g{}, h{};    ///< a, b
  Eigen::VectorXd gg{}, hh{};  ///< c, d, not negative
};

/// The interface of constrained problems for solvers, shared by dense problems and the banded ones of
/// trajectories. Implementations own their workspace.
class ConstrainedSystem {
 public:
  virtual ~ConstrainedSystem() = default;

  /// Evaluates functions and their derivatives at x.
  virtual void evaluate(const Eigen::VectorXd& x, ConstrainedValues& values) = 0;
  /// The gradient of the weighted function at the point of the last evaluate().
  virtual void gradientOf(const ConstraintWeights& weights, Eigen::VectorXd& gradient) const = 0;
  /// Stores its second derivatives A at that point, exact or Gauss-Newton, for solve().
  virtual void assemble(const ConstraintWeights& weights) = 0;
  /// The linearised change of g with a step from that point: dg/dx step.
  virtual void changeOfG(const Eigen::VectorXd& step, Eigen::VectorXd& change) const = 0;
  /// step = -(A + damping s I)^-1 gradient, with s the largest entry on A's diagonal, at least one. Returns
  /// false if that matrix is not positive definite.
  virtual bool solve(double damping, const Eigen::VectorXd& gradient, Eigen::VectorXd& step) = 0;
  /// The name of a row of g or h in messages.
  [[nodiscard]] virtual std::string inequalityName(Eigen::Index row) const = 0;
  [[nodiscard]] virtual std::string equalityName(Eigen::Index row) const = 0;
};

}  // namespace rex
