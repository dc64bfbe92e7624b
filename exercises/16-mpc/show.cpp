#include "show.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <string>

#include "control/regulators.h"
#include "course/cart_pole_pictures.h"
#include "systems/cart_pole.h"

using namespace rex;

namespace {

using Law = std::function<Eigen::VectorXd(const Eigen::VectorXd& x)>;

Law cutOff(const Task& task, const Eigen::MatrixXd& K) {
  return [task, K](const Eigen::VectorXd& x) -> Eigen::VectorXd {
    return Eigen::VectorXd(-(K * x)).cwiseMax(task.uMin).cwiseMin(task.uMax);
  };
}

Law planning(const Task& task) {
  return [task](const Eigen::VectorXd& x) -> Eigen::VectorXd { return planned(task, x).col(0); };
}

Drive followed(const Plant& plant, const Law& law, const Eigen::VectorXd& start, int steps) {
  Drive drive{Eigen::MatrixXd(start.size(), steps + 1), Eigen::MatrixXd(plant.B.cols(), steps)};
  drive.X.col(0) = start;
  for (int t = 0; t < steps; ++t) {
    const Eigen::VectorXd x = drive.X.col(t), u = law(x);
    drive.U.col(t) = u;
    drive.X.col(t + 1) = plant.A * x + plant.B * u;
  }
  return drive;
}

Eigen::MatrixXd regulatorOf(const Task& task, double tau) {
  return lqr({.A = task.plant.A, .B = task.plant.B, .step = tau}, task.costs.Q, task.costs.R).K;
}

// Parts 1 to 3 are needed for a plan that is more than zeros.
bool plansSomething(const Task& task) {
  const Eigen::VectorXd far = Eigen::VectorXd::Constant(task.plant.A.rows(), 1);
  return !planned(task, far).isZero(0);
}

constexpr double kTau = .1;

// A pole on a cart, with a motor of at most 4 N that decides 20 times a second.
constexpr double kPoleTau = .05;
Task poleTask(int N) {
  const LinearizedPlant upright = CartPoleDynamics().linearized(Eigen::Vector4d::Zero(), 0);
  const LinearSystem held = discretized({.A = upright.A, .B = upright.B}, kPoleTau);
  Task task{.plant = {held.A, held.B}, .N = N};
  task.costs.Q = Eigen::Vector4d(1, 0, 1, 0).asDiagonal();
  task.costs.R = Eigen::MatrixXd::Constant(1, 1, .01);
  task.costs.F = costToGo(task.plant, task.costs.Q, task.costs.R);
  task.uMax = Eigen::VectorXd::Constant(1, 4);
  task.uMin = -task.uMax;
  return task;
}

// The true cart pole under a law, from rest at an angle; ends when the pole lies flat.
std::vector<CartPoleView> balance(const Law& law, double angle, int decisions) {
  constexpr int kFine = 50;
  std::vector<CartPoleView> views;
  Eigen::Vector4d x(0, 0, angle, 0);
  for (int t = 0; t < decisions && std::abs(x[2]) < 1.57; ++t) {
    const double u = law(x)[0];
    views.push_back({.x = x, .u = u});
    for (int i = 0; i < kFine; ++i) x = CartPoleDynamics().eulerStep(x, u, kPoleTau / kFine);
  }
  return views;
}

}  // namespace

Task trolleyTask() {
  Task task;
  task.plant.A = (Eigen::MatrixXd(2, 2) << 1, kTau, 0, 1).finished();
  task.plant.B = (Eigen::MatrixXd(2, 1) << kTau * kTau / 2, kTau).finished();
  task.costs.Q = Eigen::Vector2d(1, 0).asDiagonal();
  task.costs.R = Eigen::MatrixXd::Constant(1, 1, .1);
  task.costs.F = costToGo(task.plant, task.costs.Q, task.costs.R);
  task.N = 40;
  task.uMax = Eigen::VectorXd::Ones(1);
  task.uMin = -task.uMax;
  return task;
}

void showPrediction(const Plant& plant) {
  constexpr int kSteps = 30;
  Rng rng(1);
  const Eigen::VectorXd x = rng.normalVector(2), U = rng.normalVector(kSteps);
  const Prediction p = predicted(plant, kSteps);
  const Eigen::VectorXd X = p.Sx * x + p.Su * U;
  int t = 0;
  const Drive drive = followed(
      plant, [&](const Eigen::VectorXd&) -> Eigen::VectorXd { return U.segment(t++, 1); }, x, kSteps);
  print("how far a predicted motion of 30 steps is from what happens, which should be 0",
        (X - drive.X.rightCols(kSteps).reshaped()).cwiseAbs().maxCoeff());
}

void showHorizons(const Task& task) {
  const Eigen::VectorXd x = Eigen::Vector2d(1, 0);
  const double wanted = -(regulatorOf(task, kTau) * x)(0);
  Figure figure{.title = "The first control from (1 m, 0 m/s), without bounds",
                .xLabel = "horizon [steps]",
                .yLabel = "u [m/s^2]",
                .horizontalLines = {{.at = wanted, .label = "LQR"}}};
  for (const bool isRight : {true, false}) {
    Costs costs = task.costs;
    if (!isRight) costs.F = costs.Q;
    Series series{.label = isRight ? "F: the cost to go" : "F = Q", .style = SeriesStyle::kLinesPoints};
    for (int N = 1; N <= 40; ++N) {
      const Quadratic cost = planCost(task.plant, costs, N, x);
      if (cost.H.isZero(0)) return nothingYet("planCost");
      series.add(N, -solve(cost.H, cost.g)[0]);
    }
    figure.series.push_back(series);
  }
  plot("horizons", figure);
}

void showBox() {
  Quadratic cost;
  cost.H = (Eigen::MatrixXd(2, 2) << 2, 1.7, 1.7, 2).finished();
  cost.g = Eigen::Vector2d(-3.6, -1.9);
  const Eigen::VectorXd upper = Eigen::Vector2d(1, 1), lower = -upper, free = -solve(cost.H, cost.g),
                        cut = free.cwiseMax(lower).cwiseMin(upper);
  const Eigen::VectorXd found = boxed(cost, lower, upper);
  const auto value = [&](double x, double y) {
    const Eigen::VectorXd z = Eigen::Vector2d(x, y);
    return std::min(6., .5 * z.dot(cost.H * z) + cost.g.dot(z));
  };
  const auto point = [](const char* label, const Eigen::VectorXd& z, Marker marker) {
    return dots(z, {.label = label, .marker = marker, .size = 2.5});
  };
  Figure figure{.title = "A cost of two numbers, each between -1 and 1",
                .xLabel = "z_1",
                .yLabel = "z_2",
                .colorLabel = "cost",
                .xRange = AxisRange{-2, 4},
                .yRange = AxisRange{-3, 2},
                .legend = Legend::kOutside,
                .series = {{.label = "bounds", .x = {-1, 1, 1, -1, -1}, .y = {-1, -1, 1, 1, -1}},
                           point("minimum without bounds", free, Marker::kCross),
                           point("the same, clipped", cut, Marker::kSquare),
                           point("boxed()", found, Marker::kDot)}};
  figure.equalAxes = true;
  figure.heatMap = sampledHeatMap(value, {-2, 4}, {-3, 2});
  figure.heatMap->contours = 12;
  plot("box", figure);
}

void showTrolley(const Task& task) {
  if (!plansSomething(task)) return nothingYet("plans");
  const Eigen::Vector2d start(5, 0);
  Figure position{.title = "A trolley, 5 m from its goal", .xLabel = "time [s]", .yLabel = "position [m]"};
  Figure control{.title = "Controls of the trolley", .xLabel = "time [s]", .yLabel = "u [m/s^2]"};
  const auto add = [&](const std::string& label, const Law& law) {
    const Drive drive = followed(task.plant, law, start, 120);
    position.series.push_back(overTime(drive.X.row(0), kTau, {.label = label}));
    control.series.push_back(overTime(drive.U.row(0), kTau, {.label = label}));
  };
  add("LQR, clipped", cutOff(task, regulatorOf(task, kTau)));
  for (const int N : {10, 40}) {
    Task other = task;
    other.N = N;
    add(std::to_string(N) + " steps planned", planning(other));
  }
  plot("trolley", position);
  plot("controls", control);
}

void showPole() {
  if (!plansSomething(poleTask(10))) return nothingYet("the pole");
  const auto farthest = [](const Law& law) {
    double stays = 0, falls = 1;
    while (falls - stays > .004) {
      const double angle = (stays + falls) / 2;
      (balance(law, angle, 100).size() == 100 ? stays : falls) = angle;
    }
    return stays;
  };
  const Task shortest = poleTask(1);
  Series plans{.label = "plans", .style = SeriesStyle::kLinesPoints};
  for (const int N : {1, 3, 6, 10, 15, 20}) {
    plans.add(N, farthest(planning(poleTask(N))));
  }
  Figure figure{.title = "Largest angle from which a motor of 4 N rights the pole",
                .xLabel = "horizon [steps of 0.05 s]",
                .yLabel = "angle [rad]",
                .series = {plans},
                .horizontalLines = {{.at = farthest(cutOff(shortest, regulatorOf(shortest, kPoleTau))),
                                     .label = "LQR, clipped"}}};
  plot("pole", figure);
  std::vector<CartPoleView> views = balance(planning(poleTask(20)), .9 * plans.y.back(), 120);
  for (CartPoleView& view : views) view.caption = "a plan of 20 steps, every 0.05 s";
  writeFilm(cartPoleFilm(views, kPoleTau), "balanced");
}

void showLine() {
  constexpr double kStep = .05;
  constexpr int kSteps = 70;
  Simulator S("arm3.ors");
  const Arm arm = [S](const Eigen::VectorXd& q) mutable -> Hand {
    S.setJointAngles(q);
    const Eigen::Vector3d tip(0, 0, .15);
    return {S.kinematicsPos("eff", tip).tail(2), S.jacobianPos("eff", tip).bottomRows(2)};
  };
  const Eigen::VectorXd most = Eigen::Vector3d(1.8, 1.3, 1.3), start = Eigen::Vector3d(-.5, -.2, -.2);
  const ArmLimits limits{-most, most, Eigen::Vector3d::Ones()};
  const Eigen::VectorXd goal = Eigen::Vector2d(-.4, .6), way = goal - arm(start).p;
  const double pace = .025;
  const Eigen::MatrixXd Q = traced(arm, limits, start, goal, pace, kStep, kSteps);
  if (Q.isApprox(start.replicate(1, kSteps + 1))) return nothingYet("traced");
  // The pseudo-inverse knows no limits, and its points of the line come by the clock.
  Eigen::MatrixXd cut = start.replicate(1, kSteps + 1);
  for (int t = 0; t < kSteps; ++t) {
    const Eigen::VectorXd q = cut.col(t);
    const Hand hand = arm(q);
    const Eigen::VectorXd v = (arm(start).p + std::min(1., pace * (t + 1)) * way - hand.p) / kStep;
    const RateBounds bounds = rateBounds(limits, q, kStep);
    const Eigen::VectorXd w = leastSquares(hand.J, v);
    cut.col(t + 1) = q + kStep * w.cwiseMax(bounds.lower).cwiseMin(bounds.upper);
  }
  Figure paths{.title = "A hand on a line, every 0.2 s; its joints turn at 1 rad/s or less",
               .xLabel = "y [m]",
               .yLabel = "z [m]",
               .equalAxes = true,
               .xRange = AxisRange{-1.1, .6},
               .legend = Legend::kTopRight};
  const auto links = [&](const Eigen::VectorXd& q, const std::string& label, bool isOld) {
    S.setJointAngles(q);
    Series arms{
        .label = label, .style = SeriesStyle::kLinesPoints, .marker = Marker::kCircle, .dashed = isOld};
    for (const char* body : {"arm1", "arm2", "eff"}) {
      const Eigen::Vector3d joint = S.kinematicsPos(body, {0, 0, -.15});
      arms.add(joint.y(), joint.z());
    }
    const Eigen::VectorXd tip = arm(q).p;
    arms.add(tip[0], tip[1]);
    return arms;
  };
  const auto add = [&](const std::string& label, const Eigen::MatrixXd& motion) {
    Series path{.label = label, .style = SeriesStyle::kLinesPoints, .marker = Marker::kDot, .size = 1.5};
    for (int t = 0; t <= kSteps; t += 4) {
      const Eigen::VectorXd p = arm(motion.col(t)).p;
      path.add(p[0], p[1]);
    }
    paths.series.push_back(path);
  };
  add("quadratic program", Q);
  add("pseudo-inverse, clipped", cut);
  paths.series.push_back(links(start, "the arm at first", true));
  paths.series.push_back(links(Q.rightCols(1), "the arm at the end", false));
  plot("line", paths);
}

void showWall(const Task& task) {
  if (!plansSomething(task)) return nothingYet("the wall");
  Task ahead = task;
  ahead.N = 25;
  constexpr double kWall = -.1, kNone = std::numeric_limits<double>::infinity();
  Figure figure{.title = "A trolley, 4 m from its goal, with a wall at -0.1 m: 25 steps planned",
                .xLabel = "time [s]",
                .yLabel = "position [m]",
                .xRange = AxisRange{2, 8},
                .yRange = AxisRange{-.4, 1},
                .horizontalLines = {{.at = kWall, .label = "wall"}}};
  const auto add = [&](const std::string& label, const Law& law) {
    const Drive drive = followed(task.plant, law, Eigen::Vector2d(4, 0), 100);
    figure.series.push_back(overTime(drive.X.row(0), kTau, {.label = label}));
  };
  add("no wall", planning(ahead));
  for (const int weight : {1, 10}) {
    const Corridor corridor{Eigen::Vector2d(kWall, -kNone), Eigen::Vector2d(kNone, kNone),
                            static_cast<double>(weight)};
    add("weight " + std::to_string(weight), [&](const Eigen::VectorXd& x) -> Eigen::VectorXd {
      return plannedWithin(ahead, corridor, x).col(0);
    });
  }
  plot("wall", figure);
}
