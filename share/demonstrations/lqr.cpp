// Chapter 8: Linear quadratic regulation. Costs Q of errors and R of force give the feedback that balances
// the pole; pushes come every three seconds. Cheap force (small R) acts hard and fast, expensive force
// lets it sway.
// Slides: 8:17, 8:18
// Formula: 0 = AᵀP + P A - P B R⁻¹ Bᵀ P + Q, u = -R⁻¹ Bᵀ P x
// Try: Pushes every three seconds. Move "log10 of R": cheap control acts hard.
#include <iomanip>
#include <sstream>

#include "control/regulators.h"
#include "course/cart_pole_pictures.h"
#include "course/course.h"
#include "course/live_view.h"
#include "systems/cart_pole.h"

using namespace rex;

int main() {
  CartPole plant(0, {.tau = 1. / 300, .noise = 0});
  plant.x.setZero();
  LiveView view("lqr");
  view.lookFrom({0.2, -2, 0.35});
  const LinearizedPlant upright = plant.getLinearization();
  int lost = -60;  // when it was last set upright again
  for (int t = 0; t < 360 || view.isWatched(); ++t) {
    const double place = view.slider("Q of the place", 0, 50, 1),
                 angle = view.slider("Q of the angle", 0, 100, 10);
    const double force = view.slider("log10 of R", -3, 2, -1),
                 strength = view.slider("push [rad/s]", 0, 3, 0.8);
    const RiccatiResult regulator =
        lqr({.A = upright.A, .B = upright.B},
            Eigen::Vector4d(place + 1e-6, 0, angle, 0).asDiagonal().toDenseMatrix(),
            Eigen::MatrixXd::Constant(1, 1, std::pow(10, force)));
    if (view.button("push left")) plant.x[3] -= strength;
    if (view.button("push right") || t % 90 == 30) plant.x[3] += strength;
    const bool isLost = std::abs(plant.x[2]) > 1.5 || std::abs(plant.x[0]) > 6;
    if (view.button("set upright") || isLost) plant.x.setZero();
    if (isLost) lost = t;
    std::ostringstream text;
    if (t < lost + 60) text << "it fell, or left the rails, and was set upright again. ";
    if (regulator.K.size() > 0) text << std::setprecision(3) << "K = " << regulator.K;
    double u = 0;  // the largest since the last picture
    for (int i = 0; i < 10; ++i) {
      const double now = regulator.K.size() > 0 ? -regulator.K.row(0).dot(plant.x) : 0;
      if (std::abs(now) > std::abs(u)) u = now;
      plant.step(now);
    }
    view.plot("place [m]", t / 30., plant.x[0]);
    view.plot("angle [rad]", t / 30., plant.x[2]);
    view.plot("force [N]", t / 30., u);
    view.show(cartPolePicture(CartPoleView{.x = plant.x, .u = u, .caption = text.str()}));
  }
}
