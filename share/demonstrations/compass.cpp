// Chapter 11: Passive walking. Two legs without motors walk down a slope, each step begun by an impact; too
// flat a slope stops them, on a steep one steps alternate (from about 4.4 degrees), then they fall. Sliders:
// slope, mass of the hip.
// Slides: 11:18, 11:21
// Formula: M(q) q'' + F(q, q') = 0 between impacts; an impact keeps the angular momentum about the new foot
// Try: A walker on a slope, pushed at 8 s. At 4.5 degrees its steps alternate.
#include "course/car_view.h"
#include "course/course.h"
#include "course/live_view.h"
#include "locomotion/limit_cycle.h"
#include "render/picture.h"

using namespace rex;

int main() {
  LiveView view("compass");
  view.lookFrom({0.2, -2, 0.3});
  Eigen::Vector4d x(0.2187, -0.3234, -1.0918, -0.3772);
  double left = 0;  // until the next impact, seconds
  WalkerStep coming;
  bool leftStands = true, fell = true;
  int steps = 0, wait = 0;
  const double h = 1. / 300;
  for (int t = 0; t < 360 || view.isWatched(); ++t) {
    const double degrees = view.slider("slope [degrees]", 0.5, 6, 3),
                 hip = view.slider("mass of the hip [kg]", 1, 30, 10);
    const CompassGait walker{.hipMass = hip, .slope = degrees * 0.017453292519943295};
    const bool isPushed = view.button("push forward") || t == 240;
    if (view.button("start again") || (fell && --wait < 0))
      x = Eigen::Vector4d(0.2187, -0.3234, -1.0918, -0.3772), fell = false, steps = 0,
      coming = walker.step(x), left = coming.time;
    if (isPushed && !fell) x[2] -= 0.3, coming = walker.step(x), left = coming.time;
    for (int i = 0; i < 10 && !fell; ++i) {
      if (left > h) {  // Runge-Kutta
        const Eigen::Vector4d k1 = walker.derivative(x), k2 = walker.derivative(x + h / 2 * k1),
                              k3 = walker.derivative(x + h / 2 * k2), k4 = walker.derivative(x + h * k3);
        x += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4), left -= h;
      } else if (coming.status == StepStatus::kStepped) {
        view.plot("length of steps [m]", ++steps,
                  2 * std::sin(std::abs(coming.after[0] - coming.after[1]) / 2), "step");
        x = coming.after, leftStands = !leftStands, coming = walker.step(x), left = coming.time;
      } else {
        fell = true, wait = 60, x = coming.before;
      }
    }
    view.plot("stance angle [rad]", t / 30., x[0]);
    Picture picture{.ground = {.visible = false}};
    const double slope = walker.slope, length = walker.a + walker.b;
    const auto leg = [&](const Eigen::Vector3d& from, double angle, double way) {
      return Eigen::Vector3d(from + way * Eigen::Vector3d(-std::sin(angle), 0, std::cos(angle)));
    };
    // The camera walks along: the stance foot is at the origin.
    const Eigen::Vector3d foot(0, 0, 0), hipAt = leg(foot, x[0], length), swing = leg(hipAt, x[1], -length);
    const Color colors[] = {kEstimateColor, kDeadReckoningColor};
    picture.polylines.push_back({.points = {foot, hipAt}, .color = colors[leftStands ? 0 : 1], .width = 10});
    picture.polylines.push_back({.points = {hipAt, swing}, .color = colors[leftStands ? 1 : 0], .width = 10});
    const auto ball = [&](const Eigen::Vector3d& at, double radius) {
      picture.solids.push_back({{.type = ShapeType::kSphere, .radius = radius},
                                translation(at.x(), at.y(), at.z()),
                                kTruthColor,
                                "mass"});
    };
    ball(hipAt, 0.03 * std::cbrt(hip)), ball(leg(foot, x[0], walker.a), 0.05),
        ball(leg(hipAt, x[1], -walker.b), 0.05);
    const Pose ramp = rotation(slope, Eigen::Vector3d::UnitY()) * translation(0, 0, -0.04);
    picture.solids.push_back(
        {{.type = ShapeType::kBox, .extent = {3, 0.5, 0.05}}, ramp, {0.82f, 0.84f, 0.86f}, "slope"});
    picture.captions.push_back(
        {.text = fell ? "it fell: " + coming.message : "steps: " + std::to_string(steps), .scale = 1.5});
    view.show(picture);
  }
}
