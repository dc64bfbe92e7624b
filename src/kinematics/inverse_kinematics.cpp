#include "kinematics/inverse_kinematics.h"

#include <Eigen/Cholesky>
#include <fmt/format.h>

#include "base/error.h"
#include "base/require.h"
#include "kinematics/inverse_kinematics_internal.h"

namespace rex::internal {

Metric::Metric(const char* what, const Eigen::MatrixXd& given, Eigen::Index size)
    : matrix_(given.size() == 0 ? Eigen::MatrixXd::Identity(size, size) : given),
      isDiagonal_(matrix_.isDiagonal(0)) {
  if (matrix_.rows() != size || matrix_.cols() != size) {
    throw Error({.what = what,
                 .found = fmt::format("{} x {}", matrix_.rows(), matrix_.cols()),
                 .wanted = fmt::format("{} x {}, or empty for the identity", size, size)});
  }
  bool isPositive = matrix_.allFinite() && matrix_.isApprox(matrix_.transpose(), 1e-9);
  if (isDiagonal_) {
    isPositive = isPositive && (matrix_.diagonal().array() > 0).all();
  } else if (isPositive) {
    factors_.compute(matrix_);
    isPositive = factors_.info() == Eigen::Success;
  }
  if (!isPositive) throw Error({.what = what, .wanted = "a symmetric, positive definite matrix"});
}

Eigen::MatrixXd Metric::solve(const Eigen::MatrixXd& M) const {
  if (isDiagonal_) return matrix_.diagonal().cwiseInverse().asDiagonal() * M;
  return factors_.solve(M);
}

Eigen::MatrixXd Metric::root() const {
  if (isDiagonal_) return matrix_.diagonal().cwiseSqrt().asDiagonal();
  return factors_.matrixU();
}

}  // namespace rex::internal

namespace rex {
namespace {

StepForm cheaperForm(const internal::Metric& W, Eigen::Index d, Eigen::Index n) {
  return W.isDiagonal() && d < n ? StepForm::kTaskSpace : StepForm::kJointSpace;
}

// W^-1 J^T (J W^-1 J^T + C^-1)^-1 dy. The factors are passed as expressions, so that transposes and multiples
// of the identity are not copied.
template <class WinvTransposed, class Inverse>
Eigen::VectorXd taskSpaceStep(const MatrixArg& J, const WinvTransposed& WinvJt, const Inverse& Cinv,
                              const VectorArg& dy) {
  const Eigen::MatrixXd A = J * WinvJt + Cinv;
  return WinvJt * A.llt().solve(dy);
}

}  // namespace

Eigen::VectorXd inverseKinematicsStep(const Eigen::Ref<const Eigen::MatrixXd>& J, const VectorArg& dy,
                                      double sigma) {
  requireSize("task change dy", dy.size(), J.rows());
  requirePositive("regularisation sigma", sigma);
  // The smaller of the two equal forms (Woodbury): a task has fewer dimensions than a robot has joints.
  const auto sigma2 = sigma * sigma * Eigen::MatrixXd::Identity(J.rows(), J.rows());
  return taskSpaceStep(J, J.transpose(), sigma2, dy);
}

Eigen::VectorXd inverseKinematicsStep(const MatrixArg& J, const VectorArg& dy, const StepOptions& options) {
  const Eigen::Index d = J.rows(), n = J.cols();
  requireSize("task change dy", dy.size(), d);
  const internal::Metric W("metric W", options.W, n), C("metric C", options.C, d);
  Eigen::VectorXd a = options.a;
  if (a.size() == 0) a.setZero(n);
  requireSize("desired posture change a", a.size(), n);

  const Eigen::VectorXd missing = dy - J * a;  // the part of dy that a does not achieve
  const StepForm form = options.form == StepForm::kCheaper ? cheaperForm(W, d, n) : options.form;
  if (form == StepForm::kJointSpace) {
    const Eigen::MatrixXd JtC = J.transpose() * C.matrix();
    return a + (JtC * J + W.matrix()).llt().solve(JtC * missing);
  }
  const Eigen::MatrixXd WinvJt = W.solve(J.transpose());
  const Eigen::MatrixXd Cinv = C.solve(Eigen::MatrixXd::Identity(d, d));
  return a + taskSpaceStep(J, WinvJt, Cinv, missing);
}

}  // namespace rex
