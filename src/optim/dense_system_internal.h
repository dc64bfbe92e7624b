#pragma once

#include <Eigen/Cholesky>

#include "optim/constrained_problem.h"
#include "optim/constrained_system.h"

namespace rex::internal {

/// A dense problem as solvers see it. Keeps references to the problem.
class DenseSystem final : public ConstrainedSystem {
 public:
  /// n: the size of points.
  DenseSystem(const ConstrainedProblem& problem, Eigen::Index n) : problem_(problem), n_(n) {}

  void evaluate(const Eigen::VectorXd& x, ConstrainedValues& values) override;
  void gradientOf(const ConstraintWeights& weights, Eigen::VectorXd& gradient) const override;
  void assemble(const ConstraintWeights& weights) override;
  void changeOfG(const Eigen::VectorXd& step, Eigen::VectorXd& change) const override;
  bool solve(double damping, const Eigen::VectorXd& gradient, Eigen::VectorXd& step) override;
  [[nodiscard]] std::string inequalityName(Eigen::Index row) const override;
  [[nodiscard]] std::string equalityName(Eigen::Index row) const override;

 private:
  [[nodiscard]] FunctionValue valueOf(const SmoothFunction& function, const char* name,
                                      const VectorArg& x) const;
  void addCurvature(const ConstraintWeights& weights);

  const ConstrainedProblem& problem_;
  Eigen::Index n_;
  Eigen::VectorXd x_;
  FunctionValue residuals_, cost_, g_, h_;
  Eigen::MatrixXd A_, damped_;
  Eigen::LLT<Eigen::MatrixXd> factors_;
};

}  // namespace rex::internal
