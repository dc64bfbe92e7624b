#include "optim/cma_es.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

#include <Eigen/QR>
#include <gtest/gtest.h>

#include "optim/search_result.h"
#include "optim/test_functions.h"
#include "support/allocations.h"
#include "support/expect_error.h"

namespace rex::cma_es_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;

MatrixXd randomRotation(int n, Rng& rng) {
  MatrixXd M(n, n);
  for (auto column : M.colwise()) column = rng.normalVector(n);
  return Eigen::HouseholderQR<MatrixXd>(M).householderQ();
}

VectorXd ones(int n) { return VectorXd::Ones(n); }

// One generation on f.
void advance(CmaEs& es, const Objective& f, Rng& rng) {
  MatrixXd X(es.dimension(), es.lambda());
  VectorXd values(es.lambda());
  es.sample(X, rng);
  batched(f)(X, values);
  es.update(X, values);
}

TEST(CmaEs, SamplesItsDistribution) {
  const Eigen::Vector3d mean(1, -2, 3), deviations(0.5, 2, 1);
  CmaEs es(mean, deviations, {.lambda = 100'000});
  MatrixXd X(3, es.lambda());
  Rng rng(1);
  es.sample(X, rng);
  const Eigen::Vector3d middle = X.rowwise().mean();
  const MatrixXd centered = X.colwise() - middle;
  const Eigen::Matrix3d covariance = centered * centered.transpose() / es.lambda();
  EXPECT_LT((middle - mean).cwiseQuotient(deviations).cwiseAbs().maxCoeff(), 0.015);
  const Eigen::Matrix3d wanted = deviations.cwiseAbs2().asDiagonal();
  EXPECT_LT((covariance - wanted).cwiseAbs().maxCoeff(), 0.06);
  EXPECT_LT((es.sigma() * es.sigma() * es.covariance() - wanted).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(CmaEs, HasTheUsualSizes) {
  const CmaEs one(ones(1), ones(1)), ten(ones(10), ones(10)), own(ones(10), ones(10), {.lambda = 8, .mu = 2});
  EXPECT_EQ(one.lambda(), 4);
  EXPECT_EQ(ten.lambda(), 10);
  EXPECT_EQ(ten.mu(), 5);
  EXPECT_EQ(own.lambda(), 8);
  EXPECT_EQ(own.mu(), 2);
}

// One strategy more, with the equations of the tutorial as they stand there, and no thought of speed. It is
// for few samples, where the limits of c_mu and of the negative weights do not matter.
struct Tutorial {
  Tutorial(const VectorXd& mean, double deviation, int lambda)
      : n(static_cast<double>(mean.size())),
        m(mean),
        pSigma(VectorXd::Zero(mean.size())),
        pc(pSigma),
        sigma(deviation),
        C(MatrixXd::Identity(mean.size(), mean.size())),
        mu(lambda / 2),
        w(lambda) {
    for (int i = 1; i <= lambda; ++i) w[i - 1] = std::log((lambda + 1) / 2.) - std::log(i);
    const auto effective = [](const VectorXd& some) { return some.sum() * some.sum() / some.squaredNorm(); };
    muEff = effective(w.head(mu));
    const double muEffBad = effective(w.tail(lambda - mu));
    cSigma = (muEff + 2) / (n + muEff + 5);
    cc = (4 + muEff / n) / (n + 4 + 2 * muEff / n);
    c1 = 2 / (std::pow(n + 1.3, 2) + muEff);
    cMu = 2 * (muEff - 2 + 1 / muEff) / (std::pow(n + 2, 2) + 2 * muEff / 2);
    w.head(mu) /= w.head(mu).sum();
    w.tail(lambda - mu) *=
        std::min({1 + c1 / cMu, 1 + 2 * muEffBad / (muEff + 2), (1 - c1 - cMu) / (n * cMu)}) /
        -w.tail(lambda - mu).sum();
  }

  double usualLength() const { return std::sqrt(n) * (1 - 1 / (4 * n) + 1 / (21 * n * n)); }

  // g counts from 0; Y holds (x - m) / sigma, the best first.
  void update(const MatrixXd& Y, int g) {
    const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(C);
    const MatrixXd root = eigen.operatorInverseSqrt();
    const VectorXd step = Y.leftCols(mu) * w.head(mu);
    m += sigma * step;
    pSigma = (1 - cSigma) * pSigma + std::sqrt(cSigma * (2 - cSigma) * muEff) * root * step;
    const double length = pSigma.norm(),
                 dSigma = 1 + 2 * std::max(0., std::sqrt((muEff - 1) / (n + 1)) - 1) + cSigma;
    const double h =
        length / std::sqrt(1 - std::pow(1 - cSigma, 2 * (g + 1))) < (1.4 + 2 / (n + 1)) * usualLength();
    pc = (1 - cc) * pc + h * std::sqrt(cc * (2 - cc) * muEff) * step;
    MatrixXd next = (1 + c1 * (1 - h) * cc * (2 - cc) - c1 - cMu * w.sum()) * C + c1 * pc * pc.transpose();
    for (Eigen::Index i = 0; i < w.size(); ++i) {
      const double weight = w[i] >= 0 ? w[i] : w[i] * n / (root * Y.col(i)).squaredNorm();
      next += cMu * weight * Y.col(i) * Y.col(i).transpose();
    }
    C = next;
    sigma *= std::exp(cSigma / dSigma * (length / usualLength() - 1));
  }

  double n;
  VectorXd m, pSigma, pc;
  double sigma;
  MatrixXd C;
  int mu;
  VectorXd w;
  double muEff = 0, cSigma = 0, cc = 0, c1 = 0, cMu = 0;
};

TEST(CmaEs, LearnsAsTheTutorialSays) {
  for (const auto& [n, lambda] : {std::pair{1, 4}, {3, 7}, {6, 9}, {6, 30}}) {
    Rng rng(10);
    CmaEs es(rng.normalVector(n), VectorXd::Constant(n, 0.3), {.lambda = lambda, .decompositionGap = 1});
    Tutorial own(es.mean(), 0.3, lambda);
    MatrixXd X(n, lambda);
    for (int g = 0; g < 40; ++g) {
      es.sample(X, rng);
      if (g % 10 == 5) X.colwise() += 2 * es.sigma() * rng.normalVector(n);  // a long step, for a long path
      VectorXd values(lambda);
      for (int i = 0; i < lambda; ++i) values[i] = testFunction("ellipsoid").value(X.col(i));
      std::vector<int> order(static_cast<std::size_t>(lambda));
      std::iota(order.begin(), order.end(), 0);
      std::ranges::sort(order, {}, [&](int i) { return values[i]; });
      es.update(X, values);
      own.update((X(Eigen::all, order).colwise() - own.m) / own.sigma, g);
      ASSERT_LT((es.mean() - own.m).norm(), 1e-7 * (1 + own.m.norm())) << n << ", " << lambda << ", " << g;
      ASSERT_NEAR(es.sigma(), own.sigma, 1e-6 * own.sigma) << n << ", " << lambda << ", " << g;
      ASSERT_LT((es.path() - own.pc).norm(), 1e-6 * (1 + own.pc.norm())) << n << ", " << lambda << ", " << g;
      ASSERT_LT((es.covariance() - own.C).norm(), 1e-6 * own.C.norm()) << n << ", " << lambda << ", " << g;
    }
  }
}

// Where all points lie at one place, the mean goes there: the first path is as long as the step says, and too
// long from (1.4 + 2 / (n + 1)) times the usual length on.
TEST(CmaEs, HoldsThePathBackFromTheFirstGenerationOn) {
  constexpr int n = 10;
  const Tutorial tutorial(VectorXd::Zero(n), 1, 10);
  const double limit = (1.4 + 2. / (n + 1)) * tutorial.usualLength() / std::sqrt(tutorial.muEff);
  const auto pathAfter = [&](double length) {
    CmaEs es(VectorXd::Zero(n), ones(n));
    es.update((length * VectorXd::Unit(n, 3)).replicate(1, 10), VectorXd::LinSpaced(10, 0, 1));
    return es.path().norm();
  };
  EXPECT_GT(pathAfter(0.999 * limit), 0);
  EXPECT_EQ(pathAfter(1.001 * limit), 0);
}

TEST(CmaEs, SeesOnlyTheOrderOfValues) {
  const Objective f = testFunction("rosenbrock").value;
  CmaEs plain(VectorXd::Zero(6), ones(6)), transformed(VectorXd::Zero(6), ones(6));
  Rng rng(2), again(2);
  for (int i = 0; i < 60; ++i) {
    advance(plain, f, rng);
    advance(
        transformed, [&](const VectorArg& x) { return std::log(f(x)) - 7; }, again);
  }
  EXPECT_EQ(plain.mean(), transformed.mean());
  EXPECT_EQ(plain.covariance(), transformed.covariance());
}

// The same search, seen from other coordinates x' = Q x + t: of the same points it learns the same.
TEST(CmaEs, DoesNotDependOnCoordinates) {
  constexpr int n = 5;
  Rng rng(3);
  const Objective f = testFunction("rosenbrock").value;
  const VectorXd shift = rng.normalVector(n);
  const MatrixXd Q = randomRotation(n, rng);
  CmaEs es(VectorXd::Zero(n), ones(n)), moved(shift, ones(n));
  MatrixXd X(n, es.lambda());
  VectorXd values(es.lambda());
  for (int i = 0; i < 80; ++i) {
    es.sample(X, rng);
    batched(f)(X, values);
    es.update(X, values);
    moved.update((Q * X).colwise() + shift, values);
  }
  EXPECT_LT((moved.mean() - (Q * es.mean() + shift)).cwiseAbs().maxCoeff(), 1e-8);
  const double size = es.covariance().cwiseAbs().maxCoeff();
  EXPECT_LT((moved.covariance() - Q * es.covariance() * Q.transpose()).cwiseAbs().maxCoeff(), 1e-8 * size);
  EXPECT_NEAR(moved.sigma(), es.sigma(), 1e-8 * es.sigma());
}

// With deviations as the axes of the function need them, nothing is left to learn.
TEST(CmaEs, TakesADeviationForEachCoordinate) {
  constexpr int n = 8;
  VectorXd lengths(n);
  for (int i = 0; i < n; ++i) lengths[i] = std::pow(10, -3. * i / (n - 1));
  const auto generations = [&](const char* name, const VectorXd& deviations) {
    CmaEs es(3 * deviations, deviations);
    Rng rng(9);
    while (es.result().value > 1e-10 && es.generation() < 5000) advance(es, testFunction(name).value, rng);
    return es.generation();
  };
  const int sphere = generations("sphere", ones(n));
  EXPECT_NEAR(generations("ellipsoid", lengths), sphere, 0.05 * sphere);
  EXPECT_GT(generations("ellipsoid", ones(n)), 2 * sphere);
}

// Its axes then have the curvature of the function: C ~ H^-1, after which the ellipsoid is like a sphere.
TEST(CmaEs, LearnsTheInverseHessian) {
  constexpr int n = 8;
  Rng rng(4);
  const MatrixXd Q = randomRotation(n, rng);
  const TestFunction& ellipsoid = testFunction("ellipsoid");
  CmaEs es(3 * ones(n), 2 * ones(n));
  while (es.result().value > 1e-12 && es.generation() < 2000)
    advance(
        es, [&](const VectorArg& x) { return ellipsoid.value(Q * x); }, rng);
  EXPECT_LT(es.generation(), 600);
  VectorXd roots(n);  // of the curvatures
  for (int i = 0; i < n; ++i) roots[i] = std::pow(10, 3. * i / (n - 1));
  const MatrixXd A = roots.asDiagonal() * Q;
  const Eigen::SelfAdjointEigenSolver<MatrixXd> rest(A * es.covariance() * A.transpose());
  EXPECT_LT(rest.eigenvalues().maxCoeff() / rest.eigenvalues().minCoeff(), 12);  // 1e6 at the start
}

TEST(CmaEs, HasNoUseForOneAxisOverAnother) {
  const auto generations = [](bool isTurned, std::uint64_t seed) {
    Rng rng(seed);
    const MatrixXd Q = isTurned ? randomRotation(10, rng) : MatrixXd::Identity(10, 10);
    CmaEs es(3 * ones(10), 2 * ones(10));
    while (es.result().value > 1e-8 && es.generation() < 5000)
      advance(
          es, [&](const VectorArg& x) { return testFunction("ellipsoid").value(Q * x); }, rng);
    return es.generation();
  };
  double along = 0, turned = 0;
  for (std::uint64_t seed = 0; seed < 20; ++seed)
    along += generations(false, seed) / 20., turned += generations(true, seed) / 20.;
  EXPECT_NEAR(turned / along, 1, 0.1);
}

TEST(CmaEs, DecomposesAsRarelyAsAskedTo) {
  CmaEs es(3 * ones(4), ones(4), {.decompositionGap = 3});
  Rng rng(5);
  for (int i = 1; i <= 9; ++i) {
    const MatrixXd before = es.axes();
    advance(es, testFunction("ellipsoid").value, rng);
    EXPECT_EQ(es.axes() == before, (i - 1) % 3 != 0 || i == 1) << i;  // sampled after i - 1 updates
  }
}

TEST(CmaEs, StepsAsTheCourseDoes) {
  CmaEs loop(ones(5), ones(5)), same(ones(5), ones(5));
  Rng rng(6), again(6);
  const BatchObjective f = batched(testFunction("sphere").value);
  MatrixXd samples;
  VectorXd values;
  loop.step(samples, values, rng);
  EXPECT_EQ(samples.rows(), 5);
  EXPECT_EQ(samples.cols(), loop.lambda());
  EXPECT_EQ(values.size(), loop.lambda());
  for (int i = 0; i < 1000; ++i) {  // far beyond where it could become better
    f(samples, values);
    loop.step(samples, values, rng);
    if (i < 50) advance(same, testFunction("sphere").value, again);
    if (i == 49) {
      EXPECT_EQ(loop.mean(), same.mean());
    }
  }
  EXPECT_LT(loop.result().value, 1e-80);
  EXPECT_TRUE(samples.allFinite());
}

// In loops that nobody ends.
TEST(CmaEs, KeepsItsCovarianceSound) {
  const Objective slope = [](const VectorArg&x) { return x[0]; }, flat = [](const VectorArg&) { return 0.; };
  for (const Objective& f : {slope, flat}) {
    CmaEs es(ones(4), ones(4));
    Rng rng(1);
    for (int i = 0; i < 12'000; ++i) advance(es, f, rng);
    const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(es.covariance());
    EXPECT_GT(es.covariance().diagonal().minCoeff(), 0);
    EXPECT_NEAR(std::pow(es.axisLengths().maxCoeff(), 2) / eigen.eigenvalues().maxCoeff(), 1, 0.9);
    EXPECT_GE(eigen.eigenvalues().minCoeff(), -1e-14 * eigen.eigenvalues().maxCoeff());
    EXPECT_TRUE(es.covariance().allFinite());
    EXPECT_TRUE(es.mean().allFinite());
  }
}

TEST(CmaEs, RanksWhatHasNoValueLast) {
  const auto run = [](double odd) {
    CmaEs es(ones(4), ones(4));
    Rng rng(7);
    for (int i = 0; i < 100; ++i)
      advance(
          es, [&](const VectorArg& x) { return x[0] < 0.5 ? odd : (x.array() - 1).square().sum(); }, rng);
    return es;
  };
  const double nan = std::nan(""), infinity = std::numeric_limits<double>::infinity();
  const CmaEs least = run(nan), highest = run(infinity), lowest = run(-infinity), large = run(1e300);
  for (const CmaEs* es : {&least, &highest, &lowest}) {
    EXPECT_EQ(es->mean(), large.mean());
    EXPECT_GT(es->result().invalid, 0);
    EXPECT_LT(es->result().value, 1e-8);
  }
  EXPECT_EQ(large.result().invalid, 0);

  CmaEs none(ones(4), ones(4));
  const CmaEs before = none;
  none.update(MatrixXd::Zero(4, none.lambda()), VectorXd::Constant(none.lambda(), nan));
  EXPECT_EQ(none.mean(), before.mean());
  EXPECT_EQ(none.sigma(), before.sigma());
  EXPECT_EQ(none.result().invalid, none.lambda());
}

// Eigen's decomposition takes room for one vector.
TEST(CmaEs, AllocatesOnlyToDecompose) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "the sanitizer brings its own allocator";
#endif
  for (const int gap : {1, 1000}) {
    CmaEs es(ones(20), ones(20), {.lambda = 200, .decompositionGap = gap});
    Rng rng(8);
    MatrixXd X(20, 200);
    VectorXd values(200);
    const auto generation = [&] {
      es.sample(X, rng);
      values = X.colwise().squaredNorm();
      es.update(X, values);
    };
    generation();
    const long before = allocations();
    for (int i = 0; i < 20; ++i) generation();
    EXPECT_LE(allocations() - before, gap == 1 ? 20 : 0);
  }
}

TEST(CmaEs, SaysWhatIsWrong) {
  const VectorXd two = ones(2), bad = Eigen::Vector2d(1, std::nan(""));
  EXPECT_REX_ERROR(CmaEs(VectorXd(), VectorXd()), "CMA-ES: start: found no numbers, wanted one or more");
  EXPECT_REX_ERROR(CmaEs(two, ones(3)), "CMA-ES: deviations: found a vector of size 3, wanted size 2");
  EXPECT_REX_ERROR(CmaEs(bad, two), "CMA-ES: start: number 1: found nan");
  EXPECT_REX_ERROR(CmaEs(two, bad), "CMA-ES: deviations: number 1: found nan");
  EXPECT_REX_ERROR(CmaEs(two, Eigen::Vector2d(1, 0)), "CMA-ES: deviations: found 0, wanted positive numbers");
  EXPECT_REX_ERROR(CmaEs(two, 1e-160 * two),
                   "CMA-ES: deviations: found 1e-160, wanted positive numbers, from");
  EXPECT_REX_ERROR(CmaEs(two, 1e160 * two),
                   "CMA-ES: deviations: found 1e+160, wanted positive numbers, from");
  EXPECT_REX_ERROR(CmaEs(two, Eigen::Vector2d(1, 1e-8)),
                   "CMA-ES: deviations: found 1e-08 and 1, wanted numbers within a factor of 1e+07");
  EXPECT_REX_ERROR(CmaEs(two, two, {.lambda = 1}), "CMA-ES: lambda: found 1, wanted 2 to 10000000, or 0");
  EXPECT_REX_ERROR(CmaEs(two, two, {.lambda = 8, .mu = 9}), "CMA-ES: mu: found 9, wanted 1 to 8, or 0");
  EXPECT_REX_ERROR(CmaEs(two, two, {.decompositionGap = -1}), "one decomposition to the next: found -1");
  CmaEs es(two, two, {.lambda = 6});
  MatrixXd few(2, 5), flat(1, 6), right = MatrixXd::Zero(2, 6);
  Rng rng(0);
  EXPECT_REX_ERROR(es.sample(few, rng), "CMA-ES: samples: found a vector of size 5, wanted size 6");
  EXPECT_REX_ERROR(es.sample(flat, rng), "CMA-ES: coordinates of samples: found a vector of size 1");
  EXPECT_REX_ERROR(es.update(few, ones(6)), "CMA-ES: samples: found a vector of size 5");
  EXPECT_REX_ERROR(es.update(flat, ones(6)), "CMA-ES: coordinates of samples: found a vector of size 1");
  EXPECT_REX_ERROR(es.update(right, ones(5)), "CMA-ES: values: found a vector of size 5, wanted size 6");
  right(1, 3) = std::nan("");
  EXPECT_REX_ERROR(es.update(right, ones(6)), "CMA-ES: samples: found numbers that are not finite");
}

}  // namespace rex::cma_es_test
