// Chapter 3: PID control. Three masses on rails under the same load: P swings for ever, PD comes to rest
// below its target, and the integral of PID lifts it up. Sliders change the gains and the load.
// Slides: 3:15 to 3:17
// Formula: u = Kp (q* - q) - Kd q' + Ki ∫ (q* - q) dt
// Try: P oscillates, PD stays below its target, PID reaches it. With "load" zero, PD reaches it, too. With
// "Kd" 1 and "Ki" 60, PID is unstable.
#include "control/point_mass.h"
#include "course/car_view.h"
#include "course/course.h"
#include "course/live_view.h"
#include "render/picture.h"

using namespace rex;

int main() {
  LiveView view("pid");
  view.lookFrom({0, -1, 0.15});
  const double h = 1. / 300;
  const char* names[] = {"P", "PD", "PID"};
  PointMassState mass[3];
  double integral[3] = {};
  double target = 1;
  for (int t = 0; t < 360 || view.isWatched(); ++t) {
    const double Kp = view.slider("Kp", 0, 100, 30), Ki = view.slider("Ki", 0, 60, 25);
    const double Kd = view.slider("Kd", 0, 20, 6), load = view.slider("load [N]", 0, 20, 8);
    if (view.button("step") || (t % 180 == 179 && !view.isWatched())) target = target > 1.2 ? 1 : 1.6;
    if (view.button("from the start"))
      for (int k = 0; k < 3; ++k) mass[k] = {}, integral[k] = 0;

    Picture picture{.ground = {.height = -0.3}};
    for (int k = 0; k < 3; ++k) {
      for (int i = 0; i < 10; ++i) {  // ten steps between two pictures
        const double error = target - mass[k].q;
        integral[k] += h * error;
        const double u = Kp * error - (k > 0 ? Kd * mass[k].v : 0) + (k > 1 ? Ki * integral[k] : 0);
        mass[k] = PointMass{}.eulerStep(mass[k], u - load, h);
        mass[k].q = std::clamp(mass[k].q, -0.2, 2.4), mass[k].v = std::clamp(mass[k].v, -20., 20.);
      }
      view.plot(std::string("height of ") + names[k] + " [m]", t / 30., mass[k].q);
      const double x = 0.7 * (k - 1);
      picture.solids.push_back({{.type = ShapeType::kCylinder, .extent = {0, 0, 2.8}, .radius = 0.02},
                                translation(x, 0, 1.1),
                                kTruthColor,
                                "rail"});
      picture.solids.push_back({{.type = ShapeType::kBox, .extent = {0.3, 0.2, 0.2}},
                                translation(x, 0, mass[k].q),
                                kEstimateColor,
                                "mass"});
      picture.polylines.push_back(
          {.points = {{x - 0.28, -0.15, target}, {x + 0.28, -0.15, target}}, .width = 4});
      picture.labels.push_back({.text = names[k], .p_WQ = {x, 0, 2.6}, .scale = 2});
      if (load > 0)
        picture.arrows.push_back({.from = {x, -0.12, mass[k].q},
                                  .to = {x, -0.12, mass[k].q - 0.05 * load},
                                  .color = kScanColor,
                                  .radius = 0.02});
    }
    picture.captions.push_back({.text = "orange: target, violet: load"});
    view.show(picture);
  }
}
