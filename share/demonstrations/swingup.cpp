// Chapter 8: Swinging a pendulum up. A motor too weak to lift it at once: on the left it looks its torque up
// in the values of all states, Bellman's equation on a grid; on the right it pumps energy, and linear
// feedback catches it where a Lyapunov function proves that it can. A slider sets the strength of the motor.
// Slides: 8:10, 8:11
// Formula: λ V(x) = min_u c(x, u) + ∂V/∂x f(x, u), λ the discount; E' = u θ'
// Try: Two pendulums with a weak motor: by the values of all states, and by energy until linear feedback
// catches. With "strongest torque" 12 both go straight up; with "pump gain" 0 the right one keeps hanging.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>

#include "control/regulators.h"
#include "control/value_grid.h"
#include "course/car_view.h"
#include "course/course.h"
#include "course/live_view.h"
#include "render/picture.h"

using namespace rex;

namespace {

constexpr double kPi = std::numbers::pi, kGravity = 9.81, kFriction = 0.1;

// A point of 1 kg on a rod of 1 m; the angle is zero upright.
Eigen::Vector2d rateOf(const Eigen::Vector2d& x, double u) {
  return {x[1], kGravity * std::sin(x[0]) - kFriction * x[1] + u};
}

// Zero upright and at rest.
double energyOf(const Eigen::Vector2d& x) { return x[1] * x[1] / 2 + kGravity * (std::cos(x[0]) - 1); }

struct Catch {
  Eigen::RowVector2d K;
  Eigen::Matrix2d P;
  double level = 0;  // x^T P x decreases below it
  [[nodiscard]] double torque(const Eigen::Vector2d& x, double most) const {
    return std::clamp(-K.dot(x), -most, most);
  }
};

Catch catchOf(double most) {
  const Eigen::Matrix2d A{{0, 1}, {kGravity, -kFriction}};
  const RiccatiResult regulator =
      lqr({.A = A, .B = Eigen::Vector2d(0, 1)}, Eigen::Vector2d(10, 1).asDiagonal().toDenseMatrix(),
          Eigen::MatrixXd::Identity(1, 1));
  Catch found{.K = regulator.K.row(0), .P = regulator.X, .level = 1e9};
  for (int k = 0; k < 360; ++k) {
    const Eigen::Vector2d direction(std::cos(k * kPi / 180), std::sin(k * kPi / 180));
    for (double size = 0.01; size < 4; size += 0.01) {
      const Eigen::Vector2d x = size * direction;
      if (x.dot(found.P * rateOf(x, found.torque(x, most))) < 0) continue;
      found.level = std::min(found.level, x.dot(found.P * x));
      break;
    }
  }
  return found;
}

void add(Picture& picture, const Eigen::Vector2d& x, double place, double u, const char* name) {
  const Pose X_WP = translation(place, 0, 1.3) * rotation(x[0], Eigen::Vector3d::UnitY());
  picture.solids.push_back({{.extent = {0.06, 0.06, 1}}, X_WP * translation(0, 0, 0.5), kTruthColor, name});
  picture.solids.push_back(
      {{.type = ShapeType::kSphere, .radius = 0.12}, X_WP * translation(0, 0, 1), kEstimateColor, name});
  const Eigen::Vector3d hinge(place, 0, 1.3);
  if (std::abs(u) > 0.05)
    picture.arrows.push_back({hinge, hinge + Eigen::Vector3d(0.15 * u, 0, 0), kDeadReckoningColor, 0.025});
  picture.labels.push_back({.text = name, .p_WQ = Eigen::Vector3d(place - 0.4, 0, -0.1), .scale = 1.3});
}

}  // namespace

int main() {
  LiveView view("swingup");
  view.lookFrom({0, -1, 0.1});
  const Eigen::Vector2d down(kPi, 0.01);
  Eigen::Vector2d byValues = down, byEnergy = down;
  double strength = 0;
  std::optional<ValueGrid> grid;
  Catch hold;
  for (int t = 0; t < 450 || view.isWatched(); ++t) {
    const double most = view.slider("strongest torque [N m]", 2, 12, 3),
                 gain = view.slider("pump gain", 0, 3, 1);
    if (most != strength) {
      strength = most;
      grid.emplace(
          PlanarControlProblem{
              .rate = rateOf,
              .cost = [](const Eigen::Vector2d& x,
                         double u) { return 2 * (1 - std::cos(x[0])) + 0.05 * x[1] * x[1] + 0.02 * u * u; },
              .uMin = -most,
              .uMax = most,
              .discount = 0.1},
          ValueGridOptions{.lower = {-kPi, -9},
                           .upper = {kPi, 9},
                           .nodes = {101, 101},
                           .isAngle = {1, 0},
                           .controls = 13,
                           .tolerance = 1e-4});
      hold = catchOf(most);
    }
    if (view.button("let them hang")) byValues = byEnergy = down;
    if (view.button("push")) byValues[1] += 2, byEnergy[1] += 2;
    double u = 0, v = 0;
    bool isCaught = false;
    for (int i = 0; i < 10; ++i) {
      u = grid->control({std::remainder(byValues[0], 2 * kPi), byValues[1]});
      byValues += rateOf(byValues, u) / 300;
      const Eigen::Vector2d x(std::remainder(byEnergy[0], 2 * kPi), byEnergy[1]);
      isCaught = x.dot(hold.P * x) < hold.level;
      v = isCaught ? hold.torque(x, most) : std::clamp(-gain * x[1] * energyOf(x), -most, most);
      byEnergy += rateOf(byEnergy, v) / 300;
    }
    Picture picture{.ground = {.visible = false}};
    add(picture, byValues, -1.4, u, "values");
    add(picture, byEnergy, 1.4, v, isCaught ? "caught" : "pumping");
    view.plot("energy, values [J]", t / 30., energyOf(byValues));
    view.plot("energy, pumping [J]", t / 30., energyOf(byEnergy));
    view.show(picture);
  }
}
