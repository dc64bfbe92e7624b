#include "gallery/motion_figures.h"

#include <array>
#include <cmath>

#include "kinematics/closed_loops.h"
#include "kinematics/jacobians.h"
#include "locomotion/footsteps.h"
#include "locomotion/limit_cycle.h"
#include "locomotion/spring_walk.h"
#include "locomotion/walking_pattern.h"
#include "support/four_bar.h"
#include "trajectory/splines.h"

namespace rex {
namespace {

using Eigen::Vector2d;
using Eigen::Vector4d;
using Eigen::VectorXd;

const Color kGrey{0.45f, 0.45f, 0.45f};

void append(Series& series, double x, double y) {
  series.x.push_back(x);
  series.y.push_back(y);
}

// Five points on a board: one curve goes through them, one is pulled by them.
Figure splines() {
  constexpr int kSamples = 200;
  Eigen::Matrix2Xd points(2, 5);
  points << 0, 0.5, 1.2, 1.8, 2.4, /**/ 0, 0.9, 0.2, 1.0, 0.1;
  Figure figure{
      .title = "Splines through points, or in their convex hull",
      .xLabel = "x [m]",
      .yLabel = "y [m]",
      .legend = Legend::kOutside,
      .series = {{.label = "points", .style = SeriesStyle::kLinesPoints, .dashed = true, .color = kGrey},
                 {.label = "cubic spline, natural ends"},
                 {.label = "cubic spline, at rest at its ends"},
                 {.label = "B-spline, degree 3"}},
      .height = 450};
  for (const auto& point : points.colwise()) append(figure.series[0], point.x(), point.y());
  const VectorXd times = VectorXd::LinSpaced(points.cols(), 0, 1);
  const CubicSpline natural(times, points),
      atRest(times, points, {.startVelocity = Vector2d::Zero(), .endVelocity = Vector2d::Zero()});
  const BSpline pulled(points, 3, 1);
  for (int i = 0; i <= kSamples; ++i) {
    const double t = static_cast<double>(i) / kSamples;
    const VectorXd values[] = {natural.value(t), atRest.value(t), pulled.value(t)};
    for (std::size_t k = 0; k < std::size(values); ++k)
      append(figure.series[k + 1], values[k].x(), values[k].y());
  }
  return figure;
}

// How far to the side the centre of mass leans so that the zero moment point steps from foot to foot.
Figure preview() {
  const PreviewOptions options{};
  const WalkPlan plan{.footsteps = straightFootsteps(5, 0.3, 0.2)};
  const Eigen::Matrix2Xd reference = zmpReference(plan, options.step);
  const PreviewMotion motion = followZmp(reference, options);
  Figure figure{
      .title = "The body leans before the foot is lifted: preview control",
      .xLabel = "time [s]",
      .yLabel = "to the left [m]",
      .legend = Legend::kOutside,
      .series = {{.label = "centre of mass"},
                 {.label = "zero moment point", .size = 1.6},
                 {.label = "zero moment point, reference", .dashed = true, .color = Color{0.1f, 0.1f, 0.1f}}},
      .height = 420};
  for (Eigen::Index k = 0; k < reference.cols(); k += 2) {
    const double time = static_cast<double>(k) * options.step;
    append(figure.series[0], time, motion.c(1, k));
    append(figure.series[1], time, motion.zmp(1, k));
    append(figure.series[2], time, reference(1, k));
  }
  return figure;
}

// One leg of the compass gait: it stands, is exchanged by an impact, and swings.
void appendSteps(const CompassGait& walker, Vector4d x, int steps, Series& series) {
  constexpr int kSamples = 100;
  for (int leg = 0; leg < steps; ++leg) {
    const WalkerStep step = walker.step(x);
    if (step.status != StepStatus::kStepped) return;
    const int part = leg % 2;  // the leg that is followed stands, then swings
    const double dt = step.time / kSamples;
    for (int i = 0; i <= kSamples; ++i) {
      append(series, x[part], x[2 + part]);
      const Vector4d k1 = walker.derivative(x), k2 = walker.derivative(x + dt / 2 * k1),
                     k3 = walker.derivative(x + dt / 2 * k2), k4 = walker.derivative(x + dt * k3);
      x += dt / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
    }
    x = step.after;
  }
}

Figure gait() {
  const CompassGait walker;
  const LimitCycle cycle = findLimitCycle(walker, {0.22, -0.32, -1.1, -0.4});
  Figure figure{
      .title = "A compass walker on a slope of 3 degrees returns to its limit cycle",
      .xLabel = "angle of a leg [rad]",
      .yLabel = "rate [rad/s]",
      .legend = Legend::kOutside,
      .series = {{.label = "perturbed start", .color = kGrey}, {.label = "limit cycle", .size = 1.4}},
      .height = 420};
  appendSteps(walker, cycle.x + Vector4d(0, 0, -0.12, -0.1), 12, figure.series[0]);
  appendSteps(walker, cycle.x, 3, figure.series[1]);
  return figure;
}

// What points of the coupler of a four-bar draw while its crank turns.
Figure couplerCurves() {
  const FourBar bar;
  const Model model = compile(bar.scene());
  const std::vector<TaskMap> loops = pinTasks(model);
  constexpr std::array<int, 1> kCrank{0};
  const Vector2d points[] = {{0.45, 0.35}, {0.9, 0.5}, {0.45, -0.35}};
  Figure figure{.title = "Coupler curves of a four-bar linkage, a closed loop",
                .xLabel = "x [m]",
                .yLabel = "z [m]",
                .equalAxes = true,
                .legend = Legend::kOutside,
                .series = {{.label = "crank, coupler, rocker",
                            .style = SeriesStyle::kLinesPoints,
                            .size = 2.4,
                            .color = kGrey},
                           {.label = "a point above"},
                           {.label = "one above its end"},
                           {.label = "one below"}},
                .height = 420};
  VectorXd q = bar.closedForm(0.9);
  const auto placed = [&](const char* body, double x, double z) -> Vector2d {
    const Eigen::Vector3d p = position(forwardKinematics(model, q), model.body(body), {x, 0, z});
    return {p.x(), p.z()};
  };
  for (const Vector2d& p :
       {Vector2d(0, 0), placed("coupler", 0, 0), placed("coupler", bar.coupler, 0), Vector2d(bar.ground, 0)})
    append(figure.series[0], p.x(), p.y());
  for (int k = 0; k <= 180; ++k) {
    q[0] = 0.9 + k * M_PI / 90;
    q = assemble(model, loops, q, kCrank).q;
    for (std::size_t i = 0; i < std::size(points); ++i) {
      const Vector2d p = placed("coupler", points[i].x(), points[i].y());
      append(figure.series[i + 1], p.x(), p.y());
    }
  }
  return figure;
}

// How hard each leg of a walker on springs pushes upwards, step by step.
Figure springWalk() {
  const SpringLeg leg{.stiffness = 14000, .angle = 1.2042771838760873};  // 69 degrees
  const WalkingGait gait = findWalkingGait(leg, {.height = 0.97, .speed = 1.1});
  const double weight = leg.mass * leg.g;
  Figure figure{.title = "Ground reaction force in walking: two humps for each step",
                .xLabel = "time [s]",
                .yLabel = "vertical force / weight",
                .legend = Legend::kOutside,
                .series = {{.label = "one leg"},
                           {.label = "the other leg"},
                           {.label = "both together", .dashed = true, .color = kGrey}},
                .height = 420};
  double before = 0;
  for (std::size_t step = 0; step < 4; ++step) {
    const std::vector<WalkSample> samples = walkSamples(leg, gait.at, 60);
    for (const WalkSample& at : samples) {
      append(figure.series[step % 2], before + at.time, at.hind[1] / weight);
      append(figure.series[(step + 1) % 2], before + at.time, at.front[1] / weight);
      append(figure.series[2], before + at.time, (at.hind + at.front)[1] / weight);
    }
    before += samples.back().time;
  }
  return figure;
}

}  // namespace

std::vector<std::pair<std::string, Figure>> motionFigures() {
  return {{"splines", splines()},
          {"preview-control", preview()},
          {"compass-gait", gait()},
          {"spring-walk", springWalk()},
          {"four-bar", couplerCurves()}};
}

}  // namespace rex
