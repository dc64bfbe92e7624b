#include "optim/test_functions.h"

#include <cmath>
#include <numbers>
#include <string>

#include <gtest/gtest.h>

#include "base/derivative_check.h"
#include "base/rng.h"
#include "support/expect_error.h"

namespace rex::test_functions_test {

double valueAt(const char* name, const Eigen::VectorXd& x) { return testFunction(name).value(x); }

TEST(TestFunctions, HaveTheirOneMinimumWhereTheySay) {
  Rng rng(1);
  for (const TestFunction& function : testFunctions()) {
    SCOPED_TRACE(std::string(function.name));
    for (const int n : {function.leastDimension, 5, 20}) {
      const Eigen::VectorXd best = Eigen::VectorXd::Constant(n, function.minimizer);
      EXPECT_NEAR(function.value(best), 0, 1e-11);
      const auto gradient = numericJacobian(
          [&](const Eigen::VectorXd& x) { return Eigen::VectorXd::Constant(1, function.value(x)); }, best,
          1e-4);
      if (function.name != "ackley") {  // which has a kink there
        EXPECT_LT(gradient.cwiseAbs().maxCoeff(), 1e-4);
      }
      for (int i = 0; i < 50; ++i) {
        EXPECT_GT(function.value(rng.uniformVector(n, function.low, function.high)), function.target);
        EXPECT_GT(function.value(best + 1e-2 * rng.normalVector(n)), 0);
      }
    }
  }
}

TEST(TestFunctions, AgreeWithValuesByHand) {
  using Eigen::Vector2d;
  EXPECT_DOUBLE_EQ(valueAt("sphere", Vector2d(3, -4)), 25);
  EXPECT_DOUBLE_EQ(valueAt("ellipsoid", Vector2d(3, -1)), 9 + 1e6);
  EXPECT_DOUBLE_EQ(valueAt("ellipsoid", Eigen::Vector3d(1, 1, 1)), 1 + 1e3 + 1e6);
  EXPECT_DOUBLE_EQ(valueAt("cigar", Eigen::Vector3d(3, 1, 2)), 9 + 5e6);
  EXPECT_DOUBLE_EQ(valueAt("rosenbrock", Vector2d(-1, 2)), 104);
  EXPECT_DOUBLE_EQ(valueAt("rastrigin", Vector2d(0.5, 1)), 0.25 + 20 + 1);
  // Turned by one radian: (1, 0) lies at (cos 1, sin 1).
  EXPECT_NEAR(valueAt("rotated-rastrigin", Vector2d(1, 0)),
              valueAt("rastrigin", Vector2d(std::cos(1), std::sin(1))), 1e-12);
  EXPECT_NEAR(valueAt("griewank", Vector2d(std::numbers::pi, 0)), std::pow(std::numbers::pi, 2) / 4000 + 2,
              1e-12);
  EXPECT_NEAR(valueAt("ackley", Vector2d(1, 1)), 20 * (1 - std::exp(-0.2)), 1e-12);
  EXPECT_NEAR(valueAt("schwefel", Vector2d::Zero()), 2 * 418.9828872724, 1e-9);
  // Its second best place is far from the best: the reason why it is hard.
  EXPECT_NEAR(valueAt("schwefel", Vector2d(420.9687, -302.5249)), 118.4384, 1e-3);
}

TEST(TestFunctions, PenalizeSchwefelOutsideItsBox) {
  const double inside = valueAt("schwefel", Eigen::VectorXd::Constant(1, 500));
  EXPECT_NEAR(valueAt("schwefel", Eigen::VectorXd::Constant(1, 500 + 1e-9)), inside, 1e-6);
  const double x = 502, plain = 418.98288727243374 + x * std::sin(std::sqrt(x));
  EXPECT_NEAR(valueAt("schwefel", Eigen::VectorXd::Constant(1, -x)), plain + 4e4, 1e-9);
}

TEST(TestFunctions, NameTheNearest) {
  EXPECT_REX_ERROR(testFunction("rastrign"),
                   "test function: found 'rastrign', wanted sphere, ellipsoid, cigar, rosenbrock, ackley, "
                   "griewank, rastrigin, rotated-rastrigin, schwefel (did you mean 'rastrigin'?)");
}

}  // namespace rex::test_functions_test
