#include "grading/own_differences.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/derivative_check.h"
#include "remote/caller.h"

namespace rex::grading::own_differences_test {

using ::testing::HasSubstr;

const Eigen::VectorXd kPlace = Eigen::Vector3d(.1, .2, -.3);

Eigen::VectorXd f(const Eigen::VectorXd& q) { return Eigen::Vector2d(std::sin(q[0]) * q[1], q[2] * q[2]); }

/// Asks `program` as a check would, and returns the verdict. `asked` gets the places in order.
CheckResult ask(const VectorFunction& program, const Eigen::VectorXd& first,
                std::vector<Eigen::VectorXd>& asked, std::uint64_t seed = 1,
                Eigen::MatrixXd* numeric = nullptr) {
  Check check({.id = "id", .points = 1}, seed);
  check.startWorkersBy([](const Check::Conversation& conversation) {
    remote::Caller caller([](std::uint32_t) { return remote::Caller::Bytes{}; });
    conversation(caller);
  });
  return check.judge([&](Check& requirements) {
    const std::vector<Eigen::VectorXd> values =
        valuesInAnyOrder(requirements, "y of f", placesOfDifferences(kPlace), first,
                         [&](remote::Caller&, const Eigen::VectorXd& q) {
                           asked.push_back(q);
                           return program(q);
                         });
    if (numeric != nullptr) *numeric = finiteDifferences(values, kPlace);
  });
}

TEST(OwnDifferences, AreAskedInAnyOrderAndSomeTwice) {
  std::vector<Eigen::VectorXd> asked, again, other;
  Eigen::MatrixXd numeric;
  EXPECT_EQ(ask(f, f(kPlace), asked, 1, &numeric).points, 1);
  Eigen::MatrixXd J(2, 3);
  J << std::cos(.1) * .2, std::sin(.1), 0, 0, 0, -.6;
  EXPECT_TRUE(numeric.isApprox(J, 1e-9)) << numeric;
  const std::vector<Eigen::VectorXd> places = placesOfDifferences(kPlace);
  EXPECT_EQ(places.size(), 13u);
  EXPECT_EQ(places.front(), kPlace);
  for (const Eigen::VectorXd& q : places) EXPECT_EQ(std::ranges::count(places, q), 1);
  EXPECT_EQ(asked.size(), places.size() + 8);
  EXPECT_GE(std::ranges::count(asked, kPlace), 5);
  EXPECT_FALSE(std::equal(places.begin(), places.end(), asked.begin()));
  ask(f, f(kPlace), again);
  EXPECT_EQ(asked, again);
  ask(f, f(kPlace), other, 2);
  EXPECT_NE(asked, other);
}

// Both are consistent within one worker.
TEST(OwnDifferences, RefuseAnswersFromMemory) {
  const std::string message = "y of f is the same whenever it is asked for: does not hold";
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    std::optional<Eigen::VectorXd> first;
    const auto slope = [&](const Eigen::VectorXd& q) -> Eigen::VectorXd {
      if (!first) first = q;
      return f(*first) + (q - *first).head<2>();
    };
    std::vector<Eigen::VectorXd> asked;
    const CheckResult verdict = ask(slope, f(kPlace), asked, seed);
    EXPECT_EQ(verdict.points, asked.front() == kPlace ? 1 : 0);
    int calls = 0;
    const auto counts = [&](const Eigen::VectorXd& q) -> Eigen::VectorXd {
      return f(q) + Eigen::Vector2d::Constant(++calls > 1 ? 1e-6 : 0);
    };
    EXPECT_THAT(ask(counts, f(kPlace), asked, seed).message, HasSubstr(message));
  }
}

/// The verdict on a value and its derivative by q[0] along a path of three radians.
CheckResult alongPath(const std::function<double(double)>& value,
                      const std::function<double(double)>& slope) {
  const auto at = [&](const Eigen::VectorXd& q) {
    return ValueAndDerivative{Eigen::VectorXd::Constant(1, value(q[0])), Eigen::RowVector2d(slope(q[0]), 0)};
  };
  Check check({.id = "id", .points = 1}, 1);
  check.startWorkersBy([](const Check::Conversation& conversation) {
    remote::Caller caller([](std::uint32_t) { return remote::Caller::Bytes{}; });
    conversation(caller);
  });
  const Eigen::VectorXd from = Eigen::Vector2d(-1, 1), to = Eigen::Vector2d(2, 0);
  return check.judge([&](Check& requirements) {
    requireIntegral(requirements, "y of f", from, to, at(from),
                    [&](remote::Caller&, const Eigen::VectorXd& q) { return at(q); });
  });
}

TEST(Integral, AcceptsValuesThatChangeByTheirDerivative) {
  EXPECT_EQ(alongPath([](double x) { return std::sin(3 * x); }, [](double x) { return 3 * std::cos(3 * x); })
                .points,
            1);
  EXPECT_EQ(alongPath([](double x) { return 1e-6 * std::pow(x, 4); },
                      [](double x) { return 4e-6 * std::pow(x, 3); })
                .points,
            1);
  EXPECT_EQ(alongPath([](double x) { return std::abs(x - .321); }, [](double x) { return x > .321 ? 1 : -1; })
                .points,
            1)
      << "a kink";
  EXPECT_EQ(alongPath([](double x) { return std::sqrt(1 + x); },
                      [](double x) { return x > -1 ? .5 / std::sqrt(1 + x) : 0; })  // finite everywhere
                .points,
            1)
      << "steep at the start";
  EXPECT_EQ(alongPath([](double) { return 0; }, [](double) { return 0; }).points, 1);
}

TEST(Integral, RefusesJumpsAndInventedDerivatives) {
  const char* message = "change of y of f along a path, beside the integral of its derivative";
  EXPECT_THAT(alongPath([](double x) { return x < -.9 ? 0 : 2 + std::sin(x); },
                        [](double x) { return x < -.9 ? 0 : std::cos(x); })
                  .message,
              HasSubstr(message));
  EXPECT_THAT(alongPath([](double x) { return 1e-3 * (x < 0 ? 0 : 1 + x); },
                        [](double x) { return x < 0 ? 0 : 1e-3; })
                  .message,
              HasSubstr(message));
  EXPECT_THAT(alongPath([](double x) { return x * x; }, [](double) { return 0; }).message,
              HasSubstr(message));
  EXPECT_THAT(alongPath([](double) { return 0; }, [](double) { return 1; }).message, HasSubstr(message));
  EXPECT_THAT(alongPath([](double x) { return std::tanh(200 * x); }, [](double) { return 0; }).message,
              HasSubstr(message));
}

}  // namespace rex::grading::own_differences_test
