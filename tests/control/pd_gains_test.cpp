#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "control/pid.h"
#include "control/point_mass.h"
#include "support/expect_error.h"

namespace rex::pd_gains_test {

// Slide 3:14, the other way round.
TEST(PdGains, HaveTheirWaveLengthAndDampingRatio) {
  for (const double mass : {0.1, 1., 3.456})
    for (const double lambda : {0.01, 0.5, 4.})
      for (const double xi : {0., 0.3, 1., 2.}) {
        const PdGains gains = pdGains(mass, lambda, xi);
        EXPECT_NEAR(1 / std::sqrt(gains.Kp / mass), lambda, 1e-14 * lambda);
        EXPECT_NEAR(gains.Kd / std::sqrt(4 * mass * gains.Kp), xi, 1e-14);
      }
}

TEST(PdGains, OscillateOnceIn2PiLambda) {
  const double lambda = 0.37, period = 2 * std::numbers::pi * lambda;
  const PointMassState back = pdResponse({2}, pdGains(2, lambda, 0), {1, 0.5}, 0, period);
  EXPECT_NEAR(back.q, 1, 1e-14);
  EXPECT_NEAR(back.v, 0.5, 1e-13);
}

TEST(PdGains, RefuseWhatIsOutOfRange) {
  EXPECT_REX_ERROR(pdGains(0, 1, 1), "mass: found 0, wanted a positive, finite number");
  EXPECT_REX_ERROR(pdGains(1, -0.5, 1), "wave length lambda: found -0.5, wanted a positive, finite number");
  EXPECT_REX_ERROR(pdGains(1, std::nan(""), 1), "wave length lambda: found nan");
  EXPECT_REX_ERROR(pdGains(1, 1, -1), "damping ratio xi: found -1, wanted a finite number, 0 or more");
  EXPECT_REX_ERROR(pdGains(1, 1, HUGE_VAL), "damping ratio xi: found inf");
  EXPECT_REX_ERROR(pdGains(1, 1e-200, 1), "gain Kp: found inf, wanted a finite number");
  EXPECT_REX_ERROR(pdGains(1, 1e-10, 1e300), "gain Kd: found inf");
}

}  // namespace rex::pd_gains_test
