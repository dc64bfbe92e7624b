#include "kinematics/inverse_kinematics.h"

#include <Eigen/Cholesky>
#include <fmt/format.h>

namespace rex {

Eigen::VectorXd inverseKinematicsStep(const Eigen::Ref<const Eigen::MatrixXd>& J, const VectorArg& dy,
                                      double sigma) {
  requireSize("task change dy", dy.size(), J.rows());
  if (!(sigma > 0))
    throw Error({.what = "regularisation sigma", .found = fmt::format("{}", sigma), .wanted = "sigma > 0"});
  // The smaller of the two equal forms (Woodbury): a task has fewer dimensions than a robot has joints.
  const Eigen::MatrixXd JJt =
      J * J.transpose() + sigma * sigma * Eigen::MatrixXd::Identity(J.rows(), J.rows());
  return J.transpose() * JJt.llt().solve(dy);
}

}  // namespace rex
