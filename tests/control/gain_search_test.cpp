#include "control/gain_search.h"

#include <cmath>

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include "control/regulators.h"
#include "support/expect_error.h"

namespace rex::gain_search_test {

using Eigen::MatrixXd;
using testing::HasSubstr;

LinearSystem pointMass(double m) {
  LinearSystem system{.A = MatrixXd::Zero(2, 2), .B = MatrixXd::Zero(2, 1)};
  system.A(0, 1) = 1;
  system.B(1, 0) = 1 / m;
  return system;
}

// The fastest PD controller of limited gains damps critically: all gain goes into the spring.
TEST(FastestGains, OfThePointMassDampCritically) {
  for (const double bound : {4., 100.}) {
    const double m = 0.5;
    const GainSearchResult result = fastestGains(pointMass(m), MatrixXd::Ones(1, 2), {.bound = bound});
    EXPECT_TRUE(result.isConverged) << result.message;
    EXPECT_TRUE(result.isStable);
    // Kd may not exceed the bound either: then the spring is as stiff as it can damp critically.
    const double Kp = std::min(bound, bound * bound / (4 * m)), best = -std::sqrt(Kp / m);
    EXPECT_NEAR(result.rate, best, 2e-3 * std::abs(best)) << bound;
    EXPECT_LE(result.K.cwiseAbs().maxCoeff(), bound);
    const MatrixXd closed = pointMass(m).A - pointMass(m).B * result.K;
    EXPECT_NEAR(Eigen::EigenSolver<MatrixXd>(closed).eigenvalues().real().maxCoeff(), result.rate, 1e-9);
  }
}

// In steps there is a deadbeat controller: both eigenvalues become zero.
TEST(FastestGains, FindTheDeadbeatController) {
  const LinearSystem steps = discretized(pointMass(1), 0.5);
  const GainSearchResult result = fastestGains(steps, MatrixXd::Ones(1, 2), {.bound = 10});
  EXPECT_LT(result.rate, 0.02) << result.message;
  EXPECT_NEAR(result.K(0, 0), 1 / 0.25, 0.1);
  EXPECT_NEAR(result.K(0, 1), 1.5 / 0.5, 0.1);
  EXPECT_THAT(result.message, HasSubstr("modulus"));
}

// Faster than the regulator, from where it starts; and no gains on the position alone damp.
TEST(FastestGains, ImproveOnTheRegulatorWhereTheyCan) {
  LinearSystem system = pointMass(1);
  const RiccatiResult regulator = lqr(system, MatrixXd::Identity(2, 2), MatrixXd::Identity(1, 1));
  const GainSearchResult faster = fastestGains(system, regulator.K, {.bound = 5});
  EXPECT_LT(faster.rate, regulator.closedLoop.real().maxCoeff());
  system.C = MatrixXd::Zero(1, 2);
  system.C(0, 0) = 1;
  const GainSearchResult blind = fastestGains(system, MatrixXd::Ones(1, 1));
  EXPECT_FALSE(blind.isStable) << blind.message;
  EXPECT_NEAR(blind.rate, 0, 1e-7);
  EXPECT_THAT(blind.message, HasSubstr("not stable"));
  const GainSearchResult spent = fastestGains(pointMass(1), MatrixXd::Ones(1, 2), {.maxEvaluations = 20});
  EXPECT_FALSE(spent.isConverged);
  EXPECT_THAT(spent.message, HasSubstr("evaluation limit reached"));
}

TEST(FastestGains, SaysWhatIsWrong) {
  LinearSystem system = pointMass(1);
  EXPECT_REX_ERROR(fastestGains(system, MatrixXd::Ones(2, 2)),
                   "rows of the first gains: found a vector of size 2");
  EXPECT_REX_ERROR(fastestGains(system, MatrixXd::Ones(1, 3)),
                   "columns of the first gains: found a vector of size 3");
  EXPECT_REX_ERROR(fastestGains(system, MatrixXd::Constant(1, 2, NAN)), "first gains: number 0: found nan");
  const MatrixXd K = MatrixXd::Ones(1, 2);
  EXPECT_REX_ERROR(fastestGains(system, K, {.bound = 0}), "bound of gains: found 0");
  EXPECT_REX_ERROR(fastestGains(system, K, {.bound = 0.5}),
                   "first gains: found 1, wanted at most the bound, 0.5");
  EXPECT_REX_ERROR(fastestGains(system, K, {.maxEvaluations = 0}), "evaluations: found 0, wanted at least 1");
  EXPECT_REX_ERROR(fastestGains(system, K, {.tolerance = 0}), "tolerance of gains: found 0");
  EXPECT_REX_ERROR(fastestGains({.A = MatrixXd::Zero(2, 2), .B = MatrixXd(2, 0)}, MatrixXd(0, 2)),
                   "linear system: found no control");
  system.D = MatrixXd::Ones(2, 1);
  EXPECT_REX_ERROR(fastestGains(system, K), "matrix D: found entries that are not zero");
}

}  // namespace rex::gain_search_test
