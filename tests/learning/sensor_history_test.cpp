#include "learning/sensor_history.h"

#include <cmath>
#include <complex>

#include <gtest/gtest.h>

#include "support/expect_error.h"

namespace rex::sensor_history_test {

TEST(SensorHistory, LaysItsFeaturesOut) {
  SensorHistory history({.sensors = 2,
                         .timeStep = .5,
                         .constant = true,
                         .derivatives = true,
                         .averages = {.5, .9},
                         .pastActions = 2});
  ASSERT_EQ(history.size(), 1 + 2 + 2 + 2 * 4 + 2);
  Eigen::VectorXd first(15), second(15), third(15);
  first << 1, 3, -1, 0, 0, 3, -1, 0, 0, 3, -1, 0, 0, 0, 0;
  EXPECT_EQ(history.observe(Eigen::Vector2d(3, -1)), first);
  history.act(7);
  second << 1, 4, -1, 2, 0, 3.5, -1, 1, 0, 3.1, -1, .2, 0, 7, 0;
  EXPECT_LT((history.observe(Eigen::Vector2d(4, -1)) - second).norm(), 1e-15);
  history.act(8);
  third << 1, 4, 1, 0, 4, 3.75, 0, .5, 2, 3.19, -.8, .18, .4, 8, 7;
  EXPECT_LT((history.observe(Eigen::Vector2d(4, 1)) - third).norm(), 1e-14);
  history.reset();
  EXPECT_EQ(history.observe(Eigen::Vector2d(3, -1)), first);
}

// An average that keeps a, of a sine, is what the filter (1 - a) / (1 - a z^-1) makes of it.
TEST(SensorHistory, AveragesAreFilters) {
  const double keep = .9, frequency = .2;
  SensorHistory history({.averages = {keep}});
  const std::complex<double> z = std::polar(1., frequency), gain = (1 - keep) / (1. - keep / z);
  for (int t = 0; t < 400; ++t) {
    const double average = history.observe(Eigen::VectorXd::Constant(1, std::sin(frequency * t)))[1];
    if (t <= 300) continue;
    EXPECT_NEAR(average, std::imag(gain * std::polar(1., frequency * t)), 1e-12);
  }
}

TEST(SensorHistory, IsAValue) {
  SensorHistory one({.derivatives = true});
  static_cast<void>(one.observe(Eigen::VectorXd::Zero(1)));
  SensorHistory two = one;
  EXPECT_EQ(one.observe(Eigen::VectorXd::Ones(1)), two.observe(Eigen::VectorXd::Ones(1)));
  static_cast<void>(one.observe(Eigen::VectorXd::Ones(1)));
  EXPECT_NEAR(two.observe(Eigen::VectorXd::Constant(1, 3))[1], 200, 1e-10);
}

TEST(SensorHistory, RefusesWrongInput) {
  EXPECT_REX_ERROR(SensorHistory({.sensors = 0}), "sensors: found 0, wanted at least 1");
  EXPECT_REX_ERROR(SensorHistory({.timeStep = 0}),
                   "time step: found 0 s, wanted a positive, finite number of seconds");
  EXPECT_REX_ERROR(SensorHistory({.averages = {.5, 1}}), "share that an average keeps: found 1");
  EXPECT_REX_ERROR(SensorHistory({.averages = {std::nan("")}}), "share that an average keeps: found nan");
  EXPECT_REX_ERROR(SensorHistory({.pastActions = -1}), "past actions: found -1, wanted 0 or more");
  SensorHistory history({.sensors = 2});
  EXPECT_REX_ERROR(history.observe(Eigen::Vector3d::Zero()), "reading of the sensors");
}

}  // namespace rex::sensor_history_test
