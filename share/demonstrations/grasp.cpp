// Chapter 10: Force closure. Fingers move on a disc (left); the hull of their wrenches (right: forces x and
// y, torque upward) turns from orange to blue when it holds zero inside, with the largest ball in it. The
// mouse moves the fingers.
// Slides: 10:9
// Formula: 0 inside conv{w_i}, w = (f, (p - c) × f), f on the edges of the friction cones
// Try: Drag the fingers and watch whether the hull of wrenches contains the origin. Without "friction" it
// never does.
#include "course/car_view.h"
#include "course/course.h"
#include "course/live_view.h"
#include "geometry/convex_hull.h"
#include "grasping/quality.h"
#include "render/picture.h"

using namespace rex;

int main() {
  LiveView view("grasp");
  view.lookFrom({0.25, -1.2, 1});
  for (int t = 0; t < 300 || view.isWatched(); ++t) {
    const double friction = view.slider("friction", 0, 1, 0.25),
                 move = view.slider("third finger moves by [rad]", 0, 3, 2.4);
    double angles[] = {0.5, 2.6, -1.57};
    const char* names[] = {"first", "second", "third"};
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector3d start(1.8 * std::cos(angles[k]) - 1.9, 1.8 * std::sin(angles[k]), 0.2);
      const Eigen::Vector3d hold = view.handle(names[k], start, Eigen::Vector3d::UnitZ());
      angles[k] = std::atan2(hold.y(), hold.x() + 1.9);
    }
    angles[2] += move * std::sin(t / 23.873);
    std::vector<PlanarContact> fingers;
    for (const double angle : angles) {
      const Eigen::Vector2d out(std::cos(angle), std::sin(angle));
      fingers.push_back({.p_OC = out, .normal_O = -out, .friction = friction});
    }
    const WrenchSet edges = primitiveWrenches(wrenchCones(fingers));
    const GraspQuality quality = graspQuality(edges.wrenches);
    const bool isHeld = quality.status == HullStatus::kInside;
    const Color color = isHeld ? kEstimateColor : kDeadReckoningColor;

    Picture picture{.ground = {.visible = false}};
    picture.solids.push_back({{.type = ShapeType::kCylinder, .extent = {0, 0, 0.3}, .radius = 1},
                              translation(-1.9, 0, 0),
                              {0.8f, 0.8f, 0.82f},
                              "disc"});
    for (const PlanarContact& one : fingers) {
      const Eigen::Vector3d tip(one.p_OC.x() - 1.9, one.p_OC.y(), 0.2),
          in(one.normal_O.x(), one.normal_O.y(), 0);
      picture.arrows.push_back({.from = tip - 0.8 * in, .to = tip, .color = kTruthColor, .radius = 0.05});
      for (const double side : {-1., 1.})  // the friction cone
        picture.polylines.push_back(
            {.points = {tip, tip + 0.6 * (in + side * friction * Eigen::Vector3d(-in.y(), in.x(), 0))},
             .color = kScanColor,
             .width = 4});
    }
    const Pose middle = translation(1.9, 0, 0);
    const Eigen::Vector3d place = middle.p;
    std::vector<Eigen::Vector3f> corners;
    for (const auto& w : edges.wrenches.colwise())
      corners.push_back(Eigen::Vector3d(w[0], w[1], w[2]).cast<float>());
    const TriangleMesh hull = convexHull(corners);
    LineSet lines{.color = color, .width = 2.5};
    for (const auto& corner : corners)
      for (const auto& other : corners) {
        if (&corner < &other)
          lines.segments.push_back({place + corner.cast<double>(), place + other.cast<double>()});
      }
    picture.lineSets.push_back(lines);
    Color pale = color;
    pale.a = 0.3f;
    if (!hull.triangles().empty())
      picture.solids.push_back({{.type = ShapeType::kMesh, .mesh = hull}, middle, pale, "hull"});
    if (isHeld)
      picture.ellipsoids.push_back({.X_WE = middle,
                                    .radii = Eigen::Vector3d::Constant(quality.epsilon),
                                    .color = {0, 0.62f, 0.45f, 0.6f}});
    picture.pointSets.push_back({.points = {place}, .color = kTruthColor, .size = 10});
    picture.labels.push_back({.text = isHeld ? "force closure" : "no force closure",
                              .p_WQ = place + Eigen::Vector3d(0, 0, 1.2),
                              .scale = 1.5});
    picture.polylines.push_back(
        {.points =
             {{-3.8, -1.9, -0.8}, {3.2, -1.9, -0.8}, {3.2, 1.9, -0.8}, {-3.8, 1.9, -0.8}, {-3.8, -1.9, -0.8}},
         .color = kTruthColor});
    view.plot("epsilon [N]", t / 30., quality.epsilon);
    view.show(picture);
  }
}
