#include "control/lyapunov_check.h"

#include <cmath>

#include <gtest/gtest.h>

#include "base/rng.h"
#include "control/regulators.h"
#include "support/expect_error.h"

namespace rex::lyapunov_check_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using testing::HasSubstr;

constexpr double kMass = 2, kP = 3, kD = 0.7;

VectorXd held(const VectorXd& x) { return Eigen::Vector2d(x[1], (-kP * x[0] - kD * x[1]) / kMass); }

LyapunovRegion box(double size) {
  return {.low = VectorXd::Constant(2, -size),
          .high = VectorXd::Constant(2, size),
          .equilibrium = VectorXd::Zero(2)};
}

double energy(const VectorXd& x) { return 0.5 * kMass * x[1] * x[1] + 0.5 * kP * x[0] * x[0]; }

// Erratum 18: the kinetic energy is not positive definite; with the spring's it never rises, but does
// not fall where the mass stands; a cross term makes it fall.
TEST(CheckLyapunov, OfThePointMass) {
  Rng rng(41);
  const LyapunovResult kinetic =
      checkLyapunov(held, {[](const VectorXd& x) { return 0.5 * kMass * x[1] * x[1]; }}, box(2), rng);
  EXPECT_EQ(kinetic.status, LyapunovStatus::kNotPositive);
  EXPECT_NEAR(kinetic.worst[1], 0, 1e-12) << "where it stands";
  EXPECT_THAT(kinetic.message, HasSubstr("V is not positive at ("));
  const LyapunovResult total = checkLyapunov(held, {energy}, box(2), rng);
  EXPECT_EQ(total.status, LyapunovStatus::kOnlySemidefinite) << total.message;
  EXPECT_NEAR(total.worst[1], 0, 1e-12);
  EXPECT_THAT(total.message, HasSubstr("V never rises in"));
  const auto crossed = [](const VectorXd& x) { return energy(x) + 0.2 * x[0] * x[1]; };
  const LyapunovResult better = checkLyapunov(held, {crossed}, box(2), rng);
  EXPECT_EQ(better.status, LyapunovStatus::kHolds) << better.message;
  EXPECT_GT(better.samples, 1000);
  EXPECT_THAT(better.message, HasSubstr("no counterexample in"));
  const auto pushed = [](const VectorXd& x) {
    return VectorXd(Eigen::Vector2d(x[1], (-kP * x[0] + kD * x[1]) / kMass));
  };
  const LyapunovResult rising = checkLyapunov(pushed, {energy}, box(2), rng);
  EXPECT_EQ(rising.status, LyapunovStatus::kRises);
  EXPECT_NEAR(rising.rate, kD * rising.worst[1] * rising.worst[1], 1e-6) << "V' = Kd q'^2 there";
  EXPECT_THAT(rising.message, HasSubstr("V rises at"));
}

// x' = -x + x^3: V = x^2 falls exactly where |x| < 1.
TEST(CheckLyapunov, DependsOnTheRegion) {
  Rng rng(42);
  const auto f = [](const VectorXd& x) { return VectorXd(-x + x.cwiseProduct(x).cwiseProduct(x)); };
  const LyapunovCandidate square{[](const VectorXd& x) { return x.squaredNorm(); },
                                 [](const VectorXd& x) { return VectorXd(2 * x); }};
  LyapunovRegion region{VectorXd::Constant(1, -0.99), VectorXd::Constant(1, 0.99), VectorXd::Zero(1)};
  EXPECT_EQ(checkLyapunov(f, square, region, rng).status, LyapunovStatus::kHolds);
  region.high[0] = 1.2;
  const LyapunovResult result = checkLyapunov(f, square, region, rng);
  EXPECT_EQ(result.status, LyapunovStatus::kRises);
  EXPECT_NEAR(result.worst[0], 1.2, 1e-12);
  EXPECT_NEAR(result.rate, 2 * 1.2 * (-1.2 + 1.728), 1e-9);
  EXPECT_EQ(checkLyapunov(f, {square.V}, region, rng).status, LyapunovStatus::kRises) << "by differences";
}

// Slide 8:43: the value function of the regulator falls by what the motion costs.
TEST(CertifyQuadratic, OfTheValueFunction) {
  LinearSystem system{.A = MatrixXd::Zero(2, 2), .B = MatrixXd::Zero(2, 1)};
  system.A(0, 1) = system.B(1, 0) = 1;
  const MatrixXd Q = MatrixXd::Identity(2, 2), R = MatrixXd::Identity(1, 1);
  const RiccatiResult regulator = lqr(system, Q, R);
  const MatrixXd closed = system.A - system.B * regulator.K;
  const LyapunovCertificate proof = certifyQuadratic(closed, regulator.X);
  EXPECT_EQ(proof.status, LyapunovStatus::kHolds) << proof.message;
  const MatrixXd change = closed.transpose() * regulator.X + regulator.X * closed;
  EXPECT_LT((change + Q + regulator.K.transpose() * R * regulator.K).norm(), 1e-12);
  EXPECT_NEAR(proof.worst.dot(change * proof.worst) / proof.worst.dot(regulator.X * proof.worst), proof.rate,
              1e-12);
  EXPECT_GT(proof.rate, 2 * regulator.closedLoop.real().maxCoeff() - 1e-12);
}

TEST(CertifyQuadratic, AgreesWithTheCheckByPoints) {
  Rng rng(43);
  int holds = 0;
  for (int round = 0; round < 60; ++round) {
    MatrixXd A = rng.normalVector(4).reshaped(2, 2) - MatrixXd::Identity(2, 2),
             J = rng.normalVector(4).reshaped(2, 2);
    const MatrixXd P = J * J.transpose() + (round % 3 == 0 ? -0.5 : 0.2) * MatrixXd::Identity(2, 2);
    const LyapunovCertificate proof = certifyQuadratic(A, P);
    const LyapunovResult seen =
        checkLyapunov([&](const VectorXd& x) { return VectorXd(A * x); },
                      {[&](const VectorXd& x) { return x.dot(P * x); }}, box(1), rng, 4000);
    // Points may miss what eigenvalues prove, never the other way.
    if (proof.status == LyapunovStatus::kHolds) {
      EXPECT_EQ(seen.status, LyapunovStatus::kHolds) << seen.message;
    }
    if (seen.status == LyapunovStatus::kNotPositive) {
      EXPECT_EQ(proof.status, LyapunovStatus::kNotPositive);
    }
    if (seen.status == LyapunovStatus::kRises) {
      EXPECT_NE(proof.status, LyapunovStatus::kHolds);
    }
    holds += proof.status == LyapunovStatus::kHolds;
  }
  EXPECT_GT(holds, 5);
  EXPECT_LT(holds, 55);
  const MatrixXd I = MatrixXd::Identity(2, 2);
  EXPECT_THAT(certifyQuadratic(-I, -I).message, HasSubstr("P has the eigenvalue -1 in the direction"));
  EXPECT_THAT(certifyQuadratic(I, I).message, HasSubstr("V rises in the direction"));
  MatrixXd swing(2, 2);
  swing << 0, 1, -1, 0;
  EXPECT_EQ(certifyQuadratic(swing, I).status, LyapunovStatus::kOnlySemidefinite);
}

// x' = -x + x^2 runs away from x = 1 on; V = x^2 proves it up to there, exactly.
TEST(CertifiedLevel, ReachesToTheNextEquilibrium) {
  const MatrixXd one = MatrixXd::Identity(1, 1);
  EXPECT_NEAR(certifiedLevel(-one, one, 1), 1, 1e-12);
  EXPECT_NEAR(certifiedLevel(-one, one, 2), 0.25, 1e-12);
  EXPECT_EQ(certifiedLevel(one, one, 1), 0);
  EXPECT_REX_ERROR(certifiedLevel(-one, one, 0), "curvature: found 0, wanted a positive, finite number");
}

TEST(CheckLyapunov, SaysWhatIsWrong) {
  Rng rng(44);
  const auto expect = [&](const auto& change, const char* text) {
    LyapunovRegion region = box(1);
    LyapunovCandidate candidate{energy};
    int samples = 10;
    std::function<VectorXd(const VectorXd&)> f = held;
    change(f, candidate, region, samples);
    EXPECT_REX_ERROR(checkLyapunov(f, candidate, region, rng, samples), text);
  };
  expect([](auto&, auto& V, auto&, int&) { V.V = nullptr; }, "Lyapunov candidate: found no function V");
  expect([](auto&, auto&, auto& D, int&) { D.equilibrium.resize(0); }, "region: found no equilibrium");
  expect([](auto&, auto&, auto& D, int&) { D.low.resize(1); },
         "low corner of the region: found a vector of size 1");
  expect([](auto&, auto&, auto& D, int&) { D.high.resize(1); },
         "high corner of the region: found a vector of size 1");
  expect([](auto&, auto&, auto& D, int&) { D.low[0] = NAN; },
         "low corner of the region: number 0: found nan");
  expect([](auto&, auto&, auto& D, int&) { D.high[0] = NAN; },
         "high corner of the region: number 0: found nan");
  expect([](auto&, auto&, auto& D, int&) { D.equilibrium[0] = NAN; }, "equilibrium: number 0: found nan");
  expect([](auto&, auto&, auto& D, int&) { D.low[0] = 0.5; },
         "equilibrium: found (0, 0), wanted a point inside (0.5, -1) to (1, 1)");
  expect([](auto&, auto&, auto&, int& samples) { samples = 0; }, "samples: found 0, wanted at least 1");
  expect([](auto& f, auto&, auto&, int&) { f = nullptr; }, "motion: found no function f");
  expect([](auto& f, auto&, auto&, int&) { f = [](const VectorXd&) { return VectorXd(); }; },
         "velocity f(x): found a vector of size 0, wanted size 2");
  expect([](auto& f, auto&, auto&, int&) { f = [](const VectorXd& x) { return VectorXd(x.array() + 1); }; },
         "equilibrium: found a velocity or a V that is not zero");
  expect(
      [](auto& f, auto&, auto&, int&) {
        f = [](const VectorXd& x) { return VectorXd(VectorXd::Zero(x[0] == 0 && x[1] == 0 ? 2 : 3)); };
      },
      "velocity f(x): found a vector of size 3, wanted size 2");
  expect([](auto& f, auto&, auto&,
            int&) { f = [](const VectorXd& x) { return VectorXd(x.norm() > 0 ? x * NAN : x); }; },
         "velocity f at (");
  expect([](auto&, auto& V, auto&,
            int&) { V.gradient = [](const VectorXd&) { return VectorXd(VectorXd::Zero(3)); }; },
         "gradient of V: found a vector of size 3");
  expect(
      [](auto&, auto& V, auto&, int&) { V.gradient = [](const VectorXd& x) { return VectorXd(x * NAN); }; },
      "V or its rate at (");
  const MatrixXd I = MatrixXd::Identity(2, 2), one = MatrixXd::Identity(1, 1);
  MatrixXd skewed = I;
  skewed(0, 1) = 1;
  EXPECT_REX_ERROR(certifyQuadratic(MatrixXd(0, 0), MatrixXd(0, 0)), "matrix A: found no rows");
  EXPECT_REX_ERROR(certifyQuadratic(MatrixXd::Zero(2, 3), I), "columns of A: found a vector of size 3");
  EXPECT_REX_ERROR(certifyQuadratic(I, one), "rows of P: found a vector of size 1");
  EXPECT_REX_ERROR(certifyQuadratic(I, MatrixXd::Zero(2, 3)), "columns of P: found a vector of size 3");
  EXPECT_REX_ERROR(certifyQuadratic(NAN * I, I), "matrix A: found entries that are not finite");
  EXPECT_REX_ERROR(certifyQuadratic(I, NAN * I), "matrix P: found entries that are not finite");
  EXPECT_REX_ERROR(certifyQuadratic(I, skewed), "matrix P: found a matrix that is not symmetric");
}

}  // namespace rex::lyapunov_check_test
