// Chapter 11: Raibert's hopper. One leg, three controllers: thrust for the height, position of the foot for
// the speed, the hip's torque for the attitude. Sliders ask for height and speed; switch a controller off by
// setting its gain to zero.
// Slides: 11:4
// Formula: x_foot = x' T_s / 2 + k (x' - x'*)
// Try: One leg, three controllers. Change "speed" and press "tilt". Set "position of the foot" or "hip
// damping" to zero: it hardly moves, or rocks.
#include "course/car_view.h"
#include "course/course.h"
#include "course/live_view.h"
#include "render/picture.h"
#include "systems/raibert_hopper.h"

using namespace rex;

int main() {
  LiveView view("hopper");
  view.lookFrom({0, -2, 0.2});
  const RaibertHopper hopper;
  HopperApex apex;
  std::vector<HopperSample> way;  // of the hop that is shown
  std::size_t at = 0;
  int fallen = 0;
  double clock = 0;           // of that hop, seconds
  double push = 0, tilt = 0;  // that wait for the next one
  std::string text = "hops";
  for (int t = 0; t < 450 || view.isWatched(); ++t) {
    const HopperCommand command{.height = view.slider("height [m]", 1.1, 1.8, 1.3),
                                .speed = view.slider("speed [m/s]", -2, 2, 1)};
    const RaibertGains gains{.height = view.slider("thrust for the height", 0, 0.2, 0.06),
                             .placement = view.slider("position of the foot [s]", 0, 0.15, 0.06),
                             .attitude = view.slider("hip [N m/rad]", 0, 60, 15),
                             .rate = view.slider("hip damping [N m s/rad]", 0, 30, 10)};
    if (view.button("push forward") || t == 225) push += 1;
    if (view.button("tilt")) tilt += 0.4;
    if (at >= way.size() && fallen == 0) {  // at the highest point
      apex.speed += std::exchange(push, 0), apex.pitch += std::exchange(tilt, 0);
      way = hopSamples(hopper, gains, command, apex, 60);
      const HopperHop next = hop(hopper, gains, command, apex);
      text = next.message;
      if (next.status == HopStatus::kHopped)
        apex = next.apex;
      else
        fallen = 60;
      at = 0, clock = 0;
    }
    for (clock += 1. / 30; at < way.size() && way[at].time < clock;) ++at;
    if (fallen > 0 && --fallen == 0) apex = {}, at = way.size();
    const HopperSample& now = way[std::min(at, way.size() - 1)];
    Picture picture{.ground = {.visible = false}};
    // The camera hops along.
    const double x = now.hip.x();
    for (int k = -2; k <= 2; ++k)
      picture.solids.push_back({{.type = ShapeType::kBox, .extent = {0.96, 1, 0.04}},
                                translation(std::floor(x) + k + 0.5 - x, 0, -0.02),
                                static_cast<int>(std::floor(x) + k) % 2 == 0 ? Color{0.85f, 0.87f, 0.9f}
                                                                             : Color{0.93f, 0.94f, 0.96f},
                                "floor"});
    const Eigen::Vector3d hip(0, 0, now.hip.y()), foot(now.foot.x() - x, 0, now.foot.y());
    picture.polylines.push_back({.points = {hip, foot}, .color = kDeadReckoningColor, .width = 9});
    picture.solids.push_back({{.type = ShapeType::kBox, .extent = {0.9, 0.3, 0.2}},
                              translation(0, 0, hip.z()) * rotation(-now.pitch, Eigen::Vector3d::UnitY()),
                              kEstimateColor,
                              "body"});
    picture.captions.push_back(
        {.text = fallen > 0 ? text : "hop of " + std::to_string(apex.height).substr(0, 4) + " m",
         .scale = 1.5});
    view.plot("height of the hip [m]", t / 30., now.hip.y());
    view.plot("speed [m/s]", t / 30., apex.speed);
    view.plot("pitch [rad]", t / 30., now.pitch);
    view.show(picture);
  }
}
