#include "cli/methods/car_filter.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/derivative_check.h"
#include "cli/methods/filter_run.h"
#include "cli/methods/filter_statistics.h"
#include "estimation/kalman_filter.h"
#include "support/expect_error.h"

namespace rex::cli::car_filter_test {

using Kind = CarFilterKind;

CarScenario scenarioOf(Kind filter, bool rangeBearing = false) {
  return {.filter = filter, .landmarks = 6, .steps = 60, .car = {.rangeBearing = rangeBearing}};
}

TEST(CarFilter, FormsOfTheExtendedFilterAgree) {
  for (const bool rangeBearing : {false, true}) {
    const FilterRun extended = runFilter(scenarioOf(Kind::kExtended, rangeBearing), 4);
    for (const Kind form : {Kind::kInformation, Kind::kRoot}) {
      const FilterRun other = runFilter(scenarioOf(form, rangeBearing), 4);
      EXPECT_LT((extended.errors() - other.errors()).cwiseAbs().maxCoeff(), 1e-9);
      for (std::size_t t = 0; t < 60; ++t) {
        EXPECT_NEAR(extended.nees[t], other.nees[t], 1e-6 * extended.nees[t]);
        EXPECT_NEAR(extended.updates[t].nis, other.updates[t].nis, 1e-6 * extended.updates[t].nis);
      }
    }
  }
}

TEST(CarFilter, SightingsHaveTheirDerivatives) {
  for (const bool rangeBearing : {false, true}) {
    const CarSimulator car(3, 5, {.rangeBearing = rangeBearing});
    const NonlinearModel model = sightingModel(car, {4, 1});
    Rng rng(5);
    for (const double size : {0., 1e-8, 1.}) {
      const Eigen::VectorXd x = size * rng.normalVector(3);
      const JacobianCheck check = checkJacobian(model.g, model.jacobian(x), x, 1e-7);
      EXPECT_TRUE(check.ok) << check.message;
      const Eigen::VectorXd all = car.getMeanObservationAtState(x);
      EXPECT_LT((model.g(x) - all({8, 9, 2, 3})).norm(), 1e-12);
    }
  }
  const CarSimulator car(3, 2, {.observationNoise = 2, .rangeBearing = true, .bearingNoise = 0.1});
  const NonlinearModel model = sightingModel(car, {0, 1});
  EXPECT_TRUE(model.W.isApprox(Eigen::Vector4d(4, 0.01, 4, 0.01).asDiagonal().toDenseMatrix()));
  EXPECT_NEAR(difference(model, Eigen::Vector4d(1, 3, 0, 0), Eigen::Vector4d(0, -3, 0, 0))[1], 6 - 2 * M_PI,
              1e-12);
}

TEST(CarFilter, LocalisesBetterThanDeadReckoning) {
  for (const Kind kind : {Kind::kExtended, Kind::kUnscented, Kind::kSmoother, Kind::kParticles,
                          Kind::kEkfSlam, Kind::kFastSlam2}) {
    FilterStatisticsBuilder builder;
    CarScenario scenario = scenarioOf(kind);
    scenario.steps = 120;
    for (std::uint64_t seed = 0; seed < 4; ++seed) builder.add(runFilter(scenario, seed));
    const FilterStatistics all = builder.statistics();
    EXPECT_LT(all.position, 0.8 * all.deadReckoning) << static_cast<int>(kind);
    EXPECT_EQ(all.foundLandmarks, makesMap(kind) ? 24 : 0);
    EXPECT_EQ(all.singular, 0);
  }
}

TEST(CarFilter, SmoothingHelpsAllButTheLastStep) {
  const FilterRun filtered = runFilter(scenarioOf(Kind::kExtended), 2);
  const FilterRun smoothed = runFilter(scenarioOf(Kind::kSmoother), 2);
  EXPECT_EQ(filtered.poses.back().mean, smoothed.poses.back().mean);
  for (std::size_t t = 0; t + 1 < 60; ++t)
    EXPECT_LT(smoothed.poses[t].covariance.trace(), filtered.poses[t].covariance.trace());
}

TEST(CarFilter, SlamThatSeesNothingIsDeadReckoning) {
  for (const Kind kind : {Kind::kExtended, Kind::kEkfSlam}) {
    CarScenario scenario = scenarioOf(kind);
    scenario.car.maxRange = 1e-3;
    const FilterRun blind = runFilter(scenario, 1);
    EXPECT_LT((blind.errors() - (blind.deadReckoning - blind.truth)).cwiseAbs().maxCoeff(), 1e-9);
    EXPECT_TRUE(blind.map.empty());
    EXPECT_EQ(blind.updates.back().degrees, 0);
  }
}

TEST(CarFilter, AnExtendedFilterIsConsistentAndOneThatBelievesTooMuchIsNot) {
  const auto statisticsOf = [](double assumeObservation) {
    CarScenario scenario = scenarioOf(Kind::kExtended);
    scenario.assumeObservation = assumeObservation;
    FilterStatisticsBuilder builder;
    for (std::uint64_t seed = 0; seed < 50; ++seed) builder.add(runFilter(scenario, seed));
    return builder.statistics();
  };
  const FilterStatistics good = statisticsOf(1);
  EXPECT_NEAR(good.nees.value(), 3, 0.4);
  EXPECT_GT(good.insideBand, 0.85);
  EXPECT_EQ(good.innovations, 50 * 60 * 12);
  EXPECT_GT(good.nis, good.nisBand.lower);
  EXPECT_LT(good.nis, good.nisBand.upper);
  const FilterStatistics bad = statisticsOf(0.25);
  EXPECT_GT(bad.nees.value(), 6);
  EXPECT_LT(bad.insideBand, 0.2);
  EXPECT_GT(bad.nis, bad.nisBand.upper);
}

TEST(FilterStatistics, AddUp) {
  FilterRun run{.seed = 7};
  run.truth.setZero(3, 2);
  run.deadReckoning = (Eigen::Matrix3Xd(3, 2) << 0, 6, 0, 8, 0, 0).finished();
  run.poses = {{Eigen::Vector3d(3, 4, 0), Eigen::Matrix3d::Identity()},
               {Eigen::Vector3d(0, 0, 2 * M_PI - 0.2), Eigen::Matrix3d::Identity()}};
  run.nees = {2, std::numeric_limits<double>::infinity()};
  run.updates = {{.nis = 6, .degrees = 2}, {}};
  run.seen = {{0}, {}};
  run.landmarks = Eigen::Vector2d(1, 1);
  run.map = {{0, {Eigen::Vector2d(1, 3), Eigen::Matrix2d::Identity()}}};
  FilterStatisticsBuilder builder;
  builder.add(run);
  const FilterStatistics all = builder.statistics();
  EXPECT_NEAR(all.position, 5 / std::sqrt(2), 1e-12);
  EXPECT_NEAR(all.heading, 0.2 / std::sqrt(2), 1e-12) << "the shorter way round";
  EXPECT_NEAR(all.deadReckoning, 10 / std::sqrt(2), 1e-12);
  EXPECT_EQ(all.map, 2);
  EXPECT_EQ(all.nees, 2);
  EXPECT_EQ(all.nis, 3);
  EXPECT_EQ(all.innovations, 2);
  EXPECT_EQ(all.singular, 1);
  EXPECT_EQ(all.insideBand, 0.5);
  EXPECT_EQ(all.runs.at(0).seed, 7u);
}

TEST(CarFilter, SaysWhereItCannotGoOn) {
  CarScenario scenario = scenarioOf(Kind::kInformation);
  scenario.car.dynamicsNoise = 0;
  EXPECT_REX_ERROR(runFilter(scenario, 3), "seed 3, step 1: ");
}

}  // namespace rex::cli::car_filter_test
