#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include <Eigen/LU>
#include <gtest/gtest.h>

#include "estimation/fast_slam_unknown_association.h"
#include "slam_world.h"
#include "support/expect_error.h"

namespace rex::unnamed_fast_slam_test {

using Kind = LandmarkSensor::Kind;

bool seesAll(const Eigen::Vector3d&, const Eigen::Vector2d&) { return true; }

// Three pairs of landmarks around the car, with a gap of `gap` metres in each pair.
test::SlamWorld pairs(Kind kind, double gap, Rng& rng) {
  test::SlamWorld world(kind, 0, rng);
  for (int i = 0; i < 3; ++i) {
    const double angle = 2 * std::numbers::pi / 3 * (i + rng.uniform(-.1, .1)), way = rng.uniform(-3, 3);
    world.landmarks.emplace_back(7 * std::cos(angle), 7 * std::sin(angle));
    world.landmarks.push_back(world.landmarks.back() + gap * Eigen::Vector2d(std::cos(way), std::sin(way)));
  }
  return world;
}

struct Pair {
  FastSlam named;
  FastSlamUnknownAssociation unnamed;
};

// Both see the same and draw the same random numbers.
Pair drive(test::SlamWorld& world, bool observed, double gate, int steps, Rng& rng) {
  const Eigen::Vector3d start = Eigen::Vector3d::Zero();
  Pair run{{start, world.sensor, {.particles = 100, .observedProposal = observed}},
           {start,
            world.sensor,
            {.particles = 100, .observedProposal = observed, .gate = gate, .isInView = seesAll}}};
  Rng a = rng.split(1), b = rng.split(1);
  for (int t = 0; t < steps; ++t) {
    world.drive(rng);
    std::vector<LandmarkSighting> sightings;
    std::vector<Eigen::Vector2d> ys;
    for (std::size_t i = 0; i < world.landmarks.size(); ++i) {
      ys.push_back(world.look(i, rng));
      sightings.push_back({static_cast<int>(i), ys.back()});
    }
    (void)run.named.step(world.transition(), sightings, a);
    EXPECT_FALSE(run.unnamed.step(world.transition(), ys, b).lost);
  }
  return run;
}

double distanceTo(const std::vector<MappedLandmark>& map, const Eigen::Vector2d& p) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const MappedLandmark& one : map) nearest = std::min(nearest, (one.position.mean - p).norm());
  return nearest;
}

// Landmarks that nobody confuses: the same particles as with names.
TEST(FastSlamUnknownAssociation, IsFastSlamWhereNothingIsAmbiguous) {
  for (const Kind kind : {Kind::kCartesian, Kind::kRangeBearing})
    for (const bool observed : {false, true}) {
      Rng rng(11);
      test::SlamWorld world = pairs(kind, 5, rng);
      const Pair run = drive(world, observed, 30, 15, rng);
      EXPECT_LT((run.named.poses() - run.unnamed.poses()).cwiseAbs().maxCoeff(), 1e-9);
      EXPECT_LT((run.named.weights() - run.unnamed.weights()).cwiseAbs().maxCoeff(), 1e-9);
      EXPECT_LT((run.named.meanPose() - run.unnamed.meanPose()).norm(), 1e-9);
      const std::vector<MappedLandmark> map = run.unnamed.map();
      ASSERT_EQ(map.size(), 6u);
      for (int i = 0; i < 6; ++i) {
        const auto& [position, probability] = map[static_cast<std::size_t>(i)];
        EXPECT_LT((run.named.landmark(i).mean - position.mean).norm(), 1e-9);
        EXPECT_LT((run.named.landmark(i).covariance - position.covariance).norm(), 1e-9);
        EXPECT_NEAR(probability, 1, 1e-12);
      }
    }
}

// Pairs 2 m apart seen with a noise of 0.5 m: observations overlap, and nearest neighbours are often wrong.
TEST(FastSlamUnknownAssociation, TellsAmbiguousLandmarksApart) {
  const int seeds = 10;
  for (const bool observed : {false, true}) {
    double named = 0, unnamed = 0, apart = 0;
    for (std::uint64_t seed = 0; seed < seeds; ++seed) {
      SCOPED_TRACE(testing::Message() << "observed " << observed << ", seed " << seed);
      Rng rng(seed);
      test::SlamWorld world = pairs(Kind::kCartesian, 2, rng);
      const Pair run = drive(world, observed, UnnamedFastSlamOptions().gate, 40, rng);
      const std::vector<MappedLandmark> map = run.unnamed.map();
      EXPECT_EQ(map.size(), 6u);
      for (int i = 0; i < 6; ++i) {
        const Eigen::Vector2d& truth = world.landmarks[static_cast<std::size_t>(i)];
        const Eigen::Vector2d mean = run.named.landmark(i).mean;
        named += (mean - truth).norm() / 6 / seeds;
        unnamed += distanceTo(map, truth) / 6 / seeds;
        apart += distanceTo(map, mean) / 6 / seeds;
        if (observed) {
          EXPECT_LT(distanceTo(map, mean), .7);
        }
      }
    }
    EXPECT_LT(unnamed, 1.15 * named);
    EXPECT_LT(apart, observed ? .1 : .25);
  }
}

TEST(FastSlamUnknownAssociation, ATightGateInventsLandmarks) {
  Rng rng(4);
  test::SlamWorld world = pairs(Kind::kCartesian, 5, rng);
  EXPECT_GT(drive(world, true, 3, 10, rng).unnamed.landmarks(0).size(), 6u);
}

// The expected likelihood of an observation y (slide 7:41) by a sum over positions of the landmark.
double integral(const LandmarkSensor& sensor, const Eigen::Vector3d& x, const Eigen::Vector2d& y,
                const LandmarkBelief& belief) {
  const auto density = [](const Eigen::Vector2d& error, const Eigen::Matrix2d& A) {
    return std::exp(-.5 * error.dot(A.inverse() * error)) /
           (2 * std::numbers::pi * std::sqrt(A.determinant()));
  };
  const double width = 6 * std::sqrt(belief.covariance.diagonal().maxCoeff()), step = width / 30;
  double sum = 0;
  for (double a = -width; a <= width; a += step)
    for (double b = -width; b <= width; b += step) {
      const Eigen::Vector2d offset(a, b);
      const Eigen::Vector2d error = innovation(sensor, y, landmarkView(sensor, x, belief.mean + offset).y);
      sum += density(error, sensor.W) * density(offset, belief.covariance) * step * step;
    }
  return sum;
}

// Particles that went different ways decide differently which landmark they see, or that it is new.
TEST(FastSlamUnknownAssociation, DecidesByTheExpectedLikelihood) {
  for (const Kind kind : {Kind::kCartesian, Kind::kRangeBearing}) {
    const bool isLinear = kind == Kind::kCartesian;
    const LandmarkSensor sensor{kind, Eigen::Vector2d(.04, isLinear ? .09 : .0004).asDiagonal()};
    const UnnamedFastSlamOptions options{.particles = 40, .threshold = 0, .gate = 9};
    FastSlamUnknownAssociation slam(Eigen::Vector3d(0, 0, .2), sensor, options);
    PoseTransition motion{.mean = [](const Eigen::Vector3d& x) { return x; }};
    Rng rng(5);
    const std::vector<Eigen::Vector2d> first = isLinear ? std::vector<Eigen::Vector2d>{{6, 0}, {6, 1.5}}
                                                        : std::vector<Eigen::Vector2d>{{6, 0}, {6, .25}};
    (void)slam.step(motion, first, rng);
    const std::vector<LandmarkBelief> before = slam.landmarks(0);
    ASSERT_EQ(before.size(), 2u);
    motion.noise = Eigen::Vector3d(.01, .01, isLinear ? .04 : .01).asDiagonal();
    const Eigen::Vector2d y = 0.5 * (first[0] + first[1]);
    (void)slam.step(motion, std::vector{y}, rng);
    const double fresh =
        std::exp(logDensity({Eigen::Vector2d::Zero(), sensor.W}, Eigen::Vector2d::Zero()) - options.gate / 2);
    Eigen::VectorXd expected(options.particles);
    std::array<int, 3> choices{};
    for (int k = 0; k < options.particles; ++k) {
      const std::array likelihoods{integral(sensor, slam.poses().col(k), y, before[0]),
                                   integral(sensor, slam.poses().col(k), y, before[1]), fresh};
      const auto best = std::ranges::max_element(likelihoods);
      expected[k] = *best;
      ++choices[static_cast<std::size_t>(best - likelihoods.begin())];
      const std::vector<LandmarkBelief> after = slam.landmarks(k);
      EXPECT_EQ(after.size(), *best == fresh ? 3u : 2u);
      for (std::size_t i : {0u, 1u})
        EXPECT_EQ(after[i].mean != before[i].mean, *best == likelihoods[i] && *best != fresh);
    }
    for (const int count : choices) EXPECT_GT(count, 1) << "all three decisions occur";
    expected /= expected.sum();
    EXPECT_LT((slam.weights() - expected).cwiseAbs().maxCoeff(),
              (isLinear ? 1e-9 : .03) * expected.maxCoeff());
  }
}

// The innovation's covariance in a joint Gaussian whose pose is known: that of Kalman SLAM.
TEST(FastSlamUnknownAssociation, UpdatesLandmarksLikeAJointGaussian) {
  for (const Kind kind : {Kind::kCartesian, Kind::kRangeBearing}) {
    Rng rng(6);
    test::SlamWorld world = pairs(kind, 4, rng);
    world.deviation = 0;
    FastSlamUnknownAssociation slam(world.x, world.sensor, {.particles = 2});
    EkfSlam kalman({world.x, Eigen::Matrix3d::Zero()}, world.sensor);
    for (int t = 0; t < 5; ++t) {
      world.drive(rng);
      kalman.predict(world.transition());
      std::vector<Eigen::Vector2d> ys;
      for (std::size_t i = 0; i < world.landmarks.size(); ++i) {
        ys.push_back(world.look(i, rng));
        (void)kalman.observe(static_cast<int>(i), ys.back());
      }
      (void)slam.step(world.transition(), ys, rng);
    }
    const std::vector<LandmarkBelief> map = slam.landmarks(1);
    ASSERT_EQ(map.size(), 6u);
    for (int i = 0; i < 6; ++i) {
      const Gaussian joint = kalman.landmark(i);
      EXPECT_LT((map[static_cast<std::size_t>(i)].mean - joint.mean).norm(), 1e-9);
      EXPECT_LT((map[static_cast<std::size_t>(i)].covariance - joint.covariance).norm(), 1e-9);
    }
  }
}

TEST(FastSlamUnknownAssociation, RemovesWhatItMissesMoreOftenThanItSees) {
  const LandmarkSensor sensor{.W = .01 * Eigen::Matrix2d::Identity()};
  const PoseTransition rest{.mean = [](const Eigen::Vector3d& x) { return x; }};
  const Eigen::Vector2d real(3, 0), ghost(0, 3), hidden(-3, 0);
  const std::vector<Eigen::Vector2d> all{real, ghost, hidden}, one{real};
  UnnamedFastSlamOptions options{.particles = 3};
  for (const bool knowsItsView : {false, true}) {
    if (knowsItsView) options.isInView = [](const auto&, const Eigen::Vector2d& at) { return at.x() > -1; };
    FastSlamUnknownAssociation slam(Eigen::Vector3d::Zero(), sensor, options);
    Rng rng(7);
    (void)slam.step(rest, all, rng);
    (void)slam.step(rest, one, rng);
    EXPECT_EQ(slam.map().size(), 3u) << "missed as often as seen";
    (void)slam.step(rest, one, rng);
    EXPECT_EQ(slam.map().size(), knowsItsView ? 2u : 3u);
    EXPECT_LT((slam.map().back().position.mean - hidden).norm(), 1e-9) << "out of view";
    EXPECT_EQ(slam.landmarks(2).size(), slam.map().size());
  }
}

TEST(FastSlamUnknownAssociation, TakesWhatNothingExplainsAsNew) {
  Rng rng(8);
  test::SlamWorld world(Kind::kCartesian, 1, rng);
  for (const bool observed : {false, true}) {
    FastSlamUnknownAssociation slam(Eigen::Vector3d::Zero(), world.sensor,
                                    {.particles = 10, .observedProposal = observed});
    for (const double far : {1., 1e200, 1.}) {
      EXPECT_FALSE(slam.step(world.transition(), std::vector{Eigen::Vector2d(far, 1)}, rng).lost);
      EXPECT_TRUE(slam.poses().allFinite() && slam.weights().allFinite());
    }
    EXPECT_EQ(slam.map().size(), 2u);
    EXPECT_EQ(slam.map(2).size(), 0u) << "no landmark is that likely";
  }
}

TEST(FastSlamUnknownAssociation, SaysWhatIsWrong) {
  Rng rng(9);
  const test::SlamWorld world(Kind::kCartesian, 1, rng);
  const Eigen::Vector3d start = Eigen::Vector3d::Zero();
  EXPECT_REX_ERROR(FastSlamUnknownAssociation(start, {}, {.particles = 0}),
                   "particles: found 0, wanted at least 1");
  EXPECT_REX_ERROR(FastSlamUnknownAssociation(start, {}, {.threshold = -1}),
                   "resampling threshold: found -1");
  EXPECT_REX_ERROR(FastSlamUnknownAssociation(start, {}, {.gate = 0}), "association gate: found 0");
  FastSlamUnknownAssociation slam(start, {.kind = Kind::kRangeBearing}, {.particles = 3});
  EXPECT_REX_ERROR(slam.step(world.transition(), std::vector{Eigen::Vector2d(1, INFINITY)}, rng),
                   "observation: number 1: found inf");
  EXPECT_REX_ERROR(slam.step({}, {}, rng), "transition: found no function for its mean");
  EXPECT_REX_ERROR(slam.step(world.transition(), std::vector{Eigen::Vector2d(-1, 0)}, rng),
                   "range of a new landmark: found -1 m");
  EXPECT_EQ(slam.poses(), Eigen::Matrix3Xd::Zero(3, 3)) << "a throw changes nothing";
  EXPECT_REX_ERROR(slam.landmarks(3), "particle: found 3, wanted 0 to 2");
}

// Against all permutations, also with equal costs.
TEST(Assignment, IsTheCheapestOfAll) {
  Rng rng(10);
  for (int round = 0; round < 200; ++round) {
    const int rows = rng.index(5), columns = rows + rng.index(3);
    Eigen::MatrixXd cost(rows, columns);
    for (double& one : cost.reshaped()) one = round % 2 == 0 ? rng.uniform(-1, 1) : rng.index(3);
    std::vector<int> order(static_cast<std::size_t>(columns));
    for (int j = 0; j < columns; ++j) order[static_cast<std::size_t>(j)] = j;
    const auto priceOf = [&](const std::vector<int>& columnOf) {
      double price = 0;
      for (int i = 0; i < rows; ++i) price += cost(i, columnOf[static_cast<std::size_t>(i)]);
      return price;
    };
    double cheapest = priceOf(order);
    while (std::ranges::next_permutation(order).found) cheapest = std::min(cheapest, priceOf(order));
    std::vector<int> found = cheapestAssignment(cost);
    ASSERT_EQ(static_cast<int>(found.size()), rows);
    EXPECT_NEAR(priceOf(found), cheapest, 1e-12);
    std::ranges::sort(found);
    EXPECT_EQ(std::ranges::adjacent_find(found), found.end());
  }
  EXPECT_REX_ERROR(cheapestAssignment(Eigen::MatrixXd::Zero(3, 2)),
                   "costs of an assignment: found 3 rows and 2 columns, wanted at least as many columns");
  EXPECT_REX_ERROR(cheapestAssignment(Eigen::MatrixXd::Constant(1, 1, INFINITY)),
                   "cost of row 0 and column 0: found inf, wanted a finite number");
}

}  // namespace rex::unnamed_fast_slam_test
