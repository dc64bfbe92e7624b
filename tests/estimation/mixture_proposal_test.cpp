#include "estimation/mixture_proposal.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>

#include "base/rng.h"
#include "estimation/histogram_filter.h"
#include "geometry/rotation.h"
#include "support/expect_error.h"

namespace rex::mixture_proposal_test {

// A robot drives along a corridor of 10 m and measures its distance to the nearest of three posts.
struct Corridor {
  double motion = .1, sensor = .03;  // standard deviations
  double kidnapping = .02;

  double expected(double x) const { return std::min({std::abs(x - 1), std::abs(x - 4), std::abs(x - 8.5)}); }
  static double next(double x) { return x < 9 ? x + .3 : x - 8.5; }  // back to the beginning at the end
  double likelihood(double x, double y) const {
    return std::exp(-.5 * std::pow((y - expected(x)) / sensor, 2));
  }

  NonlinearModel transition() const {
    return {.g = [](const Eigen::VectorXd& x) { return Eigen::VectorXd::Constant(1, next(x[0])); },
            .W = Eigen::MatrixXd::Constant(1, 1, motion * motion)};
  }
  LogLikelihood weigh(double y) const {
    return [*this, y](const MatrixArg& X, Eigen::Ref<Eigen::VectorXd> logWeights) {
      for (Eigen::Index i = 0; i < X.cols(); ++i)
        logWeights[i] -= .5 * std::pow((y - expected(X(0, i))) / sensor, 2);
    };
  }
  // From -1 to 11 m, so that nothing leaves the grid.
  static StateGrid grid(int cells) {
    return {.lower = Eigen::VectorXd::Constant(1, -1),
            .size = Eigen::VectorXd::Constant(1, 12. / cells),
            .counts = Eigen::VectorXi::Constant(1, cells)};
  }
  Eigen::VectorXd likelihoods(const StateGrid& cells, double y) const {
    Eigen::VectorXd result(cells.cells());
    for (int i = 0; i < cells.cells(); ++i) result[i] = likelihood(cells.center(i)[0], y);
    return result;
  }
  MotionSampler propose(const Particles& belief, double y, double share) const {
    // Rough on purpose: cells of 10 cm, and a floor.
    const StateGrid cells = grid(120);
    const Eigen::VectorXd exact = likelihoods(cells, y);
    Eigen::VectorXd rough = exact.array() + 1e-3;
    rough.tail(119) += .3 * exact.head(119);
    const StateDensity uniform = gridDensity(grid(1), Eigen::VectorXd::Ones(1));
    return mixtureProposal(transition(), belief, gridDensity(cells, rough),
                           {.share = share, .kidnapping = kidnapping, .anywhere = uniform});
  }
  // The same motion on fine cells.
  CellTransition fine(int cells) const {
    const StateGrid all = grid(cells);
    Eigen::MatrixXd P(cells, cells);
    for (int j = 0; j < cells; ++j) {
      for (int i = 0; i < cells; ++i)
        P(i, j) = std::exp(-.5 * std::pow((all.center(i)[0] - next(all.center(j)[0])) / motion, 2));
      P.col(j) *= (1 - kidnapping) / P.col(j).sum();
      P.col(j).array() += kidnapping / cells;
    }
    return P.sparseView();
  }
};

Particles uniformParticles(int count, Rng& rng) {
  return {rng.uniformVector(count, -1, 11).transpose(), Eigen::VectorXd::Constant(count, 1. / count)};
}

// Probabilities of 24 pieces of half a metre.
Eigen::VectorXd pieces(const Particles& particles) {
  Eigen::VectorXd sums = Eigen::VectorXd::Zero(24);
  for (Eigen::Index i = 0; i < particles.weights.size(); ++i)
    sums[std::clamp(static_cast<int>(2 * (particles.states(0, i) + 1)), 0, 23)] += particles.weights[i];
  return sums;
}
Eigen::VectorXd pieces(const Eigen::VectorXd& cells) {
  return cells.reshaped(cells.size() / 24, 24).colwise().sum().transpose();
}

// The same posterior as a filter on 600 cells at each of 15 steps, whatever the share and with unequal
// weights.
TEST(MixtureProposal, EstimatesThePosteriorOfAFineHistogram) {
  const Corridor world{.sensor = .1};
  const int cells = 600;
  const CellTransition transition = world.fine(cells);
  for (const auto& [share, threshold] : {std::pair{.05, 1.}, {.3, 1.}, {.3, .3}, {.9, 1.}}) {
    Rng rng(21);
    Eigen::VectorXd belief = Eigen::VectorXd::Constant(cells, 1. / cells);
    ParticleFilter filter(uniformParticles(1500, rng),
                          {.resampling = Resampling::kSystematic, .threshold = threshold});
    double x = 2, apart = 0, evidence = 0;
    for (int t = 0; t < 15; ++t) {
      x = Corridor::next(x) + world.motion * rng.normal();
      const double y = world.expected(x) + world.sensor * rng.normal();
      const CellUpdate update =
          updateCells(predictCells(belief, transition), world.likelihoods(Corridor::grid(cells), y));
      belief = update.belief;
      const ParticleStep step = filter.step(world.propose(filter.particles(), y, share), world.weigh(y), rng);
      apart = std::max(apart, .5 * (pieces(belief) - pieces(filter.particles())).cwiseAbs().sum());
      evidence += step.logEvidence - std::log(update.evidence);
    }
    EXPECT_LT(apart, .1) << "share " << share;
    EXPECT_NEAR(evidence, 0, .2) << "share " << share;
  }
}

// With few particles the evidence of one step is right on average: the weights are those of importance
// sampling.
TEST(MixtureProposal, IsUnbiased) {
  const Corridor world;
  const int cells = 1200, runs = 3000;
  Rng rng(22);
  const Particles belief{Eigen::RowVector3d(2, 2.2, 7), Eigen::Vector3d(.5, .2, .3)};
  const double y = 1.2;
  // The prediction from these three particles, by cells.
  const StateGrid fine = Corridor::grid(cells);
  double truth = 0;
  for (int i = 0; i < cells; ++i) {
    const double x = fine.center(i)[0];
    double p = world.kidnapping / 12;
    for (int k = 0; k < 3; ++k)
      p += (1 - world.kidnapping) * belief.weights[k] / world.motion / std::sqrt(2 * std::numbers::pi) *
           std::exp(-.5 * std::pow((x - Corridor::next(belief.states(0, k))) / world.motion, 2));
    truth += p * world.likelihood(x, y) * 12 / cells;
  }
  for (const double threshold : {0., 1.}) {
    double sum = 0, squares = 0;
    for (int run = 0; run < runs; ++run) {
      ParticleFilter filter(belief, {.resampling = Resampling::kMultinomial, .threshold = threshold});
      const double one = std::exp(filter.step(world.propose(belief, y, .4), world.weigh(y), rng).logEvidence);
      sum += one / runs;
      squares += one * one / runs;
    }
    EXPECT_NEAR(sum, truth, 3.5 * std::sqrt((squares - sum * sum) / runs));
  }
}

// Kidnapped, with a sensor so good that few particles happen to be where it fits: those drawn from the
// observation find the robot again, while 60 drawn from the same motion do not.
TEST(MixtureProposal, FindsAKidnappedRobot) {
  const Corridor world{.motion = .03, .sensor = .01, .kidnapping = .001};
  int found[2] = {0, 0};
  const int seeds = 20;
  for (std::uint64_t seed = 0; seed < seeds; ++seed)
    for (const bool mixes : {false, true}) {
      Rng rng(seed);
      Particles start{Eigen::RowVectorXd::Constant(60, 1.5), Eigen::VectorXd::Constant(60, 1 / 60.)};
      ParticleFilter filter(start, {.resampling = Resampling::kSystematic});
      double x = 1.5;
      for (int t = 0; t < 20; ++t) {
        x = t == 8 ? 6.2 : Corridor::next(x) + world.motion * rng.normal();
        const double y = world.expected(x) + world.sensor * rng.normal();
        (void)filter.step(world.propose(filter.particles(), y, mixes ? .2 : 0), world.weigh(y), rng);
      }
      found[mixes] += std::abs(sampleMoments(filter.particles()).mean[0] - x) < .1;
    }
  EXPECT_LE(found[0], seeds / 4);
  EXPECT_GE(found[1], seeds - 1);
}

TEST(MixtureProposal, WrapsAngles) {
  const NonlinearModel rest{.g = [](const Eigen::VectorXd& x) { return x; },
                            .W = Eigen::MatrixXd::Constant(1, 1, .01)};
  const Particles belief{Eigen::RowVectorXd::Constant(1, 3.1), Eigen::VectorXd::Ones(1)};
  const StateGrid circle{.lower = Eigen::VectorXd::Constant(1, -3),
                         .size = Eigen::VectorXd::Constant(1, std::numbers::pi / 8),
                         .counts = Eigen::VectorXi::Constant(1, 16),
                         .angles = {0}};
  const StateDensity anywhere = gridDensity(circle, Eigen::VectorXd::Ones(16));
  EXPECT_NEAR(anywhere.logDensity(Eigen::VectorXd::Constant(1, 40)), -std::log(2 * std::numbers::pi), 1e-12);
  Rng rng(23);
  double sum = 0;
  for (int i = 0; i < 500; ++i) {
    Eigen::MatrixXd X = belief.states;
    Eigen::VectorXd logWeights = Eigen::VectorXd::Zero(1);
    mixtureProposal(rest, belief, anywhere, {.share = .5, .angles = {0}})(X, logWeights, rng);
    if (std::abs(wrapAngle(X(0, 0) - 3.1)) < .5) {
      EXPECT_TRUE(std::isfinite(logWeights[0])) << X(0, 0);
    } else {
      EXPECT_LT(logWeights[0], -5);
    }
    sum += std::exp(logWeights[0]) / 500;
  }
  EXPECT_NEAR(sum, 1, .15);
}

TEST(StateGrid, NumbersItsCells) {
  const StateGrid grid{
      .lower = Eigen::Vector2d(-1, 2), .size = Eigen::Vector2d(.5, .25), .counts = Eigen::Vector2i(4, 3)};
  for (int cell = 0; cell < 12; ++cell) EXPECT_EQ(grid.cellOf(grid.center(cell)), cell);
  EXPECT_EQ(grid.cellOf(Eigen::Vector2d(-1.01, 2.1)), -1);
  EXPECT_EQ(grid.cellOf(Eigen::Vector2d(0, 2.76)), -1);
  EXPECT_EQ(grid.cellOf(Eigen::Vector2d(0, std::nan(""))), -1);
  Eigen::VectorXd weights = Eigen::VectorXd::Zero(12);
  weights[5] = 3;
  weights[6] = 1;
  const StateDensity density = gridDensity(grid, weights);
  Rng rng(24);
  int fives = 0;
  for (int i = 0; i < 1000; ++i) {
    const int cell = grid.cellOf(density.draw(rng));
    EXPECT_TRUE(cell == 5 || cell == 6);
    fives += cell == 5;
  }
  EXPECT_NEAR(fives, 750, 50);
  EXPECT_NEAR(std::exp(density.logDensity(grid.center(5))), .75 / .125, 1e-12);
  EXPECT_EQ(density.logDensity(grid.center(0)), -std::numeric_limits<double>::infinity());
  EXPECT_EQ(density.logDensity(Eigen::Vector2d(9, 9)), -std::numeric_limits<double>::infinity());
}

TEST(MixtureProposal, SaysWhatIsWrong) {
  const NonlinearModel rest{.g = [](const Eigen::VectorXd& x) { return x; },
                            .W = Eigen::MatrixXd::Ones(1, 1)};
  const Particles belief{Eigen::RowVectorXd::Zero(2), Eigen::Vector2d(.5, .5)};
  const StateDensity good = gridDensity(Corridor::grid(3), Eigen::Vector3d::Ones());
  const auto make = [&](MixtureProposalOptions options) {
    return mixtureProposal(rest, belief, good, options);
  };
  EXPECT_REX_ERROR(mixtureProposal({}, belief, good), "transition: found no function g");
  EXPECT_REX_ERROR(mixtureProposal({.g = rest.g, .W = Eigen::MatrixXd::Zero(1, 1)}, belief, good),
                   "transition: covariance of the noise");
  EXPECT_REX_ERROR(mixtureProposal(rest, {belief.states, Eigen::Vector3d::Ones()}, good),
                   "weights of the belief: found a vector of size 3, wanted size 2");
  EXPECT_REX_ERROR(mixtureProposal(rest, {belief.states, Eigen::Vector2d(1, -1)}, good), "weight");
  EXPECT_REX_ERROR(mixtureProposal(rest, belief, {}), "density of the observation: found no function draw");
  EXPECT_REX_ERROR(mixtureProposal(rest, belief, {.draw = good.draw}), "found no function logDensity");
  EXPECT_REX_ERROR(make({.share = 1}), "share from the observation: found 1, wanted 0 to 1, less than 1");
  EXPECT_REX_ERROR(make({.kidnapping = 2}), "probability of kidnapping: found 2, wanted 0 to 1");
  EXPECT_REX_ERROR(make({.kidnapping = .1}), "density of kidnapping: found no function draw");
  EXPECT_REX_ERROR(make({.angles = {1}}), "angle of a state: found entry 1, wanted 0 to 0");
  EXPECT_REX_ERROR(
      mixtureProposal(
          {.g = [](const Eigen::VectorXd&) { return Eigen::VectorXd::Zero(2).eval(); }, .W = rest.W}, belief,
          good),
      "next state: found a vector of size 2, wanted size 1");
  StateGrid grid = Corridor::grid(3);
  EXPECT_REX_ERROR(gridDensity(grid, Eigen::Vector2d::Ones()),
                   "weights of the cells: found a vector of size 2");
  EXPECT_REX_ERROR(gridDensity(grid, Eigen::Vector3d::Zero()), "weights");
  grid.counts[0] = 0;
  EXPECT_REX_ERROR(gridDensity(grid, Eigen::Vector3d::Ones()), "cells along 0: found 0, wanted at least 1");
  grid.size[0] = 0;
  EXPECT_REX_ERROR(gridDensity(grid, Eigen::Vector3d::Ones()), "size 0 of the cells: found 0");
  grid.lower[0] = INFINITY;
  EXPECT_REX_ERROR(gridDensity(grid, Eigen::Vector3d::Ones()),
                   "lower corner of the grid: number 0: found inf");
  grid.size.resize(2);
  EXPECT_REX_ERROR(gridDensity(grid, Eigen::Vector3d::Ones()),
                   "sizes of the cells: found a vector of size 2");
}

}  // namespace rex::mixture_proposal_test
