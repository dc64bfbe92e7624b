#include "control/responses.h"

#include <cmath>
#include <complex>
#include <numbers>

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include "base/rng.h"
#include "support/expect_error.h"

namespace rex::responses_test {

using Eigen::MatrixXd;
using Complex = std::complex<double>;
constexpr double kPi = std::numbers::pi;

// 1 / (s^2 + 2 xi s + 1)
LinearSystem oscillator(double xi) {
  LinearSystem system{.A = MatrixXd(2, 2), .B = MatrixXd::Zero(2, 1), .C = MatrixXd::Zero(1, 2)};
  system.A << 0, 1, -1, -2 * xi;
  system.B(1, 0) = system.C(0, 0) = 1;
  return system;
}

TEST(StepResponse, OfAnOscillatorHasAClosedForm) {
  const double xi = 0.3, wd = std::sqrt(1 - xi * xi);
  const TimeResponse response = stepResponse(oscillator(xi), 0, 20, 101);
  ASSERT_EQ(response.times.size(), 101u);
  EXPECT_NEAR(response.times.back(), 20, 1e-12);
  for (std::size_t i = 0; i < 101; ++i) {
    const double t = response.times[i],
                 wanted = 1 - std::exp(-xi * t) * (std::cos(wd * t) + xi / wd * std::sin(wd * t));
    EXPECT_NEAR(response.y(0, static_cast<Eigen::Index>(i)), wanted, 1e-12) << t;
  }
}

TEST(StepResponse, OfStepsIsTheIteration) {
  const LinearSystem steps{.A = MatrixXd::Constant(1, 1, 0.5),
                           .B = MatrixXd::Constant(1, 1, 2),
                           .D = MatrixXd::Constant(1, 1, 3),
                           .step = 0.1};
  const TimeResponse response = stepResponse(steps, 0, 0.5);
  ASSERT_EQ(response.times.size(), 6u);
  for (int i = 0; i < 6; ++i) EXPECT_NEAR(response.y(0, i), 4 * (1 - std::pow(0.5, i)) + 3, 1e-14);
}

TEST(FrequencyResponse, HasTheTransferFunction) {
  const std::vector<double> frequencies = frequenciesBetween(0.01, 100, 301);
  EXPECT_NEAR(frequencies[150], 1, 1e-12);
  EXPECT_NEAR(frequencies.back(), 100, 1e-10);
  const FrequencyResponse response = frequencyResponse(oscillator(0.1), 0, 0, frequencies);
  for (std::size_t i = 0; i < frequencies.size(); ++i) {
    const Complex s(0, frequencies[i]), wanted = 1. / (s * s + 0.2 * s + 1.);
    EXPECT_LT(std::abs(response.values[i] - wanted), 1e-12);
    EXPECT_NEAR(response.magnitudes[i], 20 * std::log10(std::abs(wanted)), 1e-10);
    EXPECT_GT(response.phases[i], -180.1);
    EXPECT_LT(response.phases[i], 0.1);
  }
  EXPECT_NEAR(response.phases[150], -90, 1e-9);
  // Four integrators of a chain: the phase goes on to -360 instead of jumping.
  LinearSystem chain{.A = MatrixXd::Zero(4, 4), .B = MatrixXd::Zero(4, 1), .C = MatrixXd::Zero(1, 4)};
  for (int i = 0; i < 4; ++i) chain.A(i, i) = -1;
  for (int i = 0; i < 3; ++i) chain.A(i, i + 1) = 1;
  chain.B(3, 0) = chain.C(0, 0) = 1;
  const FrequencyResponse falling = frequencyResponse(chain, 0, 0, frequencies);
  EXPECT_NEAR(falling.phases.back(), -4 * std::atan(100.) * 180 / kPi, 1e-9);
}

// 1 / (s^2 / w^2 + 1) has a pole at w alone, however fast that is.
TEST(FrequencyResponse, TakesFastModes) {
  for (const double w : {1e6, 1e9, 1e20}) {
    LinearSystem fast = oscillator(0);
    fast.A(1, 0) = -w * w;
    fast.B(1, 0) = w * w;
    EXPECT_LT(std::abs(frequencyResponse(fast, 0, 0, {1}).values[0] - 1.), 1e-11) << w;
    EXPECT_LT(std::abs(frequencyResponse(fast, 0, 0, {2 * w}).values[0] + 1. / 3), 1e-11) << w;
    EXPECT_REX_ERROR(frequencyResponse(fast, 0, 0, {w}), "frequency response: found a pole at the frequency");
  }
}

// The response to a sine, simulated until it has settled.
TEST(FrequencyResponse, OfStepsIsWhatASineBecomes) {
  const double h = 0.2, w = 1.3;
  const LinearSystem steps = discretized(oscillator(0.5), h);
  const FrequencyResponse response = frequencyResponse(steps, 0, 0, {w});
  Eigen::Vector2d x = Eigen::Vector2d::Zero();
  for (int t = 0; t < 1000; ++t) {
    if (t > 900) {
      EXPECT_NEAR(x[0], (response.values[0] * std::polar(1., w * h * t)).real(), 1e-9) << t;
    }
    x = (steps.A * x + steps.B * std::cos(w * h * t)).eval();
  }
}

// Nyquist: how often 1 + k G turns about zero is the number of unstable poles that feedback makes.
TEST(FrequencyResponse, CountsUnstablePoles) {
  Rng rng(51);
  int unstable = 0;
  for (int round = 0; round < 40; ++round) {
    const int n = 1 + rng.index(4);
    LinearSystem system{.A = rng.normalVector(n * n).reshaped(n, n),
                        .B = rng.normalVector(n),
                        .C = rng.normalVector(n).transpose()};
    system.A.diagonal().array() -=
        0.1 + Eigen::EigenSolver<MatrixXd>(system.A).eigenvalues().real().maxCoeff();
    const double k = 3;
    const FrequencyResponse response = frequencyResponse(system, 0, 0, frequenciesBetween(1e-4, 1e4, 8000));
    double turned = 0;
    for (std::size_t i = 0; i + 1 < response.values.size(); ++i)
      turned += std::arg((1. + k * response.values[i + 1]) / (1. + k * response.values[i]));
    const Eigen::VectorXcd poles =
        Eigen::EigenSolver<MatrixXd>(system.A - k * system.B * system.C).eigenvalues();
    const auto wanted = (poles.real().array() > 0).count();
    EXPECT_EQ(std::lround(-turned / kPi), wanted) << "seed 51, " << round;
    unstable += wanted > 0;
  }
  EXPECT_GT(unstable, 5);
}

TEST(Responses, SayWhatIsWrong) {
  const LinearSystem system = oscillator(0), steps = discretized(system, 0.1);
  EXPECT_REX_ERROR(stepResponse(system, 1, 1), "input of a step response: found 1, wanted 0 to 0");
  EXPECT_REX_ERROR(stepResponse(system, 0, 0), "time T of a step response: found 0");
  EXPECT_REX_ERROR(stepResponse(system, 0, 1, 1), "times of a step response: found 1, wanted 2 to 1000000");
  EXPECT_REX_ERROR(stepResponse(steps, 0, 0.01),
                   "time T of a step response: found 0.01, wanted 1 to 1000000 steps of 0.1 s");
  EXPECT_REX_ERROR(frequencyResponse(system, -1, 0, {1}), "input of a frequency response: found -1");
  EXPECT_REX_ERROR(frequencyResponse(system, 0, 1, {1}), "output of a frequency response: found 1");
  EXPECT_REX_ERROR(frequencyResponse(system, 0, 0, {2, 1}),
                   "frequency: found 1 after 2, wanted a larger one");
  EXPECT_REX_ERROR(frequencyResponse(system, 0, 0, {1}),
                   "frequency response: found a pole at the frequency 1 rad/s");
  EXPECT_REX_ERROR(frequencyResponse(steps, 0, 0, {40}),
                   "frequency: found 40 rad/s, wanted at most pi / step, 31.4159 rad/s");
  EXPECT_REX_ERROR(frequenciesBetween(0, 1), "lowest frequency: found 0");
  EXPECT_REX_ERROR(frequenciesBetween(2, 1), "highest frequency: found 1, wanted more than 2");
  EXPECT_REX_ERROR(frequenciesBetween(1, 2, 1), "frequencies: found 1, wanted 2 to 1000000");
}

}  // namespace rex::responses_test
