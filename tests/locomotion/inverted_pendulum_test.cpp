#include <cmath>

#include "base/rng.h"
#include "locomotion/zero_moment_point.h"
#include "support/expect_error.h"
#include "support/runge_kutta.h"

namespace rex::inverted_pendulum_test {

using Eigen::Vector2d;
using Eigen::Vector4d;

CenterMotion randomCenter(Rng& rng) { return {.c = rng.normalVector(2), .v = rng.normalVector(2)}; }

TEST(InvertedPendulum, ClosedFormIsTheIntegral) {
  Rng rng(1);
  const InvertedPendulum pendulum{.height = .7};
  for (int trial = 0; trial < 10; ++trial) {
    const CenterMotion start = randomCenter(rng);
    const Vector2d p = rng.normalVector(2);
    Vector4d x;
    x << start.c, start.v;
    const auto rate = [&](const Vector4d& at) {
      Vector4d d;
      d << at.tail<2>(), pendulum.acceleration(at.head<2>(), p);
      return d;
    };
    for (int i = 0; i < 4000; ++i) x = rungeKutta4Step(rate, x, 2.5e-4);
    const CenterMotion end = pendulum.after(start, p, 1);
    EXPECT_LT((end.c - x.head<2>()).norm(), 1e-9);
    EXPECT_LT((end.v - x.tail<2>()).norm(), 1e-9);
    EXPECT_LT((pendulum.orbitalEnergy(end, p) - pendulum.orbitalEnergy(start, p)).norm(), 1e-10);
    const CenterMotion back = pendulum.after(end, p, -1);
    // On the way back rounding grows by exp(omega t), 42.
    EXPECT_LT((back.c - start.c).norm() + (back.v - start.v).norm(), 1e-11);
    EXPECT_LT((pendulum.zmp(start.c, pendulum.acceleration(start.c, p)) - p).norm(), 1e-13);
  }
}

// Standing on the capture point it comes to rest there, beside it by d it runs away as d exp(omega t) / 2.
TEST(InvertedPendulum, CapturePointIsWhereItComesToRest) {
  Rng rng(2);
  const InvertedPendulum pendulum{.height = .9, .g = 9.8};
  for (int trial = 0; trial < 10; ++trial) {
    const CenterMotion start = randomCenter(rng);
    const Vector2d p = pendulum.capturePoint(start);
    const double t = 12 / pendulum.omega();
    const CenterMotion end = pendulum.after(start, p, t);
    EXPECT_LT((end.c - p).norm(), 1e-4);
    EXPECT_LT(end.v.norm(), 1e-4);
    const CenterMotion missed = pendulum.after(start, p + Vector2d(1e-3, 0), t);
    EXPECT_NEAR(missed.c.x() - p.x(), -1e-3 * std::exp(12) / 2, 1e-2);
    // The capture point itself runs away from p, as exp(omega t).
    const Vector2d later = pendulum.capturePoint(pendulum.after(start, Vector2d::Zero(), .3));
    EXPECT_LT((later - std::exp(.3 * pendulum.omega()) * p).norm(), 1e-12);
  }
}

TEST(InvertedPendulum, NamesWhatIsWrong) {
  EXPECT_REX_ERROR(InvertedPendulum{.height = 0}.omega(), "inverted pendulum: height: found 0");
  EXPECT_REX_ERROR(InvertedPendulum{.g = -1}.omega(), "inverted pendulum: g: found -1");
  const InvertedPendulum pendulum;
  const Vector2d zero = Vector2d::Zero(), bad(0, NAN);
  EXPECT_REX_ERROR(pendulum.after({.c = bad}, zero, 1), "inverted pendulum: position c: number 1: found nan");
  EXPECT_REX_ERROR(pendulum.capturePoint({.v = bad}), "inverted pendulum: velocity v: number 1: found nan");
  EXPECT_REX_ERROR(pendulum.after({}, bad, 1), "inverted pendulum: zero moment point p: number 1");
  EXPECT_REX_ERROR(pendulum.after({}, zero, INFINITY), "inverted pendulum: time t: found inf");
  EXPECT_REX_ERROR(pendulum.zmp(zero, bad), "inverted pendulum: acceleration: number 1");
}

}  // namespace rex::inverted_pendulum_test
