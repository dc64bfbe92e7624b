#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "base/derivative_check.h"
#include "base/rng.h"
#include "support/expect_error.h"
#include "trajectory/splines.h"

namespace rex::b_spline_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;

MatrixXd randomControl(Rng& rng, int points) {
  MatrixXd control(2, points);
  for (double& x : control.reshaped()) x = rng.normal();
  return control;
}

// Basis function i by the recursion of Cox and de Boor.
double basis(const std::vector<double>& knots, int i, int p, double t) {
  const auto knot = [&](int k) { return knots[static_cast<std::size_t>(k)]; };
  if (p == 0) return knot(i) <= t && t < knot(i + 1) ? 1 : 0;
  const double first = knot(i + p) - knot(i), second = knot(i + p + 1) - knot(i + 1);
  double sum = 0;
  if (first > 0) sum += (t - knot(i)) / first * basis(knots, i, p - 1, t);
  if (second > 0) sum += (knot(i + p + 1) - t) / second * basis(knots, i + 1, p - 1, t);
  return sum;
}

TEST(BSpline, IsTheSumOfBasisFunctions) {
  Rng rng(1);
  const int N = 7;
  for (int p = 0; p <= 4; ++p) {
    const MatrixXd control = randomControl(rng, N);
    const BSpline spline(control, p, 3);
    std::vector<double> knots(static_cast<std::size_t>(p), 0.);
    for (int k = 0; k <= N - p; ++k) knots.push_back(3. * k / (N - p));
    knots.insert(knots.end(), static_cast<std::size_t>(p), 3.);
    for (const double t : {0., 0.4, 1.37, 2.2, 2.999}) {
      VectorXd wanted = VectorXd::Zero(2);
      for (int i = 0; i < N; ++i) wanted += basis(knots, i, p, t) * control.col(i);
      EXPECT_LT((spline.value(t) - wanted).cwiseAbs().maxCoeff(), 1e-12) << "degree " << p << " at " << t;
    }
  }
}

TEST(BSpline, HasItsDerivatives) {
  Rng rng(2);
  for (int p = 1; p <= 4; ++p) {
    BSpline spline(randomControl(rng, 8), p, 2);
    for (; spline.degree() > 0; spline = spline.derivative()) {
      for (const double t : {0.13, 0.91, 1.72}) {
        const JacobianCheck check = checkJacobian([&](const VectorXd& s) { return spline.value(s[0]); },
                                                  spline.derivative().value(t), VectorXd::Constant(1, t));
        EXPECT_TRUE(check.ok) << "degree " << p << ": " << check.message;
      }
    }
    EXPECT_EQ(spline.derivative().value(1), VectorXd(Eigen::Vector2d(0, 0)));
  }
}

TEST(BSpline, StartsAndEndsAtItsEndPoints) {
  Rng rng(3);
  const MatrixXd control = randomControl(rng, 6);
  const BSpline spline(control, 3, 2);
  for (const double before : {0., -1.}) EXPECT_EQ(spline.value(before), control.col(0));
  for (const double after : {2., 5.}) EXPECT_LT((spline.value(after) - control.col(5)).norm(), 1e-15);
  EXPECT_EQ(spline.duration(), 2);
  EXPECT_EQ(spline.control(), control);
}

TEST(BSpline, SaysWhatIsWrong) {
  const MatrixXd control = MatrixXd::Ones(2, 3);
  EXPECT_REX_ERROR(BSpline(control, -1, 1), "degree of a B-spline: found -1, wanted 0 or more");
  EXPECT_REX_ERROR(BSpline(control, 3, 1),
                   "control points of a B-spline of degree 3: found 3, wanted at least 4");
  EXPECT_REX_ERROR(BSpline(control * std::nan(""), 2, 1),
                   "control points of a B-spline: number 0: found nan");
  EXPECT_REX_ERROR(BSpline(control, 2, 0),
                   "duration of a B-spline: found 0 s, wanted a positive, finite number of seconds");
  EXPECT_REX_ERROR(BSpline(control, 2, 1).value(std::nan("")), "time on a spline: found nan");
}

}  // namespace rex::b_spline_test
