#include "estimation/gaussian.h"

#include <cmath>
#include <limits>
#include <numbers>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "random_gaussian.h"
#include "support/expect_error.h"

namespace rex::gaussian_test {

using test::randomCovariance;
using test::randomGaussian;
using test::randomMatrix;

TEST(Gaussian, FormsAreInverseToEachOther) {
  Rng rng(1);
  for (int n = 1; n <= 6; ++n) {
    const Gaussian x = randomGaussian(n, rng), back = toNormal(toCanonical(x));
    EXPECT_LT((x.mean - back.mean).norm(), 1e-11);
    EXPECT_LT((x.covariance - back.covariance).norm(), 1e-11);
  }
}

TEST(Gaussian, DensityIsTheFormulaOfTheSlide) {
  Rng rng(2);
  for (int n = 1; n <= 4; ++n) {
    const Gaussian x = randomGaussian(n, rng);
    const Eigen::VectorXd at = rng.normalVector(n), e = at - x.mean;
    const double wanted = std::exp(-.5 * e.dot(x.covariance.inverse() * e)) /
                          std::sqrt((2 * std::numbers::pi * x.covariance).determinant());
    EXPECT_NEAR(std::exp(logDensity(x, at)), wanted, 1e-12 * wanted);
    EXPECT_NEAR(squaredMahalanobis(x, at), e.dot(x.covariance.inverse() * e), 1e-10);
  }
}

// Identities of slide 6:28 hold as densities at any point.
TEST(Gaussian, ProductIsTheProductOfDensities) {
  Rng rng(3);
  for (int n = 1; n <= 4; ++n) {
    const Gaussian a = randomGaussian(n, rng), b = randomGaussian(n, rng);
    const GaussianProduct product = multiplied(a, b);
    const Gaussian canonical = toNormal(multiplied(toCanonical(a), toCanonical(b)));
    EXPECT_LT((canonical.mean - product.gaussian.mean).norm(), 1e-10);
    EXPECT_LT((canonical.covariance - product.gaussian.covariance).norm(), 1e-10);
    for (int i = 0; i < 5; ++i) {
      const Eigen::VectorXd x = rng.normalVector(n);
      EXPECT_NEAR(logDensity(product.gaussian, x) + product.logFactor, logDensity(a, x) + logDensity(b, x),
                  1e-9);
    }
  }
}

TEST(Gaussian, ConditionalTimesMarginalIsTheJoint) {
  Rng rng(4);
  const Gaussian joint = randomGaussian(5, rng);
  const Eigen::VectorXd z = rng.normalVector(5);
  const double split =
      logDensity(marginal(joint, 0, 2), z.head(2)) + logDensity(conditional(joint, z.head(2)), z.tail(3));
  EXPECT_NEAR(split, logDensity(joint, z), 1e-10);
}

TEST(Gaussian, PulledBackIsTheDensityOfTheImage) {
  Rng rng(5);
  const Gaussian y = randomGaussian(3, rng);
  const Eigen::MatrixXd F = randomMatrix(3, 3, rng);
  const Eigen::VectorXd f = rng.normalVector(3), x = rng.normalVector(3);
  const GaussianProduct back = pulledBack(y, F, f);
  EXPECT_NEAR(logDensity(back.gaussian, x) + back.logFactor, logDensity(y, F * x + f), 1e-9);
  EXPECT_NEAR(back.logFactor, -std::log(std::abs(F.determinant())), 1e-12);
}

TEST(Gaussian, PropagationAndSamplesHaveTheMoments) {
  Rng rng(6);
  const Gaussian y = randomGaussian(2, rng);
  const Eigen::MatrixXd F = randomMatrix(3, 2, rng), Q = randomCovariance(3, rng);
  const Eigen::VectorXd f = rng.normalVector(3);
  const Gaussian x = propagated(y, F, f, Q);
  const Gaussian noise{f, Q};
  const int count = 200000;
  Eigen::VectorXd mean = Eigen::VectorXd::Zero(3);
  Eigen::MatrixXd square = Eigen::MatrixXd::Zero(3, 3);
  for (int i = 0; i < count; ++i) {
    const Eigen::VectorXd one = F * sample(y, rng) + sample(noise, rng);
    mean += one / count;
    square += (one - x.mean) * (one - x.mean).transpose() / count;
  }
  // Six standard errors of the largest entry.
  const double bound = 6 * x.covariance.diagonal().maxCoeff() / std::sqrt(count);
  EXPECT_LT((mean - x.mean).cwiseAbs().maxCoeff(), 6 * std::sqrt(x.covariance.diagonal().maxCoeff() / count));
  EXPECT_LT((square - x.covariance).cwiseAbs().maxCoeff(), 2 * bound);
}

TEST(Gaussian, TakesWhatIsCertain) {
  Gaussian point{Eigen::Vector2d(1, 2), Eigen::Matrix2d::Zero()};
  Rng rng(7);
  EXPECT_EQ(sample(point, rng), point.mean);
  const GaussianProduct product = multiplied(point, {Eigen::Vector2d(5, 5), Eigen::Matrix2d::Identity()});
  EXPECT_LT((product.gaussian.mean - point.mean).norm(), 1e-15);
  EXPECT_LT(product.gaussian.covariance.norm(), 1e-15);
}

TEST(Covariance, RootIsARoot) {
  Rng rng(8);
  for (int n = 1; n <= 6; ++n) {
    const Eigen::MatrixXd half = randomMatrix(n, (n + 1) / 2, rng), A = half * half.transpose();
    const Eigen::MatrixXd S = covarianceRoot(A);
    EXPECT_LT((S * S.transpose() - A).norm(), 1e-7 * (1 + A.norm())) << "of a singular matrix";
    const Eigen::MatrixXd B = randomCovariance(n, rng), T = covarianceRoot(B);
    EXPECT_LT((T * T.transpose() - B).norm(), 1e-13 * (1 + B.norm()));
  }
}

// Large variances hide neither small negative ones nor what small ones have in common.
TEST(Covariance, IsJudgedEntryByEntry) {
  const auto judge = [](double a, double b, double c, double d) {
    const Eigen::Matrix2d A = (Eigen::Matrix2d() << a, b, c, d).finished();
    requireCovariance("covariance", A, 2);
  };
  EXPECT_REX_ERROR(judge(1e10, 0, 0, -1),
                   "covariance: found the eigenvalue -1, wanted no negative eigenvalue");
  EXPECT_REX_ERROR(judge(1e10, 5, 0, 25), "covariance: found 5 at (0, 1) and 0 at (1, 0)");
  EXPECT_REX_ERROR(judge(1e10, 0, 0, NAN), "covariance: found entries that are not finite");
  EXPECT_NO_THROW(judge(1e10, 0, 0, 0));
  EXPECT_NO_THROW(judge(1e10, 1, 1, 1e-10));
  Eigen::Matrix3d small = Eigen::Vector3d(1, 1e-20, 1e-20).asDiagonal();
  small(1, 2) = small(2, 1) = 1e-20;
  const Eigen::MatrixXd S = covarianceRoot(small);
  EXPECT_NEAR((S * S.transpose())(2, 2), 1e-20, 1e-26);
}

TEST(Gaussian, SaysWhatIsWrong) {
  const Gaussian good{Eigen::Vector2d(0, 0), Eigen::Matrix2d::Identity()};
  Gaussian bad = good;
  bad.covariance(0, 1) = .5;
  EXPECT_REX_ERROR((void)toCanonical(bad),
                   "covariance: found 0.5 at (0, 1) and 0 at (1, 0), wanted a symmetric matrix");
  bad.covariance << 1, 2, 2, 1;
  EXPECT_REX_ERROR((void)logDensity(bad, Eigen::Vector2d(0, 0)),
                   "covariance: found the eigenvalue -1, wanted a positive definite matrix");
  EXPECT_REX_ERROR((void)propagated(bad, Eigen::Matrix2d::Identity(), Eigen::Vector2d(0, 0), good.covariance),
                   "covariance: found the eigenvalue -1, wanted no negative eigenvalue");
  bad.covariance = Eigen::Matrix3d::Identity();
  EXPECT_REX_ERROR((void)toCanonical(bad), "covariance: found a 3 x 3 matrix, wanted 2 x 2");
  bad = good;
  bad.covariance(1, 1) = std::nan("");
  EXPECT_REX_ERROR((void)toCanonical(bad), "covariance: found entries that are not finite");
  bad = good;
  bad.mean[1] = INFINITY;
  EXPECT_REX_ERROR((void)toCanonical(bad), "mean: number 1: found inf, wanted a finite number");
  EXPECT_REX_ERROR((void)toNormal(CanonicalGaussian{Eigen::Vector2d(0, 0), Eigen::Matrix2d::Zero()}),
                   "precision: found the eigenvalue 0, wanted a positive definite matrix");
  const CanonicalGaussian canonical{Eigen::Vector2d(0, 0), Eigen::Matrix2d::Identity()},
      lost{Eigen::Vector2d(0, NAN), Eigen::Matrix2d::Identity()};
  EXPECT_REX_ERROR((void)toNormal(lost), "coefficient a: number 1: found nan");
  EXPECT_REX_ERROR((void)multiplied(lost, canonical), "coefficient a: number 1: found nan");
  EXPECT_REX_ERROR((void)multiplied(canonical, lost), "coefficient b: number 1: found nan");
  EXPECT_REX_ERROR((void)pulledBack(good, Eigen::Matrix2d::Ones(), Eigen::Vector2d(0, 0)),
                   "transformation F: found rank 1, wanted an invertible matrix, of rank 2");
  EXPECT_REX_ERROR((void)marginal(good, std::numeric_limits<int>::max(), 1),
                   "marginal: found 1 numbers from");
  EXPECT_REX_ERROR((void)logDensity(good, Eigen::Vector3d(0, 0, 0)), "point: found a vector of size 3");
  EXPECT_REX_ERROR(
      (void)propagated(good, Eigen::Matrix3d::Identity(), Eigen::Vector3d::Zero(), good.covariance),
      "columns of F");
  EXPECT_REX_ERROR(
      (void)propagated(good, Eigen::Matrix2d::Identity(), Eigen::Vector3d::Zero(), good.covariance),
      "offset f");
  EXPECT_REX_ERROR(
      (void)propagated(good, Eigen::Matrix2d::Identity(), Eigen::Vector2d::Zero(), -good.covariance),
      "noise Q");
  EXPECT_REX_ERROR((void)pulledBack(good, Eigen::Matrix3d::Identity(), Eigen::Vector2d::Zero()), "rows of F");
  EXPECT_REX_ERROR((void)marginal(good, 1, 2),
                   "marginal: found 2 numbers from 1 on, wanted numbers within 0 to 1");
  EXPECT_REX_ERROR((void)conditional(good, Eigen::Vector3d(0, 0, 0)),
                   "given numbers: found a vector of size 3");
  EXPECT_REX_ERROR((void)multiplied(good, {Eigen::VectorXd::Zero(1), Eigen::MatrixXd::Identity(1, 1)}),
                   "mean of the second Gaussian: found a vector of size 1, wanted size 2");
}

}  // namespace rex::gaussian_test
