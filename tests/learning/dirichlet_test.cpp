#include <cmath>

#include <gtest/gtest.h>

#include "learning/learned_model_internal.h"

namespace rex::dirichlet_test {

constexpr int kDraws = 20000;

// Mean and variance of a Gamma distribution of scale 1 are its shape.
TEST(Gamma, HasItsMoments) {
  Rng rng(1);
  for (const double shape : {1., 1.7, 30.}) {
    Eigen::VectorXd draws(kDraws);
    for (double& one : draws) one = internal::drawnGamma(shape, rng);
    const double mean = draws.mean(), variance = (draws.array() - mean).square().mean();
    EXPECT_NEAR(mean, shape, 4 * std::sqrt(shape / kDraws));
    // The fourth central moment is 3 a^2 + 6 a.
    EXPECT_NEAR(variance, shape, 4 * std::sqrt((2 * shape * shape + 6 * shape) / kDraws));
    EXPECT_GT(draws.minCoeff(), 0);
  }
}

// Of weights a_i with sum A: a_i / A and a_i (A - a_i) / (A^2 (A + 1)).
TEST(Dirichlet, HasItsMoments) {
  Rng rng(2);
  const Eigen::Vector3d weights(.3, 2, 5);
  Eigen::Matrix3Xd draws(3, kDraws);
  for (auto one : draws.colwise()) one = internal::drawnDirichlet(weights, rng);
  EXPECT_LT((draws.colwise().sum().array() - 1).abs().maxCoeff(), 1e-12);
  EXPECT_GE(draws.minCoeff(), 0);
  const double sum = weights.sum();
  for (int i = 0; i < 3; ++i) {
    const double mean = weights[i] / sum, variance = mean * (1 - mean) / (sum + 1);
    EXPECT_NEAR(draws.row(i).mean(), mean, 4 * std::sqrt(variance / kDraws));
    EXPECT_NEAR((draws.row(i).array() - mean).square().mean(), variance, .06 * variance);
  }
}

// Tiny weights put nearly all on one entry, on each with the same probability.
TEST(Dirichlet, DrawsFromTinyWeights) {
  Rng rng(3);
  Eigen::Vector3d first = Eigen::Vector3d::Zero();
  for (int k = 0; k < kDraws; ++k) {
    const Eigen::VectorXd one = internal::drawnDirichlet(Eigen::Vector3d::Constant(1e-9), rng);
    ASSERT_TRUE(one.allFinite());
    ASSERT_NEAR(one.sum(), 1, 1e-12);
    Eigen::Index largest = 0;
    ASSERT_GT(one.maxCoeff(&largest), 1 - 1e-6);
    ++first[largest];
  }
  for (const double count : first) EXPECT_NEAR(count / kDraws, 1. / 3, 4 * std::sqrt(2. / 9 / kDraws));
}

}  // namespace rex::dirichlet_test
