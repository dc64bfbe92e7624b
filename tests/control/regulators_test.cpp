#include "control/regulators.h"

#include <cmath>
#include <limits>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <gtest/gtest.h>

#include "base/rng.h"
#include "support/expect_error.h"

namespace rex::regulators_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using testing::HasSubstr;

LinearSystem pointMass(double m) {
  LinearSystem system{.A = MatrixXd::Zero(2, 2), .B = MatrixXd::Zero(2, 1)};
  system.A(0, 1) = 1;
  system.B(1, 0) = 1 / m;
  return system;
}

LinearSystem cartPole(double entry) {
  LinearSystem system{.A = MatrixXd::Zero(4, 4), .B = MatrixXd::Zero(4, 1)};
  system.A(0, 1) = system.A(2, 3) = 1;
  system.A(1, 2) = entry;
  system.A(3, 2) = 11.76;
  system.B(1, 0) = 0.8;
  system.B(3, 0) = -0.6;
  return system;
}

// Erratum 15: the corrected a, b, c of slides 8:20 and 8:21, and the damping ratio.
TEST(Lqr, OfThePointMassHasAClosedForm) {
  for (const double m : {0.5, 1., 3.})
    for (const double rho : {1e-4, 0.1, 1.})
      for (const double eps : {1e-3, 1., 50.}) {
        const RiccatiResult result =
            lqr(pointMass(m), eps * MatrixXd::Identity(2, 2), MatrixXd::Constant(1, 1, rho));
        ASSERT_EQ(result.status, RiccatiStatus::kSolved) << result.message;
        const double c = m * std::sqrt(rho * eps), b = m * std::sqrt(rho) * std::sqrt(2 * c + eps),
                     a = b * c / (rho * m * m);
        EXPECT_NEAR(result.X(0, 0), a, 1e-12 * a);
        EXPECT_NEAR(result.X(0, 1), c, 1e-12 * c);
        EXPECT_NEAR(result.X(1, 1), b, 1e-12 * b);
        EXPECT_NEAR(result.K(0, 0), c / (rho * m), 1e-11 * c / (rho * m));
        const double Kp = result.K(0, 0), Kd = result.K(0, 1), ratio = Kd / (2 * std::sqrt(m * Kp));
        EXPECT_NEAR(ratio, 0.5 * std::sqrt(2 + std::sqrt(eps / rho) / m), 1e-12 * ratio);
      }
}

// Erratum 32: from the printed A the published gains, from the correct one the others; both hold the system.
TEST(Lqr, OfTheCartPoleHasBothGainSets) {
  const MatrixXd Q = Eigen::Vector4d(1, 0, 1, 0).asDiagonal(), R = MatrixXd::Identity(1, 1);
  const RiccatiResult printed = lqr(cartPole(-11.76), Q, R), correct = lqr(cartPole(-5.88), Q, R);
  const Eigen::RowVector4d published(1.0000, 3.8271, 48.3070, 17.6159),
      right(1.0000, 2.6088, 52.9484, 16.5952);
  EXPECT_LT((-printed.K - published).cwiseAbs().maxCoeff(), 1e-4);
  EXPECT_LT((-correct.K - right).cwiseAbs().maxCoeff(), 1e-4);
  const auto slowest = [](const MatrixXd& K) {
    const LinearSystem real = cartPole(-5.88);
    return Eigen::EigenSolver<MatrixXd>(real.A - real.B * K).eigenvalues().real().maxCoeff();
  };
  EXPECT_NEAR(slowest(correct.K), -0.506, 1e-3);
  EXPECT_NEAR(slowest(printed.K), -0.329, 1e-3);
}

// x^T X x is what the motion costs, and any other gain costs more.
TEST(Lqr, CostsWhatItSays) {
  Rng rng(11);
  for (const bool isDiscrete : {false, true}) {
    LinearSystem system{.A = 0.5 * rng.normalVector(9).reshaped(3, 3),
                        .B = rng.normalVector(6).reshaped(3, 2)};
    const MatrixXd Q = MatrixXd::Identity(3, 3), R = 0.3 * MatrixXd::Identity(2, 2);
    const VectorXd start = rng.normalVector(3);
    if (isDiscrete) system.step = 0.1;
    const RiccatiResult best = lqr(system, Q, R);
    ASSERT_EQ(best.status, RiccatiStatus::kSolved);
    const auto cost = [&](const MatrixXd& K) {
      const MatrixXd RK = R * K, weight = Q + K.transpose() * RK;
      LinearSystem loop{.A = system.A - system.B * K, .B = system.B};
      constexpr double kStep = 1e-3;
      const MatrixXd step = isDiscrete ? loop.A : discretized(loop, kStep).A;
      VectorXd x = start;
      double sum = 0;
      for (int t = 0; t < 100000; ++t) {
        const double here = x.dot(weight * x);
        x = (step * x).eval();
        sum += isDiscrete ? here : kStep / 2 * (here + x.dot(weight * x));
      }
      return sum;
    };
    EXPECT_NEAR(cost(best.K), start.dot(best.X * start), (isDiscrete ? 1e-10 : 1e-5) * cost(best.K));
    for (int k = 0; k < 5; ++k)
      EXPECT_GT(cost(best.K + 0.05 * rng.normalVector(6).reshaped(2, 3)), cost(best.K));
  }
}

// Erratum 17: A = 0, B = (1, 0), Q = I: "will always return a controller" is false.
TEST(Lqr, SaysWhereThereIsNoController) {
  LinearSystem system{.A = MatrixXd::Zero(2, 2), .B = MatrixXd::Zero(2, 1)};
  system.B(0, 0) = 1;
  const RiccatiResult result = lqr(system, MatrixXd::Identity(2, 2), MatrixXd::Identity(1, 1));
  EXPECT_EQ(result.status, RiccatiStatus::kNotStabilizable);
  ASSERT_TRUE(result.mode.has_value());
  EXPECT_EQ(*result.mode, 0.);
  EXPECT_REX_ERROR(lqr(system, -MatrixXd::Identity(2, 2), MatrixXd::Identity(1, 1)),
                   "matrix Q: found the eigenvalue -1, wanted no negative eigenvalue");
  EXPECT_REX_ERROR(lqr(system, MatrixXd::Identity(3, 3), MatrixXd::Identity(1, 1)),
                   "rows of Q: found a vector of size 3");
  EXPECT_REX_ERROR(lqr(system, MatrixXd::Zero(2, 3), MatrixXd::Identity(1, 1)),
                   "columns of Q: found a vector of size 3");
  EXPECT_REX_ERROR(lqr(system, MatrixXd::Constant(2, 2, NAN), MatrixXd::Identity(1, 1)),
                   "matrix Q: found entries that are not finite");
}

LinearSystem seen(LinearSystem system) {
  system.C = MatrixXd::Zero(1, system.A.rows());
  system.C(0, 0) = 1;
  system.D.resize(0, 0);
  return system;
}

// The covariance of the error, by the filter's own recursion until it stands still.
TEST(SteadyKalman, IsTheLimitOfTheFilter) {
  const LinearSystem system = seen(discretized(pointMass(1), 0.1));
  const MatrixXd W = 0.01 * MatrixXd::Identity(2, 2), V = MatrixXd::Constant(1, 1, 0.2);
  MatrixXd S = MatrixXd::Identity(2, 2), gain;
  const MatrixXd &A = system.A, &C = system.C, Ct = C.transpose(), At = A.transpose();
  for (int t = 0; t < 1000; ++t) {
    const MatrixXd SCt = S * Ct, spread = C * SCt + V, inverse = spread.inverse();
    gain = SCt * inverse;
    const MatrixXd CS = C * S, known = S - gain * CS, moved = A * known;
    S = moved * At + W;
  }
  const SteadyKalman filter = steadyKalman(system, W, V);
  ASSERT_EQ(filter.status, RiccatiStatus::kSolved) << filter.message;
  EXPECT_LT((filter.covariance - S).norm(), 1e-10 * S.norm());
  EXPECT_LT((filter.L - A * gain).norm(), 1e-10);
  EXPECT_LT(filter.closedLoop.cwiseAbs().maxCoeff(), 1);
}

TEST(SteadyKalman, SpeaksOfMeasurementsAndNoise) {
  LinearSystem system = pointMass(1);
  system.C = MatrixXd::Zero(1, 2);
  system.C(0, 1) = 1;
  const MatrixXd I = MatrixXd::Identity(2, 2), one = MatrixXd::Identity(1, 1);
  const SteadyKalman blind = steadyKalman(system, I, one);
  EXPECT_EQ(blind.status, RiccatiStatus::kNotDetectable);
  EXPECT_EQ(blind.L.size(), 0);
  EXPECT_THAT(blind.message, HasSubstr("the measurement does not show the mode of eigenvalue 0"));
  const SteadyKalman quiet = steadyKalman(seen(pointMass(1)), 0 * I, one);
  EXPECT_EQ(quiet.status, RiccatiStatus::kNotStabilizable) << quiet.message;
  EXPECT_THAT(quiet.message, HasSubstr("the noise W does not move the mode of eigenvalue 0"));
  EXPECT_REX_ERROR(steadyKalman(seen(system), I, 0 * one),
                   "matrix V: found the eigenvalue 0, wanted a positive definite");
  EXPECT_REX_ERROR(steadyKalman(seen(system), -I, one), "matrix W: found the eigenvalue -1");
  EXPECT_REX_ERROR(steadyKalman(seen(system), I, -one), "matrix V: found the eigenvalue -1");
  MatrixXd skewed = I;
  skewed(0, 1) = 0.5;
  EXPECT_REX_ERROR(steadyKalman(seen(system), skewed, one), "matrix W: found a matrix that is not symmetric");
}

// Separation: the eigenvalues of the whole are those of the regulator and of the filter.
TEST(Lqg, SeparatesIntoRegulatorAndFilter) {
  for (const bool isDiscrete : {false, true}) {
    LinearSystem system = seen(cartPole(-5.88));
    if (isDiscrete) system = discretized(system, 0.02);
    const MatrixXd I = MatrixXd::Identity(4, 4), one = MatrixXd::Identity(1, 1);
    const Lqg result = lqg(system, I, one, I, 0.1 * one);
    ASSERT_EQ(result.status, RiccatiStatus::kSolved) << result.message;
    const LinearSystem loop = closedLoop(system, result.controller);
    Eigen::VectorXcd parts(8);
    parts << result.regulator.closedLoop, result.filter.closedLoop;
    const Eigen::VectorXcd whole = Eigen::EigenSolver<MatrixXd>(loop.A).eigenvalues();
    for (const std::complex<double> value : parts)
      EXPECT_LT((whole.array() - value).abs().minCoeff(), 1e-6) << value;
    EXPECT_NEAR(std::abs(whole.sum() - parts.sum()), 0, 1e-8);
  }
}

TEST(Lqg, TellsWhichHalfFails) {
  const MatrixXd I = MatrixXd::Identity(2, 2), one = MatrixXd::Identity(1, 1);
  LinearSystem blind = pointMass(1);
  blind.C = MatrixXd::Zero(1, 2);
  EXPECT_THAT(lqg(blind, I, one, I, one).message, HasSubstr("filter: not detectable"));
  LinearSystem stuck = seen(pointMass(1));
  stuck.B.setZero();
  const Lqg result = lqg(stuck, I, one, I, one);
  EXPECT_EQ(result.status, RiccatiStatus::kNotStabilizable);
  EXPECT_THAT(result.message, HasSubstr("regulator: not stabilizable"));
  EXPECT_EQ(result.controller.A.size(), 0);
}

TEST(ClosedLoop, SaysWhatDoesNotFit) {
  const LinearSystem system = seen(pointMass(1));
  LinearSystem controller{
      .A = -MatrixXd::Identity(1, 1), .B = MatrixXd::Ones(1, 1), .C = MatrixXd::Ones(1, 1)};
  EXPECT_EQ(closedLoop(system, controller).A.rows(), 3);
  controller.B.setOnes(1, 2);
  EXPECT_REX_ERROR(closedLoop(system, controller),
                   "measurements that the controller takes: found a vector of size 2");
  controller.B.setOnes(1, 1);
  controller.C.setOnes(2, 1);
  EXPECT_REX_ERROR(closedLoop(system, controller),
                   "controls that the controller gives: found a vector of size 2");
  controller.C.setOnes(1, 1);
  controller.step = 0.1;
  EXPECT_REX_ERROR(closedLoop(system, controller), "closed loop: found a controller with a different step");
}

TEST(RestAt, HoldsTheTarget) {
  LinearSystem system = seen(cartPole(-5.88));
  system.A(0, 0) = -0.5;  // a spring of sorts, so that rest needs a force
  const RestPoint rest = restPoint(system, VectorXd::Constant(1, 2));
  EXPECT_TRUE(rest.isExact);
  EXPECT_LT((system.A * rest.x + system.B * rest.u).norm(), 1e-12);
  EXPECT_NEAR(system.C.row(0).dot(rest.x), 2, 1e-12);
  const LinearSystem steps = discretized(system, 0.05);
  const RestPoint held = restPoint(steps, VectorXd::Constant(1, 2));
  EXPECT_TRUE(held.isExact);
  EXPECT_LT((steps.A * held.x + steps.B * held.u - held.x).norm(), 1e-12);
  EXPECT_FALSE(restPoint(pointMass(1), Eigen::Vector2d(1, 1)).isExact) << "nothing rests while it moves";
  LinearSystem stiff{.A = MatrixXd::Zero(3, 3), .B = MatrixXd::Zero(3, 1)};
  stiff.A.topLeftCorner(2, 2) = pointMass(1).A;
  stiff.A(2, 2) = -1e10, stiff.B(1, 0) = 1;
  EXPECT_FALSE(restPoint(stiff, Eigen::Vector3d(1, 1, 0)).isExact) << "nor beside a fast mode";
  EXPECT_REX_ERROR(restPoint(system, VectorXd::Zero(2)), "target y: found a vector of size 2, wanted size 1");
  EXPECT_REX_ERROR(restPoint(system, VectorXd::Constant(1, NAN)), "target y: number 0: found nan");
}

}  // namespace rex::regulators_test
