// Where should four fingers hold a can? The best of random grasps by the largest wrench, in any direction,
// that one newton of fingers can hold (Ferrari and Canny).
#include "course/course.h"
#include "grasping/object_surface.h"
#include "grasping/quality.h"

using namespace rex;

int main() {
  const Shape can{.type = ShapeType::kCylinder, .extent = {0, 0, 0.12}, .radius = 0.035};
  const ObjectSurface surface(can);
  const WrenchReference reference{.length = 0.07};  // metres: an arm that makes torques newtons

  Rng rng(1);
  double best = 0;
  std::vector<SurfacePoint> fingers;
  for (int trial = 0; trial < 300; ++trial) {
    const std::vector<SurfacePoint> points = surface.sample(rng, 4);
    const std::vector<WrenchCone> cones = wrenchCones(contactsAt(points, 0.6), reference);
    const double epsilon = graspQuality(primitiveWrenches(cones).wrenches).epsilon;
    if (epsilon <= best) continue;
    best = epsilon;
    fingers = points;
    print("better, epsilon [N]", best);
  }

  // The fingers as lines that end at the can, one metre up.
  Simulator S(SimulatorDescription{.sceneName = "empty.ors", .sceneText = "body nothing {}", .q = {}});
  S.addObstacle(can, translation(0, 0, 1), "can");
  PictureOptions look{.caption = "four fingers"};
  for (const SurfacePoint& one : fingers) {
    const Eigen::Vector3d tip = one.p_OQ + Eigen::Vector3d(0, 0, 1);
    look.points.push_back(tip);
    look.paths.push_back({tip, tip + 0.06 * one.normal_O});
  }
  writePicture(S, "grasp.png", look);
}
