// Chapter 4: Potential fields and their local minima. Eight robots roll downhill to the goal (orange) around
// a box and a pocket that moves; those that end in a local minimum are pink. The mouse moves pocket and
// goal.
// Slides: 4:13 to 4:17
// Formula: q' = -∇(U_goal + U_obstacles)
// Try: Pink paths end in a local minimum. Set "reach" to 0.2: paths graze the boxes. Drag the pocket or the
// goal.
#include "course/car_view.h"
#include "course/course.h"
#include "course/live_view.h"
#include "planning/potential_field.h"
#include "render/picture.h"

using namespace rex;

int main() {
  LiveView view("potential");
  view.lookFrom({0, -0.25, 1});
  for (int t = 0; t < 240 || view.isWatched(); ++t) {
    const Eigen::Vector3d up = Eigen::Vector3d::UnitZ(), pocket = view.handle("pocket", {5.9, 4, 0.5}, up),
                          to = view.handle("goal", {10.9, 4, 0}, up);
    const double move = view.slider("pocket moves by [m]", 0, 2, 1.5);
    const double repulsion = view.slider("repulsion", 0.01, 3, 0.4),
                 reach = view.slider("reach [m]", 0.2, 2, 1);
    const double x = pocket.x(), y = pocket.y() + move * std::sin(t / 38.1972);
    GridMap map(60, 40, 0.2);
    Picture picture{.ground = {.visible = false}};
    const Eigen::Array4d boxes[] = {{x + 0.7, y - 1, x + 1.1, y + 1},
                                    {x - 0.3, y - 1, x + 0.7, y - 0.6},
                                    {x - 0.3, y + 0.6, x + 0.7, y + 1},
                                    {3, 1, 3.8, 2.2}};
    for (const Eigen::Array4d& b : boxes)
      for (int i = 0; i < 60; ++i)
        for (int j = 0; j < 40; ++j)
          if (const Eigen::Vector2d c = map.center({i, j});
              b[0] < c.x() && c.x() < b[2] && b[1] < c.y() && c.y() < b[3])
            map.setBlocked({i, j});
    for (const Eigen::Array4d& b : boxes)
      picture.solids.push_back({{.type = ShapeType::kBox, .extent = {b[2] - b[0], b[3] - b[1], 0.4}},
                                translation((b[0] + b[2]) / 2, (b[1] + b[3]) / 2, 0.2),
                                kTruthColor,
                                "obstacle"});
    const Eigen::Vector2d goal(std::clamp(to.x(), 0.1, 11.9), std::clamp(to.y(), 0.1, 7.9));
    const PotentialField field(map, goal, {.attraction = 0.1, .repulsion = repulsion, .reach = reach});
    LineSet slopes{.color = {0.6f, 0.63f, 0.67f}, .width = 1.5};
    for (double px = 0.3; px < 12; px += 0.6)
      for (double py = 0.3; py < 8; py += 0.6)
        if (const Eigen::Vector2d p(px, py); std::isfinite(field.potential(p))) {
          const Eigen::Vector2d d = p - 0.35 * field.gradient(p).normalized();
          slopes.segments.push_back({{px, py, 0}, {d.x(), d.y(), 0}});
        }
    picture.lineSets.push_back(slopes);
    int stuck = 0;
    for (int k = 0; k < 8; ++k) {
      const Descent way = descend(field, {0.5, 0.5 + k}, 0.1, 400);
      const bool isThere = way.status == DescentStatus::kReached;
      stuck += !isThere;
      Polyline line{.color = isThere ? kEstimateColor : kScanColor, .width = 4};
      for (const Eigen::Vector2d& p : way.points) line.points.push_back({p.x(), p.y(), 0.03});
      picture.pointSets.push_back({.points = {line.points.back()}, .color = line.color, .size = 14});
      if (line.points.size() > 1) picture.polylines.push_back(line);
    }
    picture.polylines.push_back(
        {.points = {{0, 0, 0}, {12, 0, 0}, {12, 8, 0}, {0, 8, 0}, {0, 0, 0}}, .color = kTruthColor});
    picture.pointSets.push_back(
        {.points = {{goal.x(), goal.y(), 0.05}}, .color = kDeadReckoningColor, .size = 20});
    picture.captions.push_back({.text = std::to_string(stuck) + " of 8 in a local minimum", .scale = 1.5});
    view.plot("robots in a local minimum", t / 30., stuck);
    view.show(picture);
  }
}
