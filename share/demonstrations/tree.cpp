// Chapter 4: A rapidly exploring random tree. It grows from the start (blue) until it finds the goal (orange)
// behind the walls. Move the goal with the mouse, or change step and goal bias: a new tree starts.
// Slides: 4:40, 4:41
// Formula: q_new = q_near + step (q_target - q_near) / |q_target - q_near|
// Try: A tree grows to its goal through passages. Set "goal bias" to 0.5: it sticks to the walls and seldom
// arrives.
#include "course/car_view.h"
#include "course/course.h"
#include "course/live_view.h"
#include "planning/rrt.h"
#include "render/picture.h"

using namespace rex;

int main() {
  LiveView view("tree");
  view.lookFrom({0, -0.25, 1});
  const Eigen::Array4d walls[] = {
      {2.6, 0, 3.0, 4.2}, {5.6, 1.8, 6.0, 6}, {7.6, 0, 8.0, 3.6}};  // from x, y to x, y
  const auto isFree = [&](const VectorArg& q) {
    for (const Eigen::Array4d& w : walls)
      if (w[0] < q[0] && q[0] < w[2] && w[1] < q[1] && q[1] < w[3]) return false;
    return true;
  };
  PathProblem problem{.space = Space::box(Eigen::Vector2d(0, 0), Eigen::Vector2d(10, 6)),
                      .allValid = eachColumn(isFree),
                      .start = Eigen::Vector2d(0.8, 0.8)};
  Eigen::Vector4d last = Eigen::Vector4d::Zero();
  int seed = 1, age = 0;
  for (int t = 0; t < 330 || view.isWatched(); ++t, ++age) {
    const Eigen::Vector3d goal = view.handle("goal", {9.2, 1, 0}, Eigen::Vector3d::UnitZ());
    const double x = std::clamp(goal.x(), 0., 10.), y = std::clamp(goal.y(), 0., 6.);
    const double step = view.slider("step [m]", 0.05, 1, 0.25), bias = view.slider("goal bias", 0, 0.5, 0.05);
    if (view.button("another tree") || age == 300) last[0] = -1, ++seed;
    if (const Eigen::Vector4d now(x, y, step, bias); now != last) last = now, age = 0;
    problem.goal = Eigen::Vector2d(x, y);
    Picture picture{.ground = {.visible = false}};
    for (const Eigen::Array4d& w : walls)
      picture.solids.push_back({{.type = ShapeType::kBox, .extent = {w[2] - w[0], w[3] - w[1], 0.1}},
                                translation((w[0] + w[2]) / 2, (w[1] + w[3]) / 2, -0.05),
                                kTruthColor,
                                "wall"});
    picture.polylines.push_back(
        {.points = {{0, 0, 0}, {10, 0, 0}, {10, 6, 0}, {0, 6, 0}, {0, 0, 0}}, .color = kTruthColor});
    picture.pointSets.push_back({.points = {{0.8, 0.8, 0}}, .color = kEstimateColor, .size = 16});
    picture.pointSets.push_back({.points = {{x, y, 0}}, .color = kDeadReckoningColor, .size = 16});
    std::string says = "the goal is inside a wall";
    if (isFree(problem.goal)) {
      Rng rng(seed);  // the same random targets again, and five more
      const PathResult found =
          growRrt(problem, {.stepSize = step, .goalBias = bias, .maxSamples = 1 + 5 * age}, rng);
      LineSet tree{.color = kEstimateColor, .width = 2};
      for (const PathTree& one : found.trees)
        for (int i = 0; i < one.nodes.cols(); ++i)
          if (const int p = one.parents[i]; p >= 0)
            tree.segments.push_back(
                {{one.nodes(0, i), one.nodes(1, i), 0.02}, {one.nodes(0, p), one.nodes(1, p), 0.02}});
      if (!tree.segments.empty()) picture.lineSets.push_back(tree);
      Polyline path{.width = 6};
      for (const auto& q : found.path.colwise()) path.points.push_back({q[0], q[1], 0.05});
      if (path.points.size() > 1) picture.polylines.push_back(path);
      const char* end = found.path.size() > 0 ? ": a path" : ": no path yet";
      says = std::to_string(found.samples) + " targets" + end;
      view.plot("nodes of the tree", t / 30., static_cast<double>(tree.segments.size()));
    }
    picture.captions.push_back({.text = says, .scale = 1.5});
    view.show(picture);
  }
}
