// A Kalman filter follows a thrown ball: from noisy heights it learns the speed, which nobody measures.
#include "course/course.h"
#include "estimation/kalman_filter.h"

using namespace rex;

int main() {
  const double tau = 0.02, g = 9.81, noise = 0.3;
  const LinearModel motion{.C = Eigen::Matrix2d{{1, tau}, {0, 1}},
                           .c = Eigen::Vector2d(-g * tau * tau / 2, -g * tau),
                           .W = 1e-6 * Eigen::Matrix2d::Identity()};
  const LinearModel sensor{.C = Eigen::RowVector2d(1, 0),
                           .c = Eigen::VectorXd::Zero(1),
                           .W = Eigen::MatrixXd::Constant(1, 1, noise * noise)};
  Eigen::Vector2d ball(0, 10);  // height and speed
  Gaussian belief{.mean = Eigen::Vector2d::Zero(), .covariance = 100 * Eigen::Matrix2d::Identity()};

  Rng rng(1);
  Series truth{.label = "true height"}, estimate{.label = "estimate"};
  Series seen{.label = "measured", .style = SeriesStyle::kPoints};
  Band band{.label = "two deviations"};
  for (double t = tau; t < 2; t += tau) {
    ball = motion.C * ball + motion.c;
    const Eigen::VectorXd y = sensor.C * ball + noise * rng.normalVector(1);
    belief = kalmanUpdate(kalmanPredict(belief, motion), sensor, y).belief;
    const double mean = belief.mean[0], reach = 2 * std::sqrt(belief.covariance(0, 0));
    for (Series* one : {&truth, &estimate, &seen}) one->x.push_back(t);
    truth.y.push_back(ball[0]), estimate.y.push_back(mean), seen.y.push_back(y[0]);
    band.x.push_back(t), band.low.push_back(mean - reach), band.high.push_back(mean + reach);
  }
  print("true speed [m/s]", ball[1]);
  print("estimated speed [m/s]", belief.mean[1]);
  plot("filter", {.title = "A thrown ball",
                  .xLabel = "time [s]",
                  .yLabel = "height [m]",
                  .series = {truth, estimate, seen},
                  .bands = {band}});
}
