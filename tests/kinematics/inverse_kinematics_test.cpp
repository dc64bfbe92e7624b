#include "kinematics/inverse_kinematics.h"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "base/rng.h"
#include "support/expect_error.h"

namespace rex {
namespace {

TEST(InverseKinematicsStep, EqualsTheOtherWoodburyForm) {
  Rng rng(1);
  for (int i = 0; i < 50; ++i) {
    const int d = 1 + rng.index(8), n = 1 + rng.index(30);
    const Eigen::MatrixXd J = rng.normalVector(d * n).reshaped(d, n);
    const Eigen::VectorXd dy = rng.normalVector(d);
    const Eigen::MatrixXd JtJ = J.transpose() * J + 0.01 * Eigen::MatrixXd::Identity(n, n);
    const Eigen::VectorXd wanted = JtJ.ldlt().solve(J.transpose() * dy);
    EXPECT_LT((inverseKinematicsStep(J, dy, 0.1) - wanted).norm(), 1e-9 * (1 + wanted.norm()));
  }
}

TEST(InverseKinematicsStep, MinimisesItsCost) {
  Rng rng(2);
  const Eigen::MatrixXd J = rng.normalVector(3 * 7).reshaped(3, 7);
  const Eigen::VectorXd dy = rng.normalVector(3);
  const auto cost = [&](const Eigen::VectorXd& dq) {
    return (J * dq - dy).squaredNorm() + 0.04 * dq.squaredNorm();
  };
  const Eigen::VectorXd best = inverseKinematicsStep(J, dy, 0.2);
  for (int i = 0; i < 100; ++i) EXPECT_GT(cost(best + 1e-3 * rng.normalVector(7)), cost(best));
}

TEST(InverseKinematicsStep, StaysBoundedAtASingularity) {
  const Eigen::MatrixXd J = Eigen::MatrixXd::Zero(3, 5);
  EXPECT_EQ(inverseKinematicsStep(J, Eigen::Vector3d(1, 1, 1), 0.01), Eigen::VectorXd::Zero(5));
}

TEST(InverseKinematicsStep, RefusesBadArguments) {
  const Eigen::MatrixXd J = Eigen::MatrixXd::Zero(3, 5);
  EXPECT_REX_ERROR(inverseKinematicsStep(J, Eigen::Vector2d(1, 1), 0.1),
                   "task change dy: found a vector of size 2, wanted size 3");
  EXPECT_REX_ERROR(inverseKinematicsStep(J, Eigen::Vector3d(1, 1, 1), 0),
                   "regularisation sigma: found 0, wanted sigma > 0");
}

}  // namespace
}  // namespace rex
