#include "control/point_mass.h"

#include <cmath>
#include <vector>

#include <Eigen/Core>
#include <gtest/gtest.h>

#include "support/expect_error.h"

namespace rex::point_mass_test {

// The same motion by Runge and Kutta at fine steps.
PointMassState simulated(const PointMass& point, const PdGains& gains, const PointMassState& start,
                         double target, double t) {
  constexpr int kSteps = 4000;
  const double h = t / kSteps;
  const auto rate = [&](const Eigen::Vector2d& x) {
    return Eigen::Vector2d(x[1], (gains.Kp * (target - x[0]) - gains.Kd * x[1]) / point.mass);
  };
  Eigen::Vector2d x(start.q, start.v);
  for (int i = 0; i < kSteps; ++i) {
    const Eigen::Vector2d k1 = rate(x), k2 = rate(x + h / 2 * k1), k3 = rate(x + h / 2 * k2),
                          k4 = rate(x + h * k3);
    x += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
  }
  return {x[0], x[1]};
}

TEST(PdResponse, IsWhatFineStepsFind) {
  for (const double xi : {0., 0.3, 0.9, 1 - 1e-9, 1., 1 + 1e-9, 1.1, 2., 10.}) {
    const PdGains gains = pdGains(3.456, 0.4, xi);
    for (const double t : {0.1, 1., 3.}) {
      const PointMassState exact = pdResponse({3.456}, gains, {1.5, -2}, 0.5, t);
      const PointMassState fine = simulated({3.456}, gains, {1.5, -2}, 0.5, t);
      EXPECT_NEAR(exact.q, fine.q, 1e-9) << xi << " " << t;
      EXPECT_NEAR(exact.v, fine.v, 1e-8) << xi << " " << t;
    }
  }
}

// Signs of gains that nobody wants: the motion grows, or only drifts.
TEST(PdResponse, HoldsWithoutSpringsAndWithWrongSigns) {
  for (const PdGains& gains :
       std::vector<PdGains>{{0, 0}, {0, 2}, {0, -2}, {-3, 0}, {-3, 1}, {-3, -1}, {1, -2}, {1, -1}, {1, -4}}) {
    const PointMassState exact = pdResponse({1}, gains, {0.5, 1}, 0.2, 2);
    const PointMassState fine = simulated({1}, gains, {0.5, 1}, 0.2, 2);
    EXPECT_NEAR(exact.q, fine.q, 1e-9 * (1 + std::abs(fine.q))) << gains.Kp << " " << gains.Kd;
    EXPECT_NEAR(exact.v, fine.v, 1e-9 * (1 + std::abs(fine.v))) << gains.Kp << " " << gains.Kd;
  }
}

// Slide 3:14 at xi = 1: e(t) = (1 + t / lambda) exp(-t / lambda). Beside it the response differs by
// (xi - 1) times a number of order one, and by nothing else.
TEST(PdResponse, PassesSmoothlyThroughCriticalDamping) {
  const double lambda = 0.25, t = 0.6, s = t / lambda;
  const double critical = (1 + s) * std::exp(-s);
  EXPECT_NEAR(pdResponse({1}, pdGains(1, lambda, 1), {1, 0}, 0, t).q, critical, 1e-15);
  for (const double offset : {1e-16, 1e-15, 1e-14, 1e-12, 1e-10, 1e-8})
    for (const double sign : {-1., 1.}) {
      const double q = pdResponse({1}, pdGains(1, lambda, 1 + sign * offset), {1, 0}, 0, t).q;
      EXPECT_NEAR(q, critical, offset + 4e-15) << sign * offset;
    }
}

// The slow rate of a very stiff damper is Kp / Kd; the difference of the script's formula would lose it.
TEST(PdResponse, KeepsTheSlowRateOfStrongDamping) {
  const PointMassState state = pdResponse({1}, {.Kp = 1, .Kd = 1e9}, {1, 0}, 0, 1e9);
  EXPECT_NEAR(state.q, std::exp(-1.), 1e-14);
  EXPECT_NEAR(pdResponse({1}, pdGains(1, 1, 100), {1, 0}, 0, 1e5).q, 0, 1e-15);
}

// So stiff a damper holds the mass where it is; squares of its constant overflow.
TEST(PdResponse, StandsEnormousDamping) {
  for (const double t : {0., 1., 100.}) {
    const PointMassState state = pdResponse({1}, {.Kp = 1, .Kd = 1e200}, {1, 0}, 0, t);
    EXPECT_DOUBLE_EQ(state.q, 1) << t;
    EXPECT_NEAR(state.v, 0, 1e-15) << t;
  }
  // exp(-t / lambda) with lambda = Kd / Kp of 1 s.
  EXPECT_NEAR(pdResponse({1}, {.Kp = 1e200, .Kd = 1e200}, {1, 0}, 0, 1).q, std::exp(-1.), 1e-13);
  EXPECT_NEAR(pdResponse({1e-170}, {.Kp = 1, .Kd = 1}, {1, 0}, 0, 1).q, std::exp(-1.), 1e-13);
}

// Recorded from an independent implementation (exercise 5): Euler steps of 10 ms from 0 to 1 in time
// T, with lambda = T / 8.
TEST(PointMass, TakesTheRecordedEulerSteps) {
  struct Case {
    double T, xi, q, v;
  };
  for (const Case& c : {Case{1, 0.3, 0.9564157624584447, 1.0008095934869048},
                        {1, 1, 0.9976806848674561, 0.016640826063095346},
                        {1, 2, 0.8766090650595127, 0.2645000109649972},
                        {2, 0.3, 0.9538277057709177, 0.43129090196380887},
                        {2, 1, 0.9973436616974839, 0.009486922508985855},
                        {2, 2, 0.8751521143775821, 0.13381156051703047},
                        {5, 0.3, 0.9527230504644131, 0.15766682894830736},
                        {5, 1, 0.9971290616906175, 0.004090384056110327},
                        {5, 2, 0.8742798829627838, 0.053898566131930954}}) {
    const PointMass point{3.456};
    const PdGains gains = pdGains(point.mass, c.T / 8, c.xi);
    const double h = 0.01;
    PointMassState state;
    for (int i = 0; i < std::lround(c.T / h); ++i)
      state = point.eulerStep(state, gains.Kp * (1 - state.q) - gains.Kd * state.v, h);
    EXPECT_NEAR(state.q, c.q, 1e-12) << c.T << " " << c.xi;
    EXPECT_NEAR(state.v, c.v, 1e-12) << c.T << " " << c.xi;
  }
}

TEST(PointMass, ComesToThePdResponseInSmallSteps) {
  const PdGains gains = pdGains(1, 0.5, 0.4);
  const PointMassState exact = pdResponse({1}, gains, {0, 0}, 1, 1);
  double before = 1;
  for (const int steps : {100, 200, 400, 800}) {
    PointMassState state;
    for (int i = 0; i < steps; ++i)
      state = PointMass{1}.eulerStep(state, gains.Kp * (1 - state.q) - gains.Kd * state.v, 1. / steps);
    const double error = std::abs(state.q - exact.q);
    if (steps > 100) {
      EXPECT_NEAR(before / error, 2, 0.1);
    }
    before = error;
  }
}

TEST(PointMass, RefusesBadNumbers) {
  const double nan = std::nan("");
  EXPECT_REX_ERROR(PointMass{0}.eulerStep({}, 0, 1), "mass: found 0, wanted a positive, finite number");
  EXPECT_REX_ERROR(PointMass{1}.eulerStep({}, 0, 0),
                   "time step h: found 0, wanted a positive, finite number");
  EXPECT_REX_ERROR(PointMass{1}.eulerStep({}, nan, 1), "force u: found nan, wanted a finite number");
  EXPECT_REX_ERROR(PointMass{1}.eulerStep({nan, 0}, 0, 1), "position q: found nan");
  EXPECT_REX_ERROR(PointMass{1}.eulerStep({0, HUGE_VAL}, 0, 1), "velocity v: found inf");
  EXPECT_REX_ERROR(pdResponse({-1}, {}, {}, 0, 1), "mass: found -1");
  EXPECT_REX_ERROR(pdResponse({1}, {nan, 0}, {}, 0, 1), "gain Kp: found nan");
  EXPECT_REX_ERROR(pdResponse({1}, {0, nan}, {}, 0, 1), "gain Kd: found nan");
  EXPECT_REX_ERROR(pdResponse({1}, {}, {}, nan, 1), "target: found nan");
  EXPECT_REX_ERROR(pdResponse({1}, {.Kp = -1}, {1, 0}, 0, 1e4), "position q at time t: found nan");
  EXPECT_REX_ERROR(pdResponse({1}, {}, {0, 1e300}, 0, 1e300), "position q at time t: found inf");
  EXPECT_REX_ERROR(pdResponse({1}, {.Kp = -1e4}, {1, 0}, 0, 7.08), "velocity v at time t: found inf");
  EXPECT_REX_ERROR(pdResponse({1}, {}, {}, 0, -1), "time t: found -1, wanted a finite number, 0 or more");
}

}  // namespace rex::point_mass_test
