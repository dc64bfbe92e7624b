#include "control/stability.h"

#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <Eigen/QR>
#include <gtest/gtest.h>

#include "base/rng.h"
#include "control/riccati.h"
#include "support/expect_error.h"

namespace rex::stability_test {

using Eigen::MatrixXd;
using testing::HasSubstr;

MatrixXd two(double a, double b, double c, double d) {
  MatrixXd A(2, 2);
  A << a, b, c, d;
  return A;
}

MatrixXd turned(const MatrixXd& A, Rng& rng) {
  const Eigen::Index n = A.rows();
  const MatrixXd U =
      Eigen::HouseholderQR<MatrixXd>(rng.normalVector(static_cast<int>(n * n)).reshaped(n, n)).householderQ();
  return U * A * U.transpose();
}

// Slide 8:37: m s^2 + Kd s + Kp = 0. With Kd = 0 the mass swings on; without a spring it drifts away.
TEST(Stability, OfThePointMass) {
  const double m = 2, Kp = 3;
  for (const double Kd : {-1., 0., 0.5, 10.}) {
    const StabilityResult result = continuousStability(two(0, 1, -Kp / m, -Kd / m));
    EXPECT_EQ(result.stability, Kd > 0    ? Stability::kAsymptotic
                                : Kd == 0 ? Stability::kMarginal
                                          : Stability::kUnstable);
    const std::complex<double> slow = (-Kd + std::sqrt(std::complex<double>(Kd * Kd - 4 * m * Kp))) / (2 * m);
    EXPECT_NEAR(result.rate, slow.real(), 1e-12);
  }
  EXPECT_THAT(continuousStability(two(0, 1, -1.5, 0)).message,
              HasSubstr("marginally stable: the mode of eigenvalue"));
  EXPECT_THAT(continuousStability(two(0, 1, -1.5, 1)).message,
              HasSubstr("unstable: the mode of eigenvalue 0.5"));
}

// Erratum 16: all real parts are zero, yet the double integrator runs away, in whatever coordinates.
TEST(Stability, NeedsAsManyEigenvectorsAsEigenvalues) {
  Rng rng(5);
  MatrixXd swings = MatrixXd::Zero(4, 4);  // two equal oscillators, coupled or not
  swings.topLeftCorner(2, 2) = swings.bottomRightCorner(2, 2) = two(0, 2, -2, 0);
  MatrixXd coupled = swings;
  coupled.topRightCorner(2, 2).setIdentity();
  MatrixXd triple = MatrixXd::Zero(3, 3);
  triple(0, 1) = triple(1, 2) = 1;
  for (int round = 0; round < 20; ++round) {
    const bool isTurned = round > 0;
    const auto seen = [&](const MatrixXd& A) { return continuousStability(isTurned ? turned(A, rng) : A); };
    const StabilityResult drifts = seen(two(0, 1, 0, 0));
    EXPECT_EQ(drifts.stability, Stability::kUnstable) << drifts.message;
    EXPECT_EQ(drifts.algebraic, 2);
    EXPECT_EQ(drifts.geometric, 1);
    EXPECT_THAT(drifts.message, HasSubstr("counts 2 times but has 1 eigenvector: its mode grows as a power"));
    EXPECT_EQ(seen(triple).algebraic, 3) << seen(triple).message;
    EXPECT_EQ(seen(MatrixXd::Zero(3, 3)).stability, Stability::kMarginal);
    EXPECT_EQ(seen(swings).stability, Stability::kMarginal) << seen(swings).message;
    EXPECT_EQ(seen(swings).geometric, 2);
    EXPECT_EQ(seen(coupled).stability, Stability::kUnstable) << seen(coupled).message;
    EXPECT_EQ(seen(two(-1, 1, 0, -1)).stability, Stability::kAsymptotic);
  }
}

// Equal eigenvalues beside a fast one: not near the axis, however far rounding may scatter them.
TEST(Stability, OfCriticalDampingBesideAFastMode) {
  for (const double fast : {1e3, 1e6, 1e9}) {
    MatrixXd A = MatrixXd::Zero(3, 3);
    A.topLeftCorner(2, 2) = two(-1, 1, 0, -1);
    A(2, 2) = -fast;
    EXPECT_EQ(continuousStability(A).stability, Stability::kAsymptotic) << continuousStability(A).message;
    A(0, 0) = A(1, 1) = 1;
    EXPECT_EQ(continuousStability(A).stability, Stability::kUnstable);
    EXPECT_THAT(continuousStability(A).message, HasSubstr("unstable: the mode of eigenvalue 1 grows"));
  }
}

TEST(Stability, DoesNotDependOnTheUnitOfTime) {
  for (const double unit : {1e-300, 1e-155, 1., 1e155, 1e300}) {
    EXPECT_EQ(continuousStability(unit * two(-1, 1, 0, -1)).stability, Stability::kAsymptotic) << unit;
    EXPECT_EQ(continuousStability(unit * two(1, 1, 0, -1)).stability, Stability::kUnstable) << unit;
    EXPECT_EQ(continuousStability(unit * two(0, 1, -1, 0)).stability, Stability::kMarginal) << unit;
    EXPECT_EQ(continuousStability(unit * two(0, 1, 0, 0)).stability, Stability::kUnstable) << unit;
  }
}

// Weak damping is damping.
TEST(Stability, TellsSlowDecayFromNone) {
  for (const double damping : {1e-6, 1e-9, 1e-12}) {
    EXPECT_EQ(continuousStability(two(0, 1, -1, -damping)).stability, Stability::kAsymptotic) << damping;
    EXPECT_EQ(continuousStability(two(0, 1, -1, damping)).stability, Stability::kUnstable) << damping;
  }
}

TEST(Stability, OfStepsHoldsTheUnitCircle) {
  Rng rng(6);
  const double c = std::cos(0.4), s = std::sin(0.4);
  const MatrixXd turn = two(c, -s, s, c);
  EXPECT_EQ(discreteStability(turn).stability, Stability::kMarginal) << discreteStability(turn).message;
  EXPECT_EQ(discreteStability(0.999 * turn).stability, Stability::kAsymptotic);
  EXPECT_NEAR(discreteStability(0.999 * turn).rate, 0.999, 1e-14);
  EXPECT_EQ(discreteStability(1.001 * turn).stability, Stability::kUnstable);
  EXPECT_EQ(discreteStability(MatrixXd::Identity(2, 2)).stability, Stability::kMarginal);
  const StabilityResult drifts = discreteStability(turned(two(1, 1, 0, 1), rng));
  EXPECT_EQ(drifts.stability, Stability::kUnstable) << drifts.message;
  EXPECT_THAT(drifts.message, HasSubstr("on the unit circle"));
  EXPECT_EQ(discreteStability(-MatrixXd::Identity(2, 2)).stability, Stability::kMarginal);
}

// Lyapunov's equation has a positive X exactly for stable systems.
TEST(Stability, AgreesWithLyapunov) {
  Rng rng(7);
  int stable = 0;
  for (int round = 0; round < 100; ++round) {
    const int n = 1 + rng.index(6);
    MatrixXd A = rng.normalVector(n * n).reshaped(n, n);
    A.diagonal().array() -= 1.5;
    const bool isStable = continuousStability(A).stability == Stability::kAsymptotic;
    const MatrixXd X = solveLyapunov(A, MatrixXd::Identity(n, n));
    EXPECT_EQ(isStable, X.ldlt().isPositive() && X.determinant() > 0);
    stable += isStable;
  }
  EXPECT_GT(stable, 10);
  EXPECT_LT(stable, 90);
}

TEST(Stability, SaysWhatIsWrong) {
  EXPECT_REX_ERROR(continuousStability(MatrixXd::Zero(2, 3)),
                   "columns of A: found a vector of size 3, wanted size 2");
  EXPECT_REX_ERROR(continuousStability(MatrixXd(0, 0)), "matrix A: found no rows");
  EXPECT_REX_ERROR(discreteStability(two(NAN, 0, 0, 0)), "matrix A: found entries that are not finite");
}

}  // namespace rex::stability_test
