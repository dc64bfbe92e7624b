#include <cmath>
#include <limits>

#include <Eigen/LU>
#include <gtest/gtest.h>

#include "base/derivative_check.h"
#include "control/riccati.h"
#include "learning/lq_task.h"
#include "learning/policy_search.h"
#include "support/expect_error.h"

namespace rex::policy_gradient_test {

const Eigen::Vector2d kBeta(-.3, -.2);
const Eigen::Matrix2d kSigma{{.04, .01}, {.01, .09}};

double cosine(const Eigen::VectorXd& a, const Eigen::VectorXd& b) { return a.dot(b) / a.norm() / b.norm(); }

// The exact gradient against differences of the exact return, and that return against Lyapunov's equation.
TEST(PolicyGradient, TheReferenceIsRight) {
  LqTask task;
  for (const double size : {0., 1e-8, 1.}) {
    const Eigen::Vector2d beta = size * kBeta;
    const auto value = [&](const Eigen::VectorXd& b) {
      return Eigen::VectorXd::Constant(1, task.expectedReturn(b, kSigma));
    };
    const JacobianCheck check = checkJacobian(value, task.gradient(beta, kSigma).transpose(), beta, 1e-8);
    EXPECT_TRUE(check.ok) << check.message;
  }
  task.horizon = 2000;
  task.W.setZero();
  const Eigen::Matrix2d closed = std::sqrt(task.discount) * (task.A + task.B * kBeta.transpose());
  const Eigen::Matrix2d P = solveDiscreteLyapunov(closed, task.Q + task.R * kBeta * kBeta.transpose());
  const Eigen::Matrix2d start = task.start + task.mean * task.mean.transpose();
  EXPECT_NEAR(task.expectedReturn(kBeta, Eigen::Matrix2d::Zero()), -(P * start).trace(), 1e-10);
}

TEST(PolicyGradient, IsThatOfTheLqTask) {
  const LqTask task;
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    Rng rng(seed);
    const LinearGaussianPolicy policy{kBeta, kSigma};
    const std::vector<Episode> episodes = task.rollouts()(policy, 20000, rng);
    const Eigen::Vector2d exact = task.gradient(kBeta, kSigma);
    for (const Baseline baseline : {Baseline::kNone, Baseline::kOptimal}) {
      const PolicyGradient found = reinforceGradient(policy, episodes, task.discount, baseline);
      EXPECT_GT(cosine(found.gradient, exact), .99);
      for (int i = 0; i < 2; ++i) EXPECT_NEAR(found.gradient[i], exact[i], 4.5 * found.standardError[i]);
    }
    EXPECT_NEAR(meanReturn(episodes, task.discount), task.expectedReturn(kBeta, kSigma), .3);
  }
}

TEST(PolicyGradient, TheBaselineLessensTheVariance) {
  LqTask task;
  task.bonus = 5;  // the same for all: no information, but noise without a baseline
  Rng rng(4);
  const LinearGaussianPolicy policy{kBeta, kSigma};
  const std::vector<Episode> episodes = task.rollouts()(policy, 2000, rng);
  const PolicyGradient plain = reinforceGradient(policy, episodes, task.discount, Baseline::kNone);
  const PolicyGradient best = reinforceGradient(policy, episodes, task.discount);
  EXPECT_LT(best.standardError.maxCoeff(), .3 * plain.standardError.minCoeff());
}

// Of an episode of one step with known returns, by hand, and as the gradient of the density.
TEST(PolicyGradient, LogGradientsAreThoseOfTheDensity) {
  Rng rng(5);
  const LinearGaussianPolicy policy{rng.normalVector(2), kSigma};
  Episode episode{Eigen::MatrixXd::Zero(2, 3), Eigen::MatrixXd::Zero(2, 3), Eigen::Vector3d::Ones()};
  episode.features.leftCols(2) = Eigen::Matrix2d{{1, 1e-8}, {2, -3}};
  for (int t = 0; t < 3; ++t) episode.noise.col(t) = rng.normalVector(2);
  const Eigen::MatrixXd found = logGradients(policy, episode);
  for (int t = 0; t < 2; ++t) {
    const Eigen::Vector2d phi = episode.features.col(t);
    const double action = phi.dot(policy.beta + episode.noise.col(t)), variance = phi.dot(kSigma * phi);
    const auto logDensity = [&](const Eigen::VectorXd& beta) {
      return Eigen::VectorXd::Constant(1, -.5 * std::pow(action - phi.dot(beta), 2) / variance);
    };
    const JacobianCheck check = checkJacobian(logDensity, found.col(t).transpose(), policy.beta, 1e-7);
    EXPECT_TRUE(check.ok) << check.message;
  }
  EXPECT_EQ(found.col(2), Eigen::Vector2d::Zero());  // no features, no noise
}

TEST(PolicyGradient, OneEpisodeHasNoBaseline) {
  const LinearGaussianPolicy policy{Eigen::VectorXd::Zero(1), Eigen::MatrixXd::Constant(1, 1, 4)};
  const Episode episode{Eigen::MatrixXd::Constant(1, 2, 1), Eigen::RowVector2d(3, -1), Eigen::Vector2d(2, 5)};
  const PolicyGradient found = reinforceGradient(policy, {episode}, .5);
  EXPECT_NEAR(found.gradient[0], 3. / 4 * (2 + .5 * 5) + .5 * (-1. / 4) * 5, 1e-15);
  EXPECT_EQ(found.standardError[0], 0);
}

// Episodes that were cut are only worth what they saw.
TEST(PolicyGradient, TakesEpisodesOfDifferentLength) {
  const LinearGaussianPolicy policy{Eigen::VectorXd::Zero(1), Eigen::MatrixXd::Constant(1, 1, 1)};
  const auto episode = [](std::vector<double> noise, std::vector<double> rewards) {
    const auto T = static_cast<Eigen::Index>(noise.size());
    return Episode{Eigen::MatrixXd::Ones(1, T), Eigen::Map<Eigen::RowVectorXd>(noise.data(), T),
                   Eigen::Map<Eigen::VectorXd>(rewards.data(), T)};
  };
  const PolicyGradient found = reinforceGradient(policy, {episode({1, 2}, {3, 4}), episode({-1}, {5})}, 1);
  // Baselines: 5 and 7 of the other episode at the first step, none at the second.
  EXPECT_NEAR(found.gradient[0], ((7 - 5) * 1 + 2 * 4 + (5 - 7) * -1) / 2., 1e-15);
  EXPECT_NEAR(found.standardError[0], 4, 1e-14);  // of 10 and 2
}

TEST(PolicyGradient, NaturalGradientsAreThoseOfTheLqTask) {
  LqTask task;
  task.W.setZero();
  Rng rng(6);
  const LinearGaussianPolicy policy{kBeta, kSigma};
  const std::vector<Episode> episodes = task.rollouts()(policy, 20000, rng);
  const NaturalGradient found = naturalGradient(policy, episodes, task.discount);
  EXPECT_EQ(found.rank, 2);
  EXPECT_LT((found.fisher * found.w - found.gradient).norm(), 1e-10 * found.gradient.norm());
  // F = E sum phi phi^T / (phi^T Sigma phi), because the noise was drawn with Sigma.
  Eigen::Matrix2d F = Eigen::Matrix2d::Zero();
  for (const Episode& episode : episodes)
    for (int t = 0; t < task.horizon; ++t) {
      const Eigen::Vector2d phi = episode.features.col(t);
      F += std::pow(task.discount, t) * phi * phi.transpose() / phi.dot(kSigma * phi) / 20000.;
    }
  EXPECT_LT((found.fisher - F).norm(), .02 * F.norm());
  const Eigen::Vector2d exact = F.inverse() * task.gradient(kBeta, kSigma);
  EXPECT_GT(cosine(found.w, exact), .99);
  const NaturalGradient episodic = episodicNaturalGradient(policy, episodes, task.discount);
  EXPECT_EQ(episodic.rank, 2);
  EXPECT_GT(cosine(episodic.gradient, task.gradient(kBeta, kSigma)), .9);
}

// Without discount the sums of whole episodes tell the natural gradient itself.
TEST(PolicyGradient, EpisodicNaturalGradientsAreThoseOfTheLqTask) {
  LqTask task;
  task.discount = 1;
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    Rng rng(seed);
    const LinearGaussianPolicy policy{kBeta, kSigma};
    const NaturalGradient found = episodicNaturalGradient(policy, task.rollouts()(policy, 20000, rng), 1);
    const Eigen::Vector2d exact = task.gradient(kBeta, kSigma);
    EXPECT_GT(cosine(found.gradient, exact), .99);
    EXPECT_GT(cosine(found.w, found.fisher.inverse() * exact), .99);
    EXPECT_NEAR(found.gradient.norm() / exact.norm(), 1, .1);
  }
}

// Other features that say the same are other parameters of the same policy, and natural gradients do not
// mind. A baseline for each parameter minds mixtures, but not units.
TEST(PolicyGradient, NaturalGradientsDoNotMindUnits) {
  const LqTask task;
  Rng rng(7);
  const LinearGaussianPolicy policy{kBeta, kSigma};
  const std::vector<Episode> episodes = task.rollouts()(policy, 100, rng);
  const auto misfit = [&](const Eigen::Matrix2d& S, const auto& natural) {
    const Eigen::Matrix2d inverse = S.inverse();
    std::vector<Episode> scaled = episodes;
    for (Episode& episode : scaled) {
      episode.features = S * episode.features;
      episode.noise = inverse.transpose() * episode.noise;
    }
    const LinearGaussianPolicy same{inverse.transpose() * kBeta, inverse.transpose() * kSigma * inverse};
    const Eigen::VectorXd w = natural(policy, episodes, .9).w;
    return (S.transpose() * natural(same, scaled, .9).w - w).norm() / w.norm();
  };
  EXPECT_LT(misfit(Eigen::Matrix2d{{1e-7, 0}, {0, 2e5}}, naturalGradient), 1e-9);
  EXPECT_LT(misfit(Eigen::Matrix2d{{.1, 0}, {3, 20}}, episodicNaturalGradient), 1e-9);
  EXPECT_LT(misfit(Eigen::Matrix2d{{1e-7, 0}, {0, 2e5}}, episodicNaturalGradient), 1e-9);
}

TEST(PolicyGradient, LeavesWhatTheNoiseDoesNotShow) {
  Rng rng(8);
  const LqTask task;
  LinearGaussianPolicy policy{kBeta, kSigma};
  std::vector<Episode> episodes = task.rollouts()(policy, 100, rng);
  for (Episode& episode : episodes) episode.features.row(1) = 2 * episode.features.row(0);
  for (const auto& natural : {naturalGradient, episodicNaturalGradient}) {
    const NaturalGradient found = natural(policy, episodes, .9);
    EXPECT_EQ(found.rank, 1);
    EXPECT_TRUE(found.w.allFinite());
    EXPECT_GT(found.w.norm(), 0);
  }
}

TEST(PolicyGradient, RefusesWrongInput) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  LinearGaussianPolicy policy{kBeta, kSigma};
  EXPECT_REX_ERROR(reinforceGradient(policy, {}, .9), "episodes: found none");
  const Episode good{Eigen::MatrixXd::Ones(2, 3), Eigen::MatrixXd::Ones(2, 3), Eigen::VectorXd::Ones(3)};
  const auto refuses = [&](auto change, const char* text) {
    Episode bad = good;
    change(bad);
    EXPECT_REX_ERROR(naturalGradient(policy, {good, bad}, .9), text);
    EXPECT_REX_ERROR(episodicNaturalGradient(policy, {good, bad}, .9), text);
  };
  refuses([](Episode& e) { e.rewards.resize(0); }, "rewards of episode 1: found none");
  refuses([](Episode& e) { e.features.resize(3, 3); }, "rows of the features of episode 1");
  refuses([](Episode& e) { e.features.resize(2, 4); }, "columns of the features of episode 1");
  refuses([](Episode& e) { e.noise.resize(1, 3); }, "rows of the noise of episode 1");
  refuses([](Episode& e) { e.noise.resize(2, 2); }, "columns of the noise of episode 1");
  refuses([&](Episode& e) { e.rewards[2] = nan; }, "rewards of episode 1: number 2: found nan");
  refuses([&](Episode& e) { e.features(1, 1) = nan; },
          "features of episode 1: found entries that are not finite");
  refuses([&](Episode& e) { e.noise(1, 1) = nan; }, "noise of episode 1: found entries that are not finite");
  EXPECT_REX_ERROR(reinforceGradient(policy, {good}, 1.1), "discount: found 1.1, wanted a number in [0, 1]");
  EXPECT_REX_ERROR(episodicNaturalGradient(policy, {good}, -1), "discount: found -1");
  policy.Sigma = Eigen::Matrix2d{{1, 2}, {2, 1}};
  EXPECT_REX_ERROR(logGradients(policy, good), "Sigma of the policy: found the eigenvalue -1");
}

}  // namespace rex::policy_gradient_test
