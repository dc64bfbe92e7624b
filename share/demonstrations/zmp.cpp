// Chapter 11: The zero moment point. A body (blue) walks over footprints by preview control: it sways before
// the zero moment point (orange) has to be under the next foot. With little preview it leaves the feet.
// Sliders change the walk.
// Slides: 11:12
// Formula: zmp = x - (z / g) x''
// Try: A body sways before the foot lands. With a "preview" of 0.3 s the zero moment point leaves the feet.
#include "course/car_view.h"
#include "course/course.h"
#include "course/live_view.h"
#include "locomotion/footsteps.h"
#include "locomotion/walking_pattern.h"
#include "render/picture.h"

using namespace rex;

int main() {
  LiveView view("zmp");
  view.lookFrom({-0.5, -1.2, 1});
  Eigen::Vector4d last = Eigen::Vector4d::Zero();
  WalkPlan plan;
  PreviewMotion motion;
  double time = 0;
  for (int t = 0; t < 255 || view.isWatched(); ++t) {
    const Eigen::Vector4d now(view.slider("preview [s]", 0.05, 2, 1.6),
                              view.slider("length of steps [m]", 0, 0.5, 0.25),
                              view.slider("seconds on one foot", 0.3, 1.5, 0.7),
                              view.slider("height of the mass [m]", 0.3, 1.5, 0.8));
    if (view.button("from the start") || now != last || time > duration(plan)) {
      plan = {.footsteps = straightFootsteps(7, now[1], 0.2), .singleSupport = now[2], .rest = 1};
      motion = followZmp(zmpReference(plan, 0.01), {.height = now[3], .step = 0.01, .preview = now[0]});
      last = now, time = 0;
    }
    const int i = std::min(static_cast<int>(time / 0.01), static_cast<int>(motion.c.cols()) - 1);
    const WalkPhase phase = phaseAt(plan, time);
    const auto at = [&](const Eigen::Vector2d& p, double z) { return Eigen::Vector3d(p.x(), p.y(), z); };
    Picture picture;
    const auto print = [&](const Footstep& one, const Color& color, double height) {
      picture.solids.push_back(
          {{.type = ShapeType::kBox, .extent = {plan.sole.length, plan.sole.width, height}},
           translation(one.p.x(), one.p.y(), height / 2),
           color,
           "foot"});
    };
    for (const Footstep& one : plan.footsteps) print(one, {0.75f, 0.77f, 0.8f}, 0.01);
    print(phase.left, kLandmarkColor, phase.swing && phase.swing->side == Side::kLeft ? 0.012 : 0.03);
    print(phase.right, kLandmarkColor, phase.swing && phase.swing->side == Side::kRight ? 0.012 : 0.03);
    const Eigen::Vector2d c = motion.c.col(i), p = motion.zmp.col(i);
    picture.solids.push_back({{.type = ShapeType::kSphere, .radius = 0.08},
                              translation(c.x(), c.y(), now[3]),
                              kEstimateColor,
                              "mass"});
    picture.solids.push_back({{.type = ShapeType::kSphere, .radius = 0.025},
                              translation(p.x(), p.y(), 0.04),
                              kDeadReckoningColor,
                              "zmp"});
    picture.polylines.push_back({.points = {at(p, 0.04), at(c, now[3])}, .color = kTruthColor, .width = 4});
    Polyline ways[] = {{.color = kEstimateColor, .width = 4}, {.color = kDeadReckoningColor, .width = 4}};
    for (int k = 0; k <= i; k += 2)
      ways[0].points.push_back(at(motion.c.col(k), 0.035)),
          ways[1].points.push_back(at(motion.zmp.col(k), 0.035));
    for (const Polyline& one : ways)
      if (one.points.size() > 1) picture.polylines.push_back(one);
    view.plot("sideways: body [m]", time, c.y());
    view.plot("sideways: zero moment point [m]", time, p.y());
    view.plot("how far inside the feet [m]", time, supportMargin(supportPolygon(phase, plan.sole), p).margin);
    time += 1. / 30;
    view.show(picture);
  }
}
