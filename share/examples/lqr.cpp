// LQR: the best linear feedback balances a pole on a cart, though every step pushes both at random.
#include "control/regulators.h"
#include "course/cart_pole.h"
#include "course/course.h"

using namespace rex;

int main() {
  CartPole plant(0, {.noise = 0.02});  // of the seed 0
  plant.x = {0.5, 0, 0.3, 0};          // place and speed of the cart, angle from upright and its rate

  const LinearizedPlant upright = plant.getLinearization();
  const Eigen::Matrix4d Q = Eigen::Vector4d(1, 0, 10, 0).asDiagonal();  // what errors cost
  const Eigen::MatrixXd R = Eigen::MatrixXd::Constant(1, 1, 0.1);       // what force costs
  const RiccatiResult regulator = lqr({.A = upright.A, .B = upright.B}, Q, R);
  print("K", regulator.K);

  Series place{.label = "place [m]"}, angle{.label = "angle [rad]"};
  for (int t = 0; t < 600; ++t) {
    for (Series* one : {&place, &angle}) one->x.push_back(t * plant.options().tau);
    place.y.push_back(plant.x[0]), angle.y.push_back(plant.x[2]);
    plant.step(-regulator.K.row(0).dot(plant.x));
  }
  print("largest angle in the second half [rad]",
        Eigen::Map<Eigen::VectorXd>(&angle.y[300], 300).cwiseAbs().maxCoeff());
  plot("lqr",
       {.title = "A pole held upright", .xLabel = "time [s]", .yLabel = "error", .series = {place, angle}});
}
