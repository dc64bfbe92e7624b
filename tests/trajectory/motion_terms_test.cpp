#include "trajectory/motion_terms.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "base/rng.h"
#include "support/expect_error.h"
#include "trajectory/term_check.h"

namespace rex::motion_terms_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

MatrixXd randomWindow(Rng& rng, int n, int order) {
  MatrixXd X(n, order + 1);
  for (double& x : X.reshaped()) x = rng.normal();
  return X;
}

TEST(MotionTerms, HaveTheirDerivatives) {
  Rng rng(3);
  const Eigen::Vector2d weights(0.3, 2);
  for (const TrajectoryTerm& term :
       {velocityTerm(), accelerationTerm(weights), jerkTerm(), postureTerm(weights),
        limitsTerm(Eigen::Vector2d(-1, -kInfinity), Eigen::Vector2d(1, 2)), velocityLimitsTerm(weights),
        velocityLimitsTerm(Eigen::Vector2d(kInfinity, 2))}) {
    for (const double tau : {0.1, 1.}) {
      const JacobianCheck check = checkTerm(term, randomWindow(rng, 2, term.order), tau);
      EXPECT_TRUE(check.ok) << term.name << ": " << check.message;
    }
  }
}

// Of x = s^k / k! the k-th derivative is one: weights and tau say what the row is.
TEST(MotionTerms, MeasureDerivativesOfMonomials) {
  const double tau = 0.1, weight = 0.25;
  const TrajectoryTerm terms[] = {velocityTerm(VectorXd::Constant(1, weight)),
                                  accelerationTerm(VectorXd::Constant(1, weight)),
                                  jerkTerm(VectorXd::Constant(1, weight))};
  for (int k = 1; k <= 3; ++k) {
    MatrixXd X(1, k + 1);
    for (int j = 0; j <= k; ++j) X(0, j) = std::pow(0.3 + j * tau, k) / std::tgamma(k + 1);
    const TrajectoryTerm& term = terms[k - 1];
    EXPECT_EQ(term.order, k);
    EXPECT_NEAR(valueOf(term, X, tau).y[0], std::sqrt(weight * tau), 1e-12);
  }
}

TEST(MotionTerms, AreThoseOfTheSlideForStepsOfASecond) {
  const MatrixXd X = (MatrixXd(1, 4) << 1, 4, 2, 9).finished();
  EXPECT_EQ(valueOf(velocityTerm(), X.rightCols(2), 1).y[0], 7);
  EXPECT_EQ(valueOf(accelerationTerm(), X.rightCols(3), 1).y[0], 9 - 2 * 2 + 4);
  EXPECT_EQ(valueOf(jerkTerm(), X, 1).y[0], 9 - 3 * 2 + 3 * 4 - 1);
}

TEST(MotionTerms, CompareWithLimits) {
  const TrajectoryTerm term = limitsTerm(Eigen::Vector2d(-1, -kInfinity), Eigen::Vector2d(1, 2));
  EXPECT_EQ(term.kind, TermKind::kInequality);
  EXPECT_EQ(valueOf(term, Eigen::Vector2d(0.5, 3), 1).y, (VectorXd(3) << -1.5, -0.5, 1).finished());
  const MatrixXd X = (MatrixXd(1, 2) << 1, 2).finished();
  EXPECT_EQ(valueOf(velocityLimitsTerm(VectorXd::Constant(1, 3)), X, 0.5).y,
            Eigen::VectorXd(Eigen::Vector2d(-1, -5)));
}

// Infinity is not a limit, and leaves no rows that are not finite.
TEST(MotionTerms, LeaveOutInfiniteLimitsOfVelocity) {
  const TrajectoryTerm term = velocityLimitsTerm(Eigen::Vector3d(kInfinity, 3, kInfinity));
  const MatrixXd X = (MatrixXd(3, 2) << 0, 9, 1, 2, 0, -9).finished();
  const FunctionValue value = valueOf(term, X, 0.5);
  EXPECT_EQ(value.y, Eigen::VectorXd(Eigen::Vector2d(-1, -5)));
  EXPECT_EQ(value.J.row(0), (Eigen::RowVectorXd(6) << 0, -2, 0, 0, 2, 0).finished());
  EXPECT_EQ(value.J.row(1), -value.J.row(0));
  EXPECT_EQ(valueOf(velocityLimitsTerm(VectorXd::Constant(3, kInfinity)), X, 0.5).y.size(), 0);
}

TEST(MotionTerms, EndAtRest) {
  const std::vector<TrajectoryTerm> terms = restTerms(Eigen::Vector2d(1, 2), 5);
  ASSERT_EQ(terms.size(), 2u);
  for (const TrajectoryTerm& term : terms) {
    EXPECT_EQ(term.kind, TermKind::kEquality);
    EXPECT_EQ(term.first, 4);
    EXPECT_EQ(term.last, 4);
    const MatrixXd X = Eigen::Vector2d(1, 2).replicate(1, term.order + 1);
    EXPECT_EQ(valueOf(term, X, 1).y, Eigen::VectorXd(Eigen::Vector2d(0, 0)));
  }
}

TEST(MotionTerms, SayWhatIsWrong) {
  const Eigen::Vector2d two(1, 1);
  EXPECT_REX_ERROR(velocityTerm(Eigen::Vector2d(1, -1)),
                   "weights of velocity: number 1: found -1, wanted a finite number, 0 or more");
  EXPECT_REX_ERROR(valueOf(accelerationTerm(two), MatrixXd::Zero(3, 3), 1),
                   "weights of acceleration: found a vector of size 2, wanted size 3");
  EXPECT_REX_ERROR(valueOf(postureTerm(two), MatrixXd::Zero(3, 1), 1),
                   "target of a posture: found a vector of size 2, wanted size 3");
  EXPECT_REX_ERROR(limitsTerm(two, Eigen::Vector3d(1, 1, 1)),
                   "upper limits: found a vector of size 3, wanted size 2");
  EXPECT_REX_ERROR(
      limitsTerm(two, Eigen::Vector2d(1, 0)),
      "limits of coordinate 1: found 1 to 0, wanted a lower one that is not above the upper one");
  EXPECT_REX_ERROR(valueOf(limitsTerm(two, two), MatrixXd::Zero(3, 1), 1),
                   "limits of configurations: found a vector of size 2, wanted size 3");
  EXPECT_REX_ERROR(velocityLimitsTerm(Eigen::Vector2d(1, 0)),
                   "velocity limits: found 0, wanted a positive number, or infinity");
  EXPECT_REX_ERROR(velocityLimitsTerm(Eigen::Vector2d(1, NAN)),
                   "velocity limits: found nan, wanted a positive number, or infinity");
  EXPECT_REX_ERROR(valueOf(velocityLimitsTerm(two), MatrixXd::Zero(3, 2), 1),
                   "velocity limits: found a vector of size 2, wanted size 3");
}

}  // namespace rex::motion_terms_test
