#include "estimation/particle_filter.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "base/rng.h"
#include "estimation/kalman_filter.h"
#include "random_gaussian.h"
#include "support/expect_error.h"

namespace rex::particle_filter_test {

NonlinearModel asFunction(const LinearModel& model) {
  return {.g = [=](const Eigen::VectorXd& x) -> Eigen::VectorXd { return model.C * x + model.c; },
          .jacobian = [=](const Eigen::VectorXd&) { return model.C; },
          .W = model.W};
}

// A plane walk with a known answer.
struct Walk {
  Gaussian prior{Eigen::Vector2d(0, 0), Eigen::Matrix2d::Identity()};
  LinearModel move{.9 * Eigen::Matrix2d::Identity(), Eigen::Vector2d(.1, -.1),
                   .1 * Eigen::Matrix2d::Identity()};
  LinearModel see{Eigen::RowVector2d(1, .5), Eigen::VectorXd::Zero(1), Eigen::MatrixXd::Constant(1, 1, .2)};
  std::vector<Eigen::VectorXd> y;
  explicit Walk(Rng& rng) {
    Eigen::VectorXd x = sample(prior, rng);
    for (int t = 0; t < 10; ++t) {
      x = move.C * x + sample({move.c, move.W}, rng);
      y.push_back(see.C * x + sample({see.c, see.W}, rng));
    }
  }
};

struct Answer {
  Gaussian belief;
  double logEvidence = 0;
};

Answer exactly(const Walk& walk) {
  Answer answer{walk.prior};
  for (const Eigen::VectorXd& y : walk.y) {
    const KalmanUpdate update = kalmanUpdate(kalmanPredict(answer.belief, walk.move), walk.see, y);
    answer.belief = update.belief;
    answer.logEvidence += update.logLikelihood;
  }
  return answer;
}

Answer byParticles(const Walk& walk, int count, bool looksAhead, const ParticleFilterOptions& options,
                   Rng& rng) {
  ParticleFilter filter(sampledParticles(walk.prior, count, rng), options);
  const NonlinearModel move = asFunction(walk.move), see = asFunction(walk.see);
  Answer answer;
  for (const Eigen::VectorXd& y : walk.y) {
    const MotionSampler propose = looksAhead ? observedProposal(move, see, y) : motionProposal(move);
    answer.logEvidence += filter.step(propose, observationWeights(see, y), rng).logEvidence;
  }
  // Weights leave out the constant of the density.
  answer.logEvidence -= double(walk.y.size()) * .5 * std::log(2 * M_PI * walk.see.W(0, 0));
  answer.belief = sampleMoments(filter.particles());
  return answer;
}

TEST(ParticleFilter, ComesToTheKalmanFilter) {
  Rng rng(31);
  const Walk walk(rng);
  const Answer exact = exactly(walk);
  for (const bool looksAhead : {false, true}) {
    for (const double threshold : {1., .5}) {
      const Answer found = byParticles(walk, 40000, looksAhead, {.threshold = threshold}, rng);
      EXPECT_LT((found.belief.mean - exact.belief.mean).norm(), .03);
      EXPECT_LT((found.belief.covariance - exact.belief.covariance).norm(), .03);
      EXPECT_NEAR(found.logEvidence, exact.logEvidence, .1);
    }
  }
}

// Slide 6:30: the error of a mean falls with the root of the count.
TEST(ParticleFilter, ErrorFallsWithTheRootOfTheCount) {
  Rng rng(32);
  const Walk walk(rng);
  const Eigen::VectorXd mean = exactly(walk).belief.mean;
  const auto error = [&](int count) {
    double square = 0;
    for (int run = 0; run < 60; ++run)
      square += (byParticles(walk, count, false, {}, rng).belief.mean - mean).squaredNorm() / 60;
    return std::sqrt(square);
  };
  const double slope = std::log(error(100) / error(1600)) / std::log(16);
  EXPECT_NEAR(slope, .5, .12);
}

TEST(ParticleFilter, LookingAheadKeepsMoreParticlesAlive) {
  Rng rng(33);
  Walk walk(rng);
  walk.see.W *= 1e-4;  // a sharp sensor: few draws of the motion explain it
  const NonlinearModel move = asFunction(walk.move), see = asFunction(walk.see);
  ParticleFilter blind(sampledParticles(walk.prior, 500, rng)), seeing = blind;
  const LogLikelihood weigh = observationWeights(see, walk.y[0]);
  const double few = blind.step(motionProposal(move), weigh, rng).effectiveSize;
  const double many = seeing.step(observedProposal(move, see, walk.y[0]), weigh, rng).effectiveSize;
  EXPECT_LT(few, 20);
  EXPECT_GT(many, 4 * few);
}

TEST(ParticleFilter, AdaptsTheCount) {
  Rng rng(34);
  const Walk walk(rng);
  ParticleFilterOptions options{.cellSize = Eigen::Vector2d(.2, .2), .fewest = 30, .most = 4000};
  ParticleFilter filter(sampledParticles({walk.prior.mean, 100 * walk.prior.covariance}, 4000, rng), options);
  const NonlinearModel move = asFunction(walk.move), see = asFunction(walk.see);
  (void)filter.step(
      motionProposal(move), [](const MatrixArg&, Eigen::Ref<Eigen::VectorXd>) {}, rng);
  const Eigen::Index spread = filter.particles().weights.size();
  for (int t = 0; t < 10; ++t) {
    LinearModel both{Eigen::Matrix2d::Identity(), Eigen::Vector2d(0, 0), .01 * Eigen::Matrix2d::Identity()};
    (void)filter.step(motionProposal(move), observationWeights(asFunction(both), Eigen::Vector2d(0, 0)), rng);
  }
  EXPECT_EQ(spread, 4000);
  EXPECT_LT(filter.particles().weights.size(), 2000);
  EXPECT_GE(filter.particles().weights.size(), 30);
  EXPECT_NEAR(filter.particles().weights.sum(), 1, 1e-12);
}

TEST(ParticleFilter, SurvivesWhatNoParticleExplains) {
  Rng rng(35);
  const Walk walk(rng);
  ParticleFilter filter(sampledParticles(walk.prior, 100, rng));
  const auto impossible = [](const MatrixArg&, Eigen::Ref<Eigen::VectorXd> logWeights) {
    logWeights.setConstant(-std::numeric_limits<double>::infinity());
  };
  const ParticleStep step = filter.step(motionProposal(asFunction(walk.move)), impossible, rng);
  EXPECT_TRUE(step.lost);
  EXPECT_EQ(step.logEvidence, -std::numeric_limits<double>::infinity());
  EXPECT_NEAR(filter.particles().weights.maxCoeff(), .01, 1e-12);
  const ParticleStep next = filter.step(motionProposal(asFunction(walk.move)),
                                        observationWeights(asFunction(walk.see), walk.y[0]), rng);
  EXPECT_FALSE(next.lost);
  // Far away all densities are zero in doubles, but not their logarithms.
  const Eigen::VectorXd far = Eigen::VectorXd::Constant(1, 1e4);
  EXPECT_FALSE(
      filter.step(motionProposal(asFunction(walk.move)), observationWeights(asFunction(walk.see), far), rng)
          .lost);
}

// A proposal that rules all particles out is not an end either; and an error leaves the particles as they
// were.
TEST(ParticleFilter, SurvivesProposalsAndErrors) {
  Rng rng(38);
  const Walk walk(rng);
  const MotionSampler never = [](Eigen::Ref<Eigen::MatrixXd>, Eigen::Ref<Eigen::VectorXd> logWeights, Rng&) {
    logWeights.setConstant(-std::numeric_limits<double>::infinity());
  };
  const MotionSampler stay = [](Eigen::Ref<Eigen::MatrixXd>, Eigen::Ref<Eigen::VectorXd>, Rng&) {};
  const LogLikelihood nothing = [](const MatrixArg&, Eigen::Ref<Eigen::VectorXd>) {};
  const LogLikelihood broken = [](const MatrixArg&, Eigen::Ref<Eigen::VectorXd> logWeights) {
    logWeights[0] = std::nan("");
  };
  for (const bool isAdaptive : {false, true}) {
    ParticleFilterOptions options;
    if (isAdaptive) options = {.cellSize = Eigen::Vector2d(1, 1), .fewest = 20, .most = 100};
    ParticleFilter filter(sampledParticles(walk.prior, 400, rng), options);
    const Particles before = filter.particles();
    EXPECT_REX_ERROR((void)filter.step(motionProposal(asFunction(walk.move)), broken, rng),
                     "log weight of particle 0");
    EXPECT_EQ(filter.particles().states, before.states);
    EXPECT_EQ(filter.particles().weights, before.weights);
    EXPECT_TRUE(filter.step(never, nothing, rng).lost);
    EXPECT_NEAR(filter.particles().weights.sum(), 1, 1e-12);
    EXPECT_FALSE(filter.step(stay, nothing, rng).lost);
  }
}

TEST(ParticleFilter, SameSeedSameParticles) {
  Rng first(36), second(36);
  const Walk walk(first), same(second);
  const Answer a = byParticles(walk, 200, false, {}, first), b = byParticles(same, 200, false, {}, second);
  EXPECT_EQ(a.belief.mean, b.belief.mean);
  EXPECT_EQ(a.logEvidence, b.logEvidence);
}

TEST(ParticleFilter, SaysWhatIsWrong) {
  Rng rng(37);
  const Walk walk(rng);
  const Particles good = sampledParticles(walk.prior, 10, rng);
  EXPECT_REX_ERROR(ParticleFilter(Particles{}), "particles: found none, wanted one or more");
  EXPECT_REX_ERROR(sampledParticles(walk.prior, 0, rng), "particles: found 0, wanted at least 1");
  EXPECT_REX_ERROR(ParticleFilter(good, {.threshold = 2}), "resampling threshold: found 2, wanted 0 to 1");
  EXPECT_REX_ERROR(ParticleFilter(good, {.fewest = 0}), "fewest particles: found 0, wanted at least 1");
  EXPECT_REX_ERROR(ParticleFilter(good, {.fewest = 5, .most = 4}), "most particles: found 4");
  EXPECT_REX_ERROR(ParticleFilter(good, {.error = 0}),
                   "error of the adaptive count: found 0, wanted a positive, finite number");
  EXPECT_REX_ERROR(ParticleFilter(good, {.error = HUGE_VAL}), "error of the adaptive count: found inf");
  EXPECT_REX_ERROR(ParticleFilter(good, {.cellSize = Eigen::Vector2d(1, -1)}),
                   "sizes of cells: number 1: found -1, wanted a finite number, 0 or more");
  EXPECT_REX_ERROR(ParticleFilter(good, {.cellSize = Eigen::Vector3d(1, 1, 1)}), "sizes of cells");
  Particles bad = good;
  bad.weights.setZero();
  EXPECT_REX_ERROR(ParticleFilter{bad}, "weights: found only zeros");
  bad = good;
  bad.states(1, 3) = std::nan("");
  EXPECT_REX_ERROR(ParticleFilter{bad}, "state of particle 3: found numbers that are not finite");
  ParticleFilter filter(good);
  const MotionSampler stay = [](Eigen::Ref<Eigen::MatrixXd>, Eigen::Ref<Eigen::VectorXd>, Rng&) {};
  EXPECT_REX_ERROR(
      filter.step(
          stay, [](const MatrixArg&, Eigen::Ref<Eigen::VectorXd> w) { w[4] = std::nan(""); }, rng),
      "log weight of particle 4: found nan, wanted a number, or minus infinity");
  NonlinearModel certain = asFunction(walk.move);
  certain.W.setZero();
  EXPECT_REX_ERROR(observedProposal(certain, asFunction(walk.see), walk.y[0]),
                   "transition: covariance of the noise: found the eigenvalue 0");
  EXPECT_REX_ERROR(motionProposal({}), "transition: found no function g");
  EXPECT_REX_ERROR(observationWeights({}, walk.y[0]), "observation model: found no function g");
}

// The third chunk of the adaptive filter begins with particle 128.
TEST(ParticleFilter, NamesTheParticleThatIsNoNumber) {
  Rng rng(31);
  const Particles start =
      sampledParticles({Eigen::VectorXd::Zero(1), Eigen::MatrixXd::Identity(1, 1)}, 400, rng);
  int chunk = 0;
  const MotionSampler propose = [&](Eigen::Ref<Eigen::MatrixXd> X, Eigen::Ref<Eigen::VectorXd>, Rng&) {
    if (chunk++ == 2) X(0, 5) = std::numeric_limits<double>::quiet_NaN();
  };
  const LogLikelihood weigh = [](const MatrixArg&, Eigen::Ref<Eigen::VectorXd>) {};
  ParticleFilter filter(start, {.cellSize = Eigen::VectorXd::Constant(1, 1e-3), .fewest = 200, .most = 300});
  EXPECT_REX_ERROR(filter.step(propose, weigh, rng),
                   "state of particle 133: found numbers that are not finite");
  EXPECT_EQ(filter.particles().states, start.states);
}

// Finer cells never need fewer particles, even where their numbers are beyond all integers.
TEST(ParticleFilter, CountsCellsFarAway) {
  Rng rng(32);
  Particles start{Eigen::MatrixXd(1, 400), Eigen::VectorXd::Constant(400, 1. / 400)};
  for (double& x : start.states.reshaped()) x = rng.uniform(-1e20, 1e20);
  const MotionSampler propose = [](Eigen::Ref<Eigen::MatrixXd>, Eigen::Ref<Eigen::VectorXd>, Rng&) {};
  const LogLikelihood weigh = [](const MatrixArg&, Eigen::Ref<Eigen::VectorXd>) {};
  ParticleFilter filter(start, {.cellSize = Eigen::VectorXd::Constant(1, 1e-3), .most = 4000});
  (void)filter.step(propose, weigh, rng);
  EXPECT_GT(filter.particles().states.cols(), 2000);
}

}  // namespace rex::particle_filter_test
