// Chapter 5: Path optimisation. A path of 40 points with smooth accelerations bends round two discs that
// move; each picture shows a few Gauss-Newton steps more. Sliders weigh obstacles against smoothness and move
// the discs.
// Slides: 5:3
// Formula: min Σ |q_t-1 - 2 q_t + q_t+1|² + ρ Σ collision(q_t)²
// Try: A path avoids moving discs. Raise "weight of accelerations": it becomes stiff and cuts into them.
#include "course/car_view.h"
#include "course/course.h"
#include "course/live_view.h"
#include "render/picture.h"
#include "trajectory/motion_terms.h"
#include "trajectory/trajectory_optimizer.h"

using namespace rex;

int main() {
  LiveView view("pathopt");
  view.lookFrom({0, -0.25, 1});
  const int steps = 40;
  const Eigen::Vector2d start(0.5, 3), goal(9.5, 3);
  Eigen::MatrixXd X = straightTrajectory(start, goal, steps);
  for (int t = 0; t < 300 || view.isWatched(); ++t) {
    const double weight = view.slider("weight of obstacles", 0, 10, 5),
                 smooth = view.slider("weight of accelerations", 0.1, 10, 1);
    const double radius = view.slider("radius of discs [m]", 0.2, 1.5, 0.9),
                 move = view.slider("discs move by [m]", 0, 2, 1.4);
    if (view.button("straight again")) X = straightTrajectory(start, goal, steps);
    const Eigen::Vector2d discs[] = {{3.4, 3 + move * std::sin(t / 30.)},
                                     {6.6, 3 - move * std::sin(t / 30. + 0.7)}};
    // How deep a point is within 0.3 m of each disc, and the derivative of that.
    const auto nearness = [&](const TrajectoryWindow& window, FunctionValue& out) {
      out.y = Eigen::VectorXd::Zero(2), out.J = Eigen::MatrixXd::Zero(2, 2);
      for (int k = 0; k < 2; ++k) {
        const Eigen::Vector2d away = window.X.col(0) - discs[k];
        const double depth = radius + 0.3 - away.norm();
        if (depth > 0 && away.norm() > 1e-6)
          out.y[k] = weight * depth, out.J.row(k) = -weight * away.normalized().transpose();
      }
    };
    std::vector<TrajectoryTerm> terms = {accelerationTerm(Eigen::Vector2d::Constant(smooth)),
                                         {.name = "obstacles", .function = nearness}};
    const auto atGoal = [&](const TrajectoryWindow& window, FunctionValue& out) {
      out.y = 30 * (window.X.col(0) - goal), out.J = 30 * Eigen::Matrix2d::Identity();
    };
    terms.push_back({.name = "goal", .function = atGoal, .first = steps - 2});  // twice: at rest
    const TrajectoryProblem problem(terms, start.replicate(1, 2), steps, 0.1);
    X = optimizeTrajectory(problem, X, {.maxIterations = 3}).X;

    Picture picture{.ground = {.visible = false}};
    for (const Eigen::Vector2d& d : discs)
      picture.solids.push_back({{.type = ShapeType::kCylinder, .extent = {0, 0, 0.3}, .radius = radius},
                                translation(d.x(), d.y(), 0.15),
                                kTruthColor,
                                "disc"});
    Polyline path{.points = {{start.x(), start.y(), 0.32}}, .color = kEstimateColor, .width = 5};
    double clearance = 1e9, effort = 0;
    for (int i = 0; i < steps; ++i) {
      path.points.push_back({X(0, i), X(1, i), 0.32});
      for (const Eigen::Vector2d& d : discs) clearance = std::min(clearance, (X.col(i) - d).norm() - radius);
      if (i > 1) effort += (X.col(i) - 2 * X.col(i - 1) + X.col(i - 2)).squaredNorm();
    }
    picture.pointSets.push_back({.points = path.points, .color = kEstimateColor, .size = 8});
    picture.polylines.push_back(path);
    picture.pointSets.push_back(
        {.points = {{goal.x(), goal.y(), 0.32}}, .color = kDeadReckoningColor, .size = 18});
    picture.polylines.push_back(
        {.points = {{0, 0, 0}, {10, 0, 0}, {10, 6, 0}, {0, 6, 0}, {0, 0, 0}}, .color = kTruthColor});
    view.plot("clearance [m]", t / 30., clearance);
    view.plot("sum of squared second differences", t / 30., effort);
    view.show(picture);
  }
}
