#include "planning/phase_space.h"

#include <cmath>

#include <Eigen/QR>
#include <gtest/gtest.h>

#include "base/rng.h"
#include "support/expect_error.h"

namespace rex::phase_space_test {

using Eigen::Vector2d;

TEST(PhaseSpace, ArrivesWithTheEffortThatIsSaid) {
  Rng rng(1);
  for (int i = 0; i < 50; ++i) {
    const Vector2d from = rng.uniformVector(2, -2, 2), to = rng.uniformVector(2, -2, 2);
    const double T = rng.uniform(.2, 4);
    EXPECT_LT((leastEffortState(from, to, T, 0) - from).norm(), 1e-12);
    EXPECT_LT((leastEffortState(from, to, T, T) - to).norm(), 1e-9);
    // Simpson's rule is exact for the square of a linear force.
    const auto u2 = [&](double t) { return std::pow(leastEffortForce(from, to, T, t), 2); };
    EXPECT_NEAR(leastEffort(from, to, T), T / 6 * (u2(0) + 4 * u2(T / 2) + u2(T)),
                1e-9 * (1 + leastEffort(from, to, T)));
    const double t = rng.uniform(.1, .9) * T, h = 1e-4;
    const Vector2d rate =
        (leastEffortState(from, to, T, t + h) - leastEffortState(from, to, T, t - h)) / (2 * h);
    EXPECT_NEAR(rate[0], leastEffortState(from, to, T, t)[1], 1e-5);
    EXPECT_NEAR(rate[1], leastEffortForce(from, to, T, t), 1e-5);
  }
}

// The second opinion: of many forces that are constant for a short while, the smallest that arrive.
TEST(PhaseSpace, IsTheLeastEffort) {
  const Vector2d from(0, 1), to(2, -.5);
  const double T = 1.5;
  constexpr int kPieces = 2000;
  const double h = T / kPieces;
  Eigen::MatrixXd A(2, kPieces);
  for (int k = 0; k < kPieces; ++k) A.col(k) << h * (T - (k + .5) * h), h;
  const Eigen::VectorXd u =
      A.completeOrthogonalDecomposition().solve(Vector2d(to[0] - from[0] - T * from[1], to[1] - from[1]));
  EXPECT_NEAR(leastEffort(from, to, T), h * u.squaredNorm(), 1e-4);
}

TEST(PhaseSpace, RefusesWhatIsNoMotion) {
  EXPECT_REX_ERROR(static_cast<void>(leastEffort({0, 1}, {1, 1}, 0)),
                   "duration of a motion: found 0 s, wanted a positive, finite number of seconds");
  EXPECT_REX_ERROR(static_cast<void>(leastEffort({0, NAN}, {1, 1}, 1)),
                   "state in phase space: number 1: found nan, wanted a finite number");
  EXPECT_REX_ERROR(static_cast<void>(leastEffort({0, 1}, {INFINITY, 1}, 1)),
                   "state in phase space: number 0: found inf");
  EXPECT_REX_ERROR(static_cast<void>(leastEffortForce({0, 1}, {1, 1}, 1, NAN)),
                   "time of a motion: found nan");
  EXPECT_REX_ERROR(static_cast<void>(leastEffortState({0, 1}, {1, 1}, 1, NAN)),
                   "time of a motion: found nan");
}

}  // namespace rex::phase_space_test
