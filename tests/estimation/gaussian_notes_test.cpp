// The identities of share/doc/gaussians.md by their numbers, from the two formulas of a density alone: the
// functions of estimation/gaussian.h have their own tests.
#include <cmath>
#include <numbers>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "random_gaussian.h"

namespace rex::gaussian_notes_test {

using Eigen::MatrixXd, Eigen::VectorXd;
using test::randomCovariance, test::randomMatrix;

constexpr double kExact = 1e-9;

double logNormal(const VectorXd& x, const VectorXd& a, const MatrixXd& A) {
  return -.5 * std::log((2 * std::numbers::pi * A).determinant()) - .5 * (x - a).dot(A.inverse() * (x - a));
}
double logInformation(const VectorXd& x, const VectorXd& eta, const MatrixXd& L) {
  return -.5 * std::log((2 * std::numbers::pi * L.inverse()).determinant()) -
         .5 * eta.dot(L.inverse() * eta) - .5 * x.dot(L * x) + x.dot(eta);
}

struct Draw {
  Rng rng;
  VectorXd a = rng.normalVector(3), b = rng.normalVector(3), x = rng.normalVector(3), y = rng.normalVector(3);
  MatrixXd A = randomCovariance(3, rng), B = randomCovariance(3, rng), F = randomMatrix(3, 3, rng);
  explicit Draw(int seed) : rng(static_cast<std::uint64_t>(seed)) {}
};

TEST(GaussianNotes, N1To4FormsAndSquaredDistances) {
  Draw d(1);
  EXPECT_NEAR(logNormal(d.x, d.a, d.A), logInformation(d.x, d.A.inverse() * d.a, d.A.inverse()), kExact);
  EXPECT_NEAR(logNormal(d.x, d.a, d.A), logNormal(d.a, d.x, d.A), kExact);
  EXPECT_NEAR(logNormal(d.x, d.a, d.A), logNormal(d.x - d.a, VectorXd::Zero(3), d.A), kExact);
  // The density of a + S z is that of z over |det S|.
  const MatrixXd S = d.A.llt().matrixL();
  const VectorXd z = S.inverse() * (d.x - d.a);
  EXPECT_NEAR(logNormal(d.x, d.a, d.A),
              logNormal(z, VectorXd::Zero(3), MatrixXd::Identity(3, 3)) - std::log(std::abs(S.determinant())),
              kExact);
  EXPECT_NEAR(z.squaredNorm(), (d.x - d.a).dot(d.A.inverse() * (d.x - d.a)), kExact);
  constexpr int kSamples = 100000;
  double sum = 0, squares = 0;
  for (int i = 0; i < kSamples; ++i) {
    const double distance = d.rng.normalVector(3).squaredNorm();
    sum += distance / kSamples;
    squares += distance * distance / kSamples;
  }
  EXPECT_NEAR(sum, 3, .05);
  EXPECT_NEAR(squares - sum * sum, 6, .3);
}

TEST(GaussianNotes, N5And6Products) {
  for (int seed = 1; seed <= 5; ++seed) {
    Draw d(seed);
    const MatrixXd L = d.A.inverse() + d.B.inverse(), K = d.A * (d.A + d.B).inverse();
    const VectorXd eta = d.A.inverse() * d.a + d.B.inverse() * d.b;
    EXPECT_NEAR(logNormal(d.x, d.a, d.A) + logNormal(d.x, d.b, d.B),
                logInformation(d.x, eta, L) + logNormal(d.a, d.b, d.A + d.B), kExact);
    EXPECT_LT((L.inverse() * eta - (d.a + K * (d.b - d.a))).norm(), kExact);
    EXPECT_LT((L.inverse() - (MatrixXd::Identity(3, 3) - K) * d.A).norm(), kExact);
    EXPECT_LT((L.inverse() - (d.A - d.A * (d.A + d.B).inverse() * d.A)).norm(), kExact);
  }
}

// In one dimension by summing up, in three by completing the square: the product of both densities is the
// density of x, times one of y.
TEST(GaussianNotes, N7Propagation) {
  const double F = 1.7, f = .3, Q = .4, b = -.5, B = .8, x = .9;
  const auto one = [](double value) { return MatrixXd::Constant(1, 1, value); };
  double integral = 0;
  constexpr double kStep = 1e-3;
  for (double y = -12; y < 12; y += kStep)
    integral +=
        kStep * std::exp(logNormal(one(x), one(F * y + f), one(Q)) + logNormal(one(y), one(b), one(B)));
  EXPECT_NEAR(integral, std::exp(logNormal(one(x), one(F * b + f), one(F * B * F + Q))), 1e-9);
  Draw d(2);
  const MatrixXd S = d.F * d.B * d.F.transpose() + d.A, G = d.B * d.F.transpose() * S.inverse();
  EXPECT_NEAR(logNormal(d.x, d.F * d.y + d.a, d.A) + logNormal(d.y, d.b, d.B),
              logNormal(d.x, d.F * d.b + d.a, S) +
                  logNormal(d.y, d.b + G * (d.x - d.F * d.b - d.a), d.B - G * d.F * d.B),
              kExact);
}

TEST(GaussianNotes, N8And9Transformation) {
  Draw d(3);
  const MatrixXd inverse = d.F.inverse();
  EXPECT_NEAR(logNormal(d.F * d.x + d.b, d.a, d.A),
              logNormal(d.x, inverse * (d.a - d.b), inverse * d.A * inverse.transpose()) -
                  std::log(std::abs(d.F.determinant())),
              kExact);
  // y = sin x around .7: the exact moments of a sine of a Gaussian, E sin x = e^(-s^2/2) sin a.
  const double a = .7;
  double before[2] = {};
  for (const double s : {.2, .1, .05}) {
    const double mean = std::exp(-s * s / 2) * std::sin(a),
                 variance = (1 - std::exp(-2 * s * s) * std::cos(2 * a)) / 2 - mean * mean;
    const double errors[2] = {std::abs(mean - std::sin(a)),
                              std::abs(variance - std::pow(std::cos(a) * s, 2)) / (s * s)};
    for (int i = 0; i < 2; ++i) {
      if (before[i] > 0) {
        EXPECT_NEAR(before[i] / errors[i], 4, .3) << "second order in s";
      }
      before[i] = errors[i];
    }
  }
}

TEST(GaussianNotes, N10To13MarginalsAndConditionals) {
  Rng rng(4);
  const MatrixXd S = randomCovariance(5, rng), L = S.inverse();
  const VectorXd m = rng.normalVector(5), z = rng.normalVector(5), eta = L * m;
  const VectorXd a = m.head(2), b = m.tail(3), x = z.head(2), y = z.tail(3);
  const MatrixXd A = S.topLeftCorner(2, 2), B = S.bottomRightCorner(3, 3), C = S.topRightCorner(2, 3);
  const VectorXd mean = b + C.transpose() * A.inverse() * (x - a);
  const MatrixXd covariance = B - C.transpose() * A.inverse() * C;
  EXPECT_NEAR(logNormal(z, m, S), logNormal(x, a, A) + logNormal(y, mean, covariance), kExact);
  const MatrixXd Lxx = L.topLeftCorner(2, 2), Lxy = L.topRightCorner(2, 3), Lyy = L.bottomRightCorner(3, 3);
  EXPECT_LT((covariance - Lyy.inverse()).norm(), kExact);
  EXPECT_LT((mean - Lyy.inverse() * (eta.tail(3) - Lxy.transpose() * x)).norm(), kExact);
  EXPECT_LT((A.inverse() - (Lxx - Lxy * Lyy.inverse() * Lxy.transpose())).norm(), kExact);
  EXPECT_LT((A.inverse() * a - (eta.head(2) - Lxy * Lyy.inverse() * eta.tail(3))).norm(), kExact);
  // Entries 0 and 4 without a link in the precision are uncorrelated given entries 1 to 3.
  MatrixXd unlinked = L;
  unlinked(0, 4) = unlinked(4, 0) = 0;
  const MatrixXd full = unlinked.inverse();
  EXPECT_GT(std::abs(full(0, 4)), 1e-3);
  const Eigen::Vector2i ends(0, 4);
  const MatrixXd given = full(ends, ends) - full(ends, Eigen::seq(1, 3)) *
                                                full(Eigen::seq(1, 3), Eigen::seq(1, 3)).inverse() *
                                                full(Eigen::seq(1, 3), ends);
  EXPECT_NEAR(given(0, 1), 0, kExact);
}

TEST(GaussianNotes, N14To18KalmanFilter) {
  Draw d(5);
  const MatrixXd& S = d.A;
  const MatrixXd C = randomMatrix(2, 3, d.rng), W = randomCovariance(2, d.rng), I = MatrixXd::Identity(3, 3);
  const VectorXd c = d.rng.normalVector(2), y = d.rng.normalVector(2), s = d.a;
  const MatrixXd seen = C * S * C.transpose() + W, K = S * C.transpose() * seen.inverse(),
                 after = (I - K * C) * S;
  const VectorXd mean = s + K * (y - C * s - c);
  EXPECT_NEAR(logNormal(d.x, s, S) + logNormal(y, C * d.x + c, W),
              logNormal(d.x, mean, after) + logNormal(y, C * s + c, seen), kExact);
  const MatrixXd L = S.inverse() + C.transpose() * W.inverse() * C;
  EXPECT_LT((after - L.inverse()).norm(), kExact);
  EXPECT_LT((L * mean - (S.inverse() * s + C.transpose() * W.inverse() * (y - c))).norm(), kExact);
  EXPECT_LT((L.inverse() - (S - S * C.transpose() * seen.inverse() * C * S)).norm(), kExact);
  const auto joseph = [&](const MatrixXd& gain) -> MatrixXd {
    return (I - gain * C) * S * (I - gain * C).transpose() + gain * W * gain.transpose();
  };
  EXPECT_LT((after - joseph(K)).norm(), kExact);
  // Any other gain is worse in every direction, by the square of its distance.
  const MatrixXd other = randomMatrix(3, 2, d.rng);
  EXPECT_LT((joseph(other) - after - (other - K) * seen * (other - K).transpose()).norm(), kExact);
}

}  // namespace rex::gaussian_notes_test
