#pragma once

#include <functional>

#include "base/require.h"

namespace rex {

/// How a robot moves: x' = f(x, u, dt) + w with w ~ N(0, Q), where u is constant for dt seconds. Slide 7:5.
/// Filters take it as transitionModel() and motionProposal(), demonstrations as moved()
/// (estimation/motion_model.h), planners as controlSystem() (planning/control_tree.h).
struct MotionModel {
  int states = 0, controls = 0;  ///< the sizes of x and u
  std::function<Eigen::VectorXd(const VectorArg& x, const VectorArg& u, double dt)> f{};
  /// The Jacobians df/dx and df/du. Empty: central differences with one extrapolation (numericJacobian).
  std::function<Eigen::MatrixXd(const VectorArg&x, const VectorArg&u, double dt)> A{}, B{};
  /// Q. Empty: no noise.
  std::function<Eigen::MatrixXd(const VectorArg& x, const VectorArg& u, double dt)> noise{};
};

/// Throws Error as the functions below do for their arguments.
void requireMotion(const MotionModel& model, const VectorArg& x, const VectorArg& u, double dt);

/// The state after dt seconds without noise. These functions throw Error for a model without f, vectors of
/// the wrong size, numbers that are not finite, and a time that is negative.
[[nodiscard]] Eigen::VectorXd meanAfter(const MotionModel& model, const VectorArg& x, const VectorArg& u,
                                        double dt);

/// The model linearised at (x, u): x' - f(x, u) = A dx + B du.
struct StepJacobians {
  Eigen::MatrixXd A{};  ///< states x states
  Eigen::MatrixXd B{};  ///< states x controls
};
[[nodiscard]] StepJacobians stepJacobians(const MotionModel& model, const VectorArg& x, const VectorArg& u,
                                          double dt);

}  // namespace rex
