// Chapter 4: The shortest curves of a car. Dubins' car (blue) drives forward only, that of Reeds and Shepp
// (orange) also backward. Drag the goal; its heading turns. Lengths jump where another word of left, straight
// and right becomes the shortest one.
// Slides: 4:61
// Formula: words of left, straight and right with curvature 1/r: LSL, RSR, LSR, RSL, RLR, LRL
// Try: Shortest curves of a car: Dubins only forward, Reeds-Shepp also backward. Drag the goal close to the
// car.
#include <cstdio>

#include "course/car_pictures.h"
#include "course/course.h"
#include "course/live_view.h"
#include "planning/car_curves.h"
#include "render/picture.h"

using namespace rex;

std::string described(const char* name, const Curve& curve) {
  std::string text = name;
  char number[48];
  std::snprintf(number, sizeof number, "%10.6f m  ", curve.length());
  text += number + curve.word() + " ";
  for (const CurveSegment& one : curve.segments()) {
    std::snprintf(number, sizeof number, "%9.4f", one.length);
    text += number;
  }
  return text;
}

DrawnPath pathAlong(const Curve& curve, const Color& color) {
  DrawnPath path{.points = Eigen::Matrix2Xd(2, 200), .color = color, .width = 4};
  for (int i = 0; i < 200; ++i) path.points.col(i) = curve.pose(curve.length() * i / 199).head<2>();
  return path;
}

int main() {
  LiveView view("curves");
  view.lookFrom({0, -0.3, 1});
  for (int t = 0; t < 360 || view.isWatched(); ++t) {
    const double radius = view.slider("turning radius [m]", 0.2, 4, 1),
                 pace = view.slider("turn the goal [rad/s]", 0, 2, 0.5236);
    static double heading = 0;
    const Eigen::Vector3d goal = view.handle("goal", {-1, 1, 0}, {0, 0, 1});
    const Eigen::Vector3d from(0, 0, 0), to(goal.x(), goal.y(), heading);
    const Curve dubins = dubinsCurve(from, to, radius), both = reedsSheppCurve(from, to, radius);
    if (t == 0)
      std::printf("length, word, and metres of each segment, negative: backward\n%s\n%s\n",
                  described("Dubins     ", dubins).c_str(), described("Reeds-Shepp", both).c_str());
    view.plot("Dubins [m]", heading, dubins.length(), "heading of the goal [rad]");
    view.plot("Reeds and Shepp [m]", heading, both.length(), "heading of the goal [rad]");
    Picture picture = carPicture(
        CarView{.car = from,
                .estimate = to,
                .carScale = 0.25,
                .paths = {pathAlong(dubins, kEstimateColor), pathAlong(both, kDeadReckoningColor)}});
    picture.captions = {{.text = described("Dubins", dubins)}, {.text = described("Reeds-Shepp", both)}};
    picture.polylines.push_back(
        {.points = {{-5, -5, 0}, {5, -5, 0}, {5, 5, 0}, {-5, 5, 0}, {-5, -5, 0}}, .color = kTruthColor});
    view.show(picture);
    heading += pace / 30;
  }
}
