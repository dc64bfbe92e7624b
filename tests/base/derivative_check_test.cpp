#include "base/derivative_check.h"

#include <cmath>

#include <gtest/gtest.h>

#include "support/expect_error.h"

namespace rex::derivative_check_test {

Eigen::VectorXd curve(const Eigen::VectorXd& x) {
  return Eigen::Vector2d(std::sin(x[0]) * x[1], std::exp(x[0] + x[2]));
}

Eigen::MatrixXd curveJacobian(const Eigen::VectorXd& x) {
  const double e = std::exp(x[0] + x[2]);
  return (Eigen::MatrixXd(2, 3) << std::cos(x[0]) * x[1], std::sin(x[0]), 0, e, 0, e).finished();
}

const Eigen::Vector3d kPoints[] = {{0, 0, 0}, {1e-8, -1e-8, 1e-8}, {0.3, -1.2, 0.7}, {5, 100, -4}};

TEST(NumericJacobian, AgreesWithTheClosedForm) {
  for (const Eigen::Vector3d& x : kPoints) {
    const Eigen::MatrixXd J = curveJacobian(x);
    EXPECT_LT((numericJacobian(curve, x) - J).cwiseAbs().maxCoeff(), 1e-10 * (1 + J.cwiseAbs().maxCoeff()))
        << x.transpose();
  }
}

TEST(CheckJacobian, AcceptsTheRightOne) {
  for (const Eigen::Vector3d& x : kPoints) {
    const JacobianCheck check = checkJacobian(curve, curveJacobian(x), x);
    EXPECT_TRUE(check.ok) << check.message;
    EXPECT_THAT(check.message, testing::StartsWith("the Jacobian agrees with finite differences"));
  }
}

TEST(CheckJacobian, NamesTheWrongEntry) {
  Eigen::MatrixXd J = curveJacobian(kPoints[2]);
  J(1, 2) = 7;
  const JacobianCheck check = checkJacobian(curve, J, kPoints[2]);
  EXPECT_FALSE(check.ok);
  EXPECT_EQ(check.row, 1);
  EXPECT_EQ(check.column, 2);
  EXPECT_EQ(
      check.message,
      "entry (1, 2) of the Jacobian is 7, finite differences give 2.71828 (rows and columns count from 0)");
}

TEST(CheckJacobian, FailsForNaNAndWrongShape) {
  Eigen::MatrixXd J = curveJacobian(kPoints[2]);
  J(0, 0) = std::nan("");
  EXPECT_FALSE(checkJacobian(curve, J, kPoints[2]).ok);
  const JacobianCheck transposed = checkJacobian(curve, curveJacobian(kPoints[2]).transpose(), kPoints[2]);
  EXPECT_FALSE(transposed.ok);
  EXPECT_EQ(transposed.message, "the Jacobian is 3 x 2, wanted 2 x 3");
  EXPECT_FALSE(JacobianCheck{}.ok);
}

TEST(NumericJacobian, RefusesFunctionsItCannotDifferentiate) {
  const VectorFunction changesSize = [](const Eigen::VectorXd& x) {
    return Eigen::VectorXd::Zero(x[0] > 0 ? 2 : 1).eval();
  };
  EXPECT_REX_ERROR(numericJacobian(changesSize, Eigen::VectorXd::Zero(1)),
                   "value of the function to differentiate: found a vector of size 2, wanted size 1");
  const VectorFunction notFinite = [](const Eigen::VectorXd& x) {
    return Eigen::VectorXd::Constant(1, std::log(x[0])).eval();
  };
  EXPECT_REX_ERROR(numericJacobian(notFinite, Eigen::VectorXd::Zero(1)),
                   "value of the function to differentiate: found a number that is not finite");
}

}  // namespace rex::derivative_check_test
