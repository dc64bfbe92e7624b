#include "control/controllability.h"

#include <cmath>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/SVD>
#include <gtest/gtest.h>

#include "base/rng.h"
#include "support/expect_error.h"

namespace rex::controllability_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using testing::HasSubstr;

LinearSystem plane(double a, double b, double c, double d, double b0, double b1) {
  LinearSystem system{.A = MatrixXd(2, 2), .B = MatrixXd(2, 1)};
  system.A << a, b, c, d;
  system.B << b0, b1;
  return system;
}

int rankOf(const MatrixXd& M) {
  Eigen::JacobiSVD<MatrixXd> svd(M);
  svd.setThreshold(1e-10);
  return static_cast<int>(svd.rank());
}

// The examples of slides 8:26 and 8:29.
TEST(Controllability, OfTheSlides) {
  const ReachableStates coupled = controllability(plane(0, 0, 0, 0, 1, 1));
  EXPECT_EQ(coupled.rank, 1);
  EXPECT_FALSE(coupled.isComplete);
  EXPECT_NEAR(std::abs(coupled.unreachable.col(0).dot(Eigen::Vector2d(1, -1))), std::sqrt(2), 1e-12);
  EXPECT_EQ(coupled.message, "rank 1 of 2: the control cannot reach the mode of eigenvalue 0");
  EXPECT_EQ(controllability(plane(0, 0, 0, 0, 1, 0)).rank, 1);
  const LinearSystem good = plane(0, 1, 0, 0, 0, 1);
  EXPECT_TRUE(controllability(good).isComplete);
  EXPECT_EQ(controllability(good).message, "rank 2 of 2");
  MatrixXd matrix(2, 2);
  matrix << 0, 1, 1, 0;
  EXPECT_EQ(controllabilityMatrix(good), matrix);
  EXPECT_EQ(controllability(plane(0, 1, 0, 0, 0, 0)).rank, 0);
  // Units do not matter: a mass of 1e12 kg is moved by a force, too.
  EXPECT_TRUE(controllability(plane(0, 1, 0, 0, 0, 1e-12)).isComplete);
  EXPECT_TRUE(controllability(plane(0, 1, 0, 0, 0, 1e-200)).isComplete);
  EXPECT_TRUE(controllability(plane(0, 1, 0, 0, 0, 1e200)).isComplete);
  EXPECT_TRUE(controllability(plane(0, 1e-9, 0, 0, 0, 1e9)).isComplete);
}

// Systems made with hidden modes: what is found is checked by Hautus' test and by the rank of the matrix.
TEST(Controllability, FindsTheHiddenModes) {
  Rng rng(8);
  for (int round = 0; round < 60; ++round) {
    const int n = 2 + rng.index(4), hidden = rng.index(n), m = 1 + rng.index(2);
    MatrixXd A = rng.normalVector(n * n).reshaped(n, n), B = rng.normalVector(n * m).reshaped(n, m);
    A.bottomLeftCorner(hidden, n - hidden).setZero();
    B.bottomRows(hidden).setZero();
    const MatrixXd T = rng.normalVector(n * n).reshaped(n, n) + 3 * MatrixXd::Identity(n, n);
    const LinearSystem system{.A = T * A * T.inverse(), .B = T * B};
    const ReachableStates found = controllability(system);
    ASSERT_EQ(found.rank, n - hidden) << "seed 8, " << round;
    EXPECT_EQ(found.rank, rankOf(controllabilityMatrix(system)));
    ASSERT_EQ(found.modes.size(), static_cast<std::size_t>(hidden));
    Eigen::VectorXcd wanted;
    if (hidden > 0) wanted = Eigen::EigenSolver<MatrixXd>(A.bottomRightCorner(hidden, hidden)).eigenvalues();
    for (const HiddenMode& mode : found.modes) {
      EXPECT_LT((wanted.array() - mode.eigenvalue).abs().minCoeff(), 1e-7);
      const Eigen::RowVectorXcd left = mode.direction.transpose();
      EXPECT_LT((left * system.A - mode.eigenvalue * left).norm(), 1e-8 * system.A.norm());
      EXPECT_LT((left * system.B).norm(), 1e-8 * system.B.norm());
    }
    EXPECT_LT((found.reachable.transpose() * found.unreachable).norm(), 1e-12);
    EXPECT_LT((found.unreachable.transpose() * system.A * found.reachable).norm(), 1e-9 * system.A.norm());
  }
}

// A chain of 20 integrators: the powers of a random system of that size have no rank left.
TEST(Controllability, DoesNotLoseLongChains) {
  LinearSystem chain{.A = MatrixXd::Zero(20, 20), .B = MatrixXd::Zero(20, 1)};
  for (int i = 0; i + 1 < 20; ++i) chain.A(i, i + 1) = 1e-3;
  chain.B(19, 0) = 5;
  EXPECT_TRUE(controllability(chain).isComplete);
}

TEST(Observability, IsControllabilityOfTheDual) {
  LinearSystem system = plane(0, 1, 0, 0, 0, 1);
  system.C = MatrixXd(1, 2);
  system.C << 1, 0;
  EXPECT_TRUE(observability(system).isComplete) << "velocities show in positions";
  system.C << 0, 1;
  const ReachableStates blind = observability(system);
  EXPECT_EQ(blind.rank, 1);
  EXPECT_THAT(blind.message,
              HasSubstr("rank 1 of 2: the measurement does not show the mode of eigenvalue 0"));
  EXPECT_NEAR(std::abs(blind.modes[0].direction[0]), 1, 1e-12) << "where it stands stays unknown";
  MatrixXd matrix(2, 2);
  matrix << 0, 1, 0, 0;
  EXPECT_EQ(observabilityMatrix(system), matrix);
}

// W by summing up many short pieces; its range is what can be reached.
TEST(Gramian, IsTheIntegral) {
  Rng rng(9);
  const LinearSystem system{.A = rng.normalVector(9).reshaped(3, 3), .B = rng.normalVector(3)};
  constexpr int kPieces = 2000;
  const double T = 1.7, h = T / kPieces;
  const LinearSystem piece = discretized(system, h);
  MatrixXd W = MatrixXd::Zero(3, 3);
  VectorXd response = system.B;  // e^{A s} B; Simpson's rule over pairs of pieces
  for (int i = 0; i <= kPieces; ++i) {
    const double weight = i == 0 || i == kPieces ? 1 : i % 2 == 1 ? 4 : 2;
    W += weight * h / 3 * response * response.transpose();
    response = (piece.A * response).eval();
  }
  EXPECT_LT((controllabilityGramian(system, T) - W).norm(), 1e-10 * W.norm());
  // Long times double many times.
  LinearSystem decaying{.A = MatrixXd::Constant(1, 1, -2), .B = MatrixXd::Constant(1, 1, 3)};
  EXPECT_NEAR(controllabilityGramian(decaying, 100)(0, 0), 9. / 4, 1e-12);
  EXPECT_NEAR(controllabilityGramian(decaying)(0, 0), 9. / 4, 1e-14);
  EXPECT_NEAR(observabilityGramian(decaying)(0, 0), 1. / 4, 1e-14);
  EXPECT_NEAR(observabilityGramian(decaying, 0.5)(0, 0), (1 - std::exp(-2.)) / 4, 1e-14);
  // A strong control does not hide the motion.
  for (const double strong : {1e-100, 1e8, 1e12, 1e100}) {
    decaying.B(0, 0) = strong;
    EXPECT_NEAR(controllabilityGramian(decaying, 0.5)(0, 0) / strong / strong, (1 - std::exp(-2.)) / 4,
                1e-14);
  }
  decaying.B(0, 0) = 3;
  decaying.A(0, 0) = 0;
  EXPECT_NEAR(controllabilityGramian(decaying, 7)(0, 0), 63, 1e-11);
}

TEST(Gramian, OfStepsIsTheSum) {
  Rng rng(10);
  const LinearSystem system{
      .A = 0.4 * rng.normalVector(9).reshaped(3, 3), .B = rng.normalVector(6).reshaped(3, 2), .step = 0.1};
  for (const int count : {1, 2, 7, 64, 101}) {
    MatrixXd W = MatrixXd::Zero(3, 3), term = system.B * system.B.transpose();
    for (int i = 0; i < count; ++i, term = (system.A * term * system.A.transpose()).eval()) W += term;
    EXPECT_LT((controllabilityGramian(system, 0.1 * count) - W).norm(), 1e-12 * W.norm()) << count;
  }
  const MatrixXd limit = controllabilityGramian(system);
  EXPECT_LT((controllabilityGramian(system, 100) - limit).norm(), 1e-9 * limit.norm());
}

TEST(Gramian, SaysWhatIsWrong) {
  const LinearSystem system = plane(0, 1, 0, 0, 0, 1);
  EXPECT_REX_ERROR(controllabilityGramian(system),
                   "Gramian of all time: found a system that is unstable: the eigenvalue 0");
  EXPECT_REX_ERROR(controllabilityGramian(system, 0),
                   "time T of a Gramian: found 0, wanted a positive, finite number");
  LinearSystem steps = plane(0.5, 0, 0, 0.5, 0, 1), growing = plane(2, 0, 0, 2, 0, 1);
  steps.step = 0.1;
  EXPECT_REX_ERROR(controllabilityGramian(steps, 1e300),
                   "time T of a Gramian: found 1e+300, wanted less than 1e15 steps of 0.1 s");
  EXPECT_REX_ERROR(controllabilityGramian(growing, 1e4), "Gramian: found entries that are not finite");
  EXPECT_REX_ERROR(controllability(system, 0),
                   "tolerance of a rank: found 0, wanted a number between 0 and 1");
}

}  // namespace rex::controllability_test
