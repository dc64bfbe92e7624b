// Model predictive control: a cart of 1 kg reaches its goal with at most 1 N, and never drives faster than
// 0.8 m/s.
#include "control/predictive_controller.h"
#include "course/course.h"

using namespace rex;

int main() {
  const double tau = 0.1;
  const LinearSystem cart =
      discretized({.A = Eigen::Matrix2d{{0, 1}, {0, 0}}, .B = Eigen::Vector2d(0, 1)}, tau);
  const double free = std::numeric_limits<double>::infinity();  // the position has no limit
  const PredictiveController controller(cart, {.Q = Eigen::Vector2d(1, 0.1).asDiagonal(),
                                               .R = Eigen::MatrixXd::Constant(1, 1, 0.1),
                                               .horizon = 30,
                                               .uMin = Eigen::VectorXd::Constant(1, -1),
                                               .uMax = Eigen::VectorXd::Constant(1, 1),
                                               .xMin = Eigen::Vector2d(-free, -0.8),
                                               .xMax = Eigen::Vector2d(free, 0.8)});
  Eigen::VectorXd x = Eigen::Vector2d(-3, 0);  // position and speed, from the goal
  PredictedMotion motion;
  Series place{.label = "position [m]"}, speed{.label = "speed [m/s]"}, force{.label = "force [N]"};
  for (int t = 0; t < 80; ++t) {
    motion =
        controller.plan(x, t == 0 ? nullptr : &motion);  // of the whole plan only the first force is used
    if (motion.U.cols() == 0) return print("no plan", motion.message), 1;
    for (Series* one : {&place, &speed, &force}) one->x.push_back(t * tau);
    place.y.push_back(x[0]), speed.y.push_back(x[1]), force.y.push_back(motion.U(0, 0));
    x = cart.A * x + cart.B * motion.U.col(0);
  }
  print("distance from the goal [m]", std::abs(x[0]));
  print("largest speed [m/s]", *std::max_element(speed.y.begin(), speed.y.end()));
  plot("mpc", {.title = "A cart with limits",
               .xLabel = "time [s]",
               .yLabel = "m, m/s and N",
               .series = {place, speed, force}});
}
