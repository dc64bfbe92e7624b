#include "systems/event_integration.h"

#include <numbers>

#include <Eigen/Core>
#include <gtest/gtest.h>

namespace rex::internal::event_integration_test {

using Eigen::Vector2d;

Vector2d oscillator(const Vector2d& x) { return {x[1], -x[0]}; }

TEST(ExtrapolatedStep, HasTwelfthOrder) {
  const auto error = [](double h) {
    const ExtrapolatedStep<Vector2d> step = extrapolatedStep(oscillator, Vector2d(1, 0), h);
    return (step.x - Vector2d(std::cos(h), -std::sin(h))).norm();
  };
  EXPECT_NEAR(std::log2(error(4) / error(2)), 13, 1);  // of one step: an order more
  EXPECT_LT(error(.3), 3e-15);                         // ten units in the last place
  const double estimate = extrapolatedStep(oscillator, Vector2d(1, 0), 1.).error;
  EXPECT_GT(estimate, error(1));
}

TEST(IntegrateToEvent, FindsTimesToTheLastBits) {
  const std::array<Event<Vector2d>, 2> events = {
      {{[](const Vector2d& x) { return x[0]; }}, {[](const Vector2d& x) { return .5 - x[1]; }}}};
  const auto to = [&](const Vector2d& x, std::span<const Event<Vector2d>> which) {
    return integrateToEvent<Vector2d>(oscillator, x, 20, .3, which);
  };
  const EventPoint<Vector2d> zero = to({1, 0}, events);
  ASSERT_EQ(zero.event, 0);
  EXPECT_NEAR(zero.t, std::numbers::pi / 2, 2e-15);
  EXPECT_NEAR(zero.x[1], -1, 2e-15);
  // The second event comes first from here, 30 degrees on.
  const EventPoint<Vector2d> half = to({1, 1e-300}, std::span(events).subspan(1));
  ASSERT_EQ(half.event, 0);
  EXPECT_NEAR(half.t, 2 * std::numbers::pi - std::numbers::pi / 2 - std::acos(.5), 5e-15);
  const EventPoint<Vector2d> first = to({std::sqrt(.75), .5 - 1e-9}, events);
  EXPECT_EQ(first.event, 0);
}

TEST(IntegrateToEvent, EndsWithItsTime) {
  const std::array<Event<Vector2d>, 1> never = {{{[](const Vector2d&) { return 1.; }}}};
  const EventPoint<Vector2d> end =
      integrateToEvent<Vector2d>(oscillator, Vector2d(1, 0), 10, .3, std::span(never));
  EXPECT_FALSE(end.event);
  EXPECT_EQ(end.t, 10);
  EXPECT_LT((end.x - Vector2d(std::cos(10), -std::sin(10))).norm(), 1e-13);
}

// Steps get shorter where the motion is quick: x' = x^2 from 1 is 1 / (1 - t).
TEST(IntegrateToEvent, ShortensItsSteps) {
  using Scalar = Eigen::Matrix<double, 1, 1>;
  const std::array<Event<Scalar>, 1> events = {{{[](const Scalar& x) { return 1000 - x[0]; }}}};
  const EventPoint<Scalar> end = integrateToEvent<Scalar>([](const Scalar& x) { return Scalar(x[0] * x[0]); },
                                                          Scalar(1.), 5, .5, std::span(events));
  ASSERT_EQ(end.event, 0);
  EXPECT_NEAR(end.t, .999, 1e-11);
}

TEST(IntegrateToEvent, LeavesOutWhatDoesNotApply) {
  const std::array<Event<Vector2d>, 1> rising = {
      {{[](const Vector2d& x) { return x[0]; }, [](const Vector2d& x) { return x[1] > 0; }}}};
  EXPECT_FALSE(integrateToEvent<Vector2d>(oscillator, Vector2d(1, 0), 6, .3, std::span(rising)).event);
}

}  // namespace rex::internal::event_integration_test
