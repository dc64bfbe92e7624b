#include <filesystem>

#include <gtest/gtest.h>

#include "control/responses.h"
#include "render/figure_builders.h"
#include "support/expect_error.h"
#include "support/needs_gnuplot.h"
#include "support/paths.h"

namespace rex::response_figures_test {

LinearSystem oscillator() {
  LinearSystem system{
      .A = Eigen::MatrixXd(2, 2), .B = Eigen::MatrixXd::Zero(2, 1), .C = Eigen::MatrixXd::Identity(2, 2)};
  system.A << 0, 1, -1, -0.4;
  system.B(1, 0) = 1;
  return system;
}

// What control computes is what is drawn.
TEST(ResponseFigures, ShowTheNumbers) {
  const FrequencyResponse response = frequencyResponse(oscillator(), 0, 0, frequenciesBetween(0.1, 10, 200));
  const Figure magnitude = bodeMagnitudeFigure(response.frequencies, response.magnitudes);
  EXPECT_TRUE(magnitude.logX);
  EXPECT_EQ(magnitude.series[0].x, response.frequencies);
  EXPECT_EQ(magnitude.series[0].y, response.magnitudes);
  EXPECT_EQ(magnitude.horizontalLines[0].at, 0);
  const Figure phase = bodePhaseFigure(response.frequencies, response.phases);
  EXPECT_EQ(phase.series[0].y, response.phases);
  EXPECT_EQ(phase.horizontalLines[0].at, -180);
  const Figure nyquist = nyquistFigure(response.values);
  EXPECT_TRUE(nyquist.equalAxes);
  EXPECT_EQ(nyquist.series[0].y[7], response.values[7].imag());
  EXPECT_EQ(nyquist.series[1].y[7], -response.values[7].imag());
  EXPECT_TRUE(nyquist.series[1].dashed);
  EXPECT_EQ(nyquist.series[2].x, std::vector<double>{-1});
  const TimeResponse steps = stepResponse(oscillator(), 0, 30, 300);
  const Figure step = stepFigure(steps.times, steps.y, {"position", "velocity"});
  ASSERT_EQ(step.series.size(), 2u);
  EXPECT_EQ(step.series[1].label, "velocity");
  EXPECT_EQ(step.series[1].y[20], steps.y(1, 20));
  EXPECT_EQ(stepFigure(steps.times, steps.y).series[1].label, "y2");
}

// They stay in the build folder to be looked at.
TEST(ResponseFigures, AreDrawn) {
  REX_NEEDS_GNUPLOT();
  const FrequencyResponse response = frequencyResponse(oscillator(), 0, 0, frequenciesBetween(0.05, 20, 300));
  const TimeResponse steps = stepResponse(oscillator(), 0, 25);
  const std::filesystem::path folder = ownFolder() / "tests-out" / "figures";
  std::filesystem::create_directories(folder);
  const auto draw = [&](const char* name, const Figure& figure) {
    writeFigure(figure, folder / name);
    EXPECT_GT(std::filesystem::file_size(folder / name), 5000u);
  };
  draw("bode-magnitude.png", bodeMagnitudeFigure(response.frequencies, response.magnitudes));
  draw("bode-phase.png", bodePhaseFigure(response.frequencies, response.phases));
  draw("nyquist.png", nyquistFigure(response.values));
  draw("step.png", stepFigure(steps.times, steps.y, {"position", "velocity"}));
}

TEST(ResponseFigures, SayWhatIsWrong) {
  EXPECT_REX_ERROR(bodeMagnitudeFigure({}, {}),
                   "values of a Bode plot: found no numbers, wanted at least one");
  EXPECT_REX_ERROR(bodePhaseFigure({1, 2}, {1}),
                   "values of a Bode plot: found a vector of size 1, wanted size 2");
  EXPECT_REX_ERROR(nyquistFigure({}), "values of a Nyquist plot: found no numbers");
  EXPECT_REX_ERROR(nyquistFigure({1.}, 0),
                   "reach of a Nyquist plot: found 0, wanted a positive, finite number");
  EXPECT_REX_ERROR(stepFigure({0, 1}, Eigen::MatrixXd::Zero(1, 3)),
                   "columns of a response over time: found a vector of size 3");
  EXPECT_REX_ERROR(stepFigure({0}, Eigen::MatrixXd::Zero(1, 1), {"a", "b"}),
                   "labels of a response: found a vector of size 2");
}

}  // namespace rex::response_figures_test
