#pragma once

#include <Eigen/Cholesky>

namespace rex::internal {

/// Steps (J^T J + lambda Id)^-1 J^T e of Levenberg and Marquardt, by the smaller of the two Woodbury forms:
/// inverseKinematicsStep() for iterations. It keeps its storage, and allocates nothing once it has been used
/// with these sizes.
class DampedStep {
 public:
  /// J: d x n. e: d. lambda > 0. `step` becomes n numbers.
  void solve(const Eigen::MatrixXd& J, const Eigen::VectorXd& e, double lambda, Eigen::VectorXd& step) {
    if (J.rows() == 3) return solveFixed<3>(J, e, lambda, step);
    if (J.rows() == 6) return solveFixed<6>(J, e, lambda, step);
    if (J.rows() <= J.cols()) return solveInTaskSpace(J, e, lambda, step);
    solveInJointSpace(J, e, lambda, step);
  }

 private:
  // Sizes known to the compiler, because a point and a pose are what most callers ask for: half the time.
  template <int D>
  static void solveFixed(const Eigen::MatrixXd& J, const Eigen::VectorXd& e, double lambda,
                         Eigen::VectorXd& step) {
    const Eigen::Map<const Eigen::Matrix<double, D, Eigen::Dynamic>> fixedJ(J.data(), D, J.cols());
    Eigen::Matrix<double, D, D> A = lambda * Eigen::Matrix<double, D, D>::Identity();
    for (const auto& column : fixedJ.colwise()) A += column * column.transpose();
    const Eigen::Matrix<double, D, 1> z = A.llt().solve(e.head<D>());
    step.noalias() = fixedJ.transpose().lazyProduct(z);
  }

  void solveInTaskSpace(const Eigen::MatrixXd& J, const Eigen::VectorXd& e, double lambda,
                        Eigen::VectorXd& step) {
    A_.setZero(J.rows(), J.rows());
    A_.selfadjointView<Eigen::Lower>().rankUpdate(J);
    A_.diagonal().array() += lambda;
    factors_.compute(A_);
    z_ = e;
    factors_.solveInPlace(z_);
    step.noalias() = J.transpose() * z_;
  }

  void solveInJointSpace(const Eigen::MatrixXd& J, const Eigen::VectorXd& e, double lambda,
                         Eigen::VectorXd& step) {
    A_.setZero(J.cols(), J.cols());
    A_.selfadjointView<Eigen::Lower>().rankUpdate(J.transpose());
    A_.diagonal().array() += lambda;
    factors_.compute(A_);
    step.noalias() = J.transpose() * e;
    factors_.solveInPlace(step);
  }

  Eigen::MatrixXd A_;
  Eigen::VectorXd z_;
  Eigen::LLT<Eigen::MatrixXd> factors_;
};

}  // namespace rex::internal
