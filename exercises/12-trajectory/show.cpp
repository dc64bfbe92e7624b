#include "show.h"

#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>

#include "course/clearances.h"
#include "scenes.h"
#include "trajectory/motion_terms.h"
#include "trajectory/trajectory_optimizer.h"

using namespace rex;

namespace {

const Color kBlue{0.1f, 0.35f, 0.65f}, kOrange{0.85f, 0.4f, 0.05f}, kGrey{0.55f, 0.58f, 0.6f},
    kPale{0.68f, 0.78f, 0.9f};

Figure axes(const char* title, const char* xLabel, const char* yLabel) {
  return {.title = title, .xLabel = xLabel, .yLabel = yLabel, .legend = Legend::kOutside, .width = 900};
}

enum class Pen { line, dashes, dots, beads };

// The points (x, y) of a curve, one per column.
void add(Figure& figure, const std::string& label, const Eigen::MatrixXd& points, const Color& color,
         Pen pen = Pen::line, double size = 1.5) {
  Series look{
      .label = label, .marker = Marker::kDot, .size = size, .dashed = pen == Pen::dashes, .color = color};
  if (pen == Pen::dots) look.style = SeriesStyle::kPoints;
  if (pen == Pen::beads) look.style = SeriesStyle::kLinesPoints;
  figure.series.push_back(through(points, look));
}

// A circle as `count` points, counter-clockwise; one more closes it.
Eigen::MatrixXd circle(const Ball& ball, double radius, int count) {
  Eigen::MatrixXd points(2, count);
  for (int i = 0; i < count; ++i) {
    const double angle = 2 * std::numbers::pi * i / 72;
    points.col(i) << ball.y + radius * std::cos(angle), ball.z + radius * std::sin(angle);
  }
  return points;
}

// A point that comes from rest at one position to rest at another, and keeps out of a disc.
struct DiscPath {
  Eigen::Vector2d from{-1, 0}, to{1, 0.1};
  Ball disc{0, 0.15, 0.4};
  double tau = 0.05;
  int steps = 40;

  // The straight way.
  Eigen::MatrixXd guess() const {
    Eigen::MatrixXd X(2, steps);
    for (int t = 0; t < steps; ++t)
      for (int i = 0; i < 2; ++i) X(i, t) = from[i] + (t + 1.) / steps * (to[i] - from[i]);
    return X;
  }

  std::vector<Term> termsAt(const Eigen::MatrixXd& X) const {
    std::vector<Term> terms;
    Eigen::MatrixXd three(2, 3);
    for (int t = 0; t < steps; ++t) {
      for (int i = 0; i < 6; ++i) three(i % 2, i / 2) = t + i / 2 < 2 ? from[i % 2] : X(i % 2, t - 2 + i / 2);
      const TermValue acceleration = differenceTerm(three, tau);
      terms.push_back({Role::cost, t, acceleration.y, acceleration.J});
      terms.push_back({Role::inequality, t, {}, {}});
      outside(X(0, t), X(1, t), terms.back().y, terms.back().J);
    }
    for (const int t : {steps - 1, steps - 2})
      terms.push_back({Role::equality, t, X.col(t) - to, Eigen::MatrixXd::Identity(2, 2)});
    return terms;
  }

  // 1 - distance / radius at (x, y), and its Jacobian.
  void outside(double x, double y, Eigen::VectorXd& value, Eigen::MatrixXd& J) const {
    const double distance = std::hypot(x - disc.y, y - disc.z);
    value.resize(1);
    value[0] = 1 - distance / disc.radius;
    J.resize(1, 2);
    J(0, 0) = -(x - disc.y) / (distance * disc.radius);
    J(0, 1) = -(y - disc.z) / (distance * disc.radius);
  }
};

TrajectoryResult byLibrary(const DiscPath& path) {
  TrajectoryTerm outside;
  outside.name = "outside of the disc";
  outside.kind = TermKind::kInequality;
  outside.function = [&](const TrajectoryWindow& window, FunctionValue& value) {
    path.outside(window.X(0, 0), window.X(1, 0), value.y, value.J);
  };
  std::vector<TrajectoryTerm> terms = restTerms(path.to, path.steps);
  terms.push_back(accelerationTerm());
  terms.push_back(outside);
  const TrajectoryProblem problem(terms, Eigen::VectorXd(path.from).replicate(1, 2), path.steps, path.tau);
  return optimizeTrajectory(problem, path.guess(), {.penalty = 100});
}

Figure discFigure(const char* title, const DiscPath& path) {
  Figure figure = planeFigure({.title = title, .legend = Legend::kOutside, .width = 900, .height = 430});
  figure.regions = {within(circle(path.disc, path.disc.radius, 72))};
  add(figure, "start", path.guess(), kGrey, Pen::dashes);
  return figure;
}

Eigen::MatrixXd overRounds(const std::vector<double>& values) {
  Eigen::MatrixXd points(2, static_cast<Eigen::Index>(values.size()));
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    points(0, i) = static_cast<double>(i) + 1;
    points(1, i) = values[static_cast<std::size_t>(i)] + 1e-12;
  }
  return points;
}

// Configurations on the way of the arm, `each` to a step; the first is that at rest.
Eigen::MatrixXd finely(const Eigen::MatrixXd& X, int each) {
  Eigen::MatrixXd fine(X.rows(), X.cols() * each + 1);
  for (Eigen::Index i = 0; i < fine.cols(); ++i) {
    const Eigen::Index t = std::max<Eigen::Index>(0, i - 1) / each;
    const Eigen::VectorXd before = t == 0 ? Eigen::VectorXd(kArmStart) : X.col(t - 1);
    fine.col(i) = before + static_cast<double>(i - t * each) / each * (X.col(t) - before);
  }
  return fine;
}

// How the arm moves: its hand in its plane (y, z) and in space, and the clearance over time.
struct Swing {
  Eigen::MatrixXd hand, nearest;
  std::vector<Eigen::Vector3d> way;
};

Swing swingOf(Simulator& S, const Eigen::MatrixXd& X) {
  constexpr int kEach = 8;
  const Eigen::MatrixXd fine = finely(X, kEach);
  Swing swing{Eigen::MatrixXd(2, fine.cols()), Eigen::MatrixXd(2, fine.cols()), {}};
  for (Eigen::Index i = 0; i < fine.cols(); ++i) {
    S.setJointAngles(fine.col(i));
    swing.way.push_back(S.kinematicsPos("eff", {0, 0, 0.15}));
    for (int k = 0; k < 2; ++k) swing.hand(k, i) = swing.way.back()[k + 1];
    swing.nearest(0, i) = static_cast<double>(i) / kEach * kErrand.tau;
    swing.nearest(1, i) = clearances(S).y.minCoeff();
  }
  return swing;
}

// The middles of the links in their plane (y, z): 2 x 4.
Eigen::MatrixXd linksOf(Simulator& S, const Eigen::VectorXd& q) {
  S.setJointAngles(q);
  Eigen::MatrixXd corners(2, 4);
  for (int i = 0; i < 4; ++i) {
    const char* link = i == 0 ? "arm1" : i == 1 ? "arm2" : "eff";
    const Eigen::Vector3d p = S.kinematicsPos(link, {0, 0, i < 3 ? -0.15 : 0.15});
    corners(0, i) = p.y();
    corners(1, i) = p.z();
  }
  return corners;
}

// In real time.
void filmMotion(const Eigen::MatrixXd& X, const std::vector<Eigen::Vector3d>& hand) {
  Simulator S(armAmong(kBall, kArmStart));
  S.clearRecording();
  const Eigen::MatrixXd fine = finely(X, 4);
  for (Eigen::Index i = 0; i < fine.cols(); ++i) S.setJointAngles(fine.col(i));
  PictureOptions look;
  look.caption = "Around the ball";
  look.paths = {hand};
  look.view = {2, -0.6, 0.5};
  writeVideo(S, "around", look, 60);
  writeContactSheet(S, "around_sheet", look, 6, 60);
  writeReplay(S, "around", look, {});
}

}  // namespace

void showCosts() {
  Eigen::MatrixXd table(3, 2);
  for (int i = 0; i < 3; ++i) {
    const int T = i == 0 ? 5 : i == 1 ? 20 : 100;
    Eigen::MatrixXd X(1, T);
    for (int t = 0; t < T; ++t) {
      const double s = (t + 1.) / T;
      X(0, t) = s * s * (3 - 2 * s);
    }
    table.row(i) << T, motionCost(Eigen::MatrixXd::Zero(1, 2), X, 2, 1. / T);
  }
  if (table.col(1).isZero()) return nothingYet("costs");
  print("T, cost of 3 s^2 - 2 s^3 (12 with many steps)", table);

  // The acceleration of the product of both numbers of a configuration.
  const auto difference = [](const Eigen::VectorXd& window) {
    std::vector<TermValue> phi;
    for (int i = 0; i < 6; i += 2)
      phi.push_back({Eigen::VectorXd::Constant(1, window[i] * window[i + 1]),
                     Eigen::RowVector2d(window[i + 1], window[i])});
    return taskDifference(phi, .1);
  };
  Eigen::VectorXd window(6);
  window << .1, .7, .4, -.3, .9, .2;
  const TermValue value = difference(window);
  if (value.J.isZero()) return nothingYet("taskDifference()");
  const VectorFunction y = [&](const Eigen::VectorXd& x) { return difference(x).y; };
  std::printf("taskDifference(): %s\n", checkJacobian(y, value.J, window).message.c_str());
}

void showDescent() {
  const DiscPath path;
  const Terms priced = [&](const Eigen::MatrixXd& X) {
    std::vector<Term> all = path.termsAt(X);
    for (Term& term : all) {
      if (term.role == Role::cost) continue;
      const double weight = term.role == Role::equality ? 100 : term.y[0] > 0 ? 5 : 0;
      term.y *= weight;
      term.J *= weight;
    }
    return all;
  };
  const std::vector<Eigen::MatrixXd> steps = descended(priced, path.guess(), 1e-3);
  if (steps.size() < 2) return nothingYet("Gauss-Newton steps");
  Figure figure = discFigure("Gauss-Newton steps, with a penalty inside the disc", path);
  for (std::size_t i = 1; i + 1 < steps.size(); ++i)
    add(figure, i == 1 ? "on the way" : "", steps[i], kPale, Pen::line, .7);
  add(figure, "after " + std::to_string(steps.size() - 1) + " steps", steps.back(), kOrange, Pen::dots);
  plot("descent", figure);
}

void showDisc() {
  const DiscPath path;
  const Terms exact = [&](const Eigen::MatrixXd& X) { return path.termsAt(X); };
  const Minimum found = minimised(exact, path.guess(), 100, {1e-6, 1e-4});
  if (found.X == path.guess()) return nothingYet("constraints");
  const TrajectoryResult library = byLibrary(path);
  Figure disc = discFigure("Least acceleration past a disc", path);
  add(disc, "library", library.X, kBlue);
  add(disc, "optimised", found.X, kOrange, Pen::dots);
  plot("disc", disc);
  Figure rounds = axes("Rounds of the augmented Lagrangian", "round", "cost, violation [1]");
  rounds.logY = true;
  add(rounds, "cost", overRounds(found.cost), kBlue, Pen::beads);
  add(rounds, "largest violation", overRounds(found.violation), kOrange, Pen::beads);
  plot("rounds", rounds);
  print("path past the disc, cost", found.cost.back());
  print("of the library", library.solution.cost);
}

void showReach() {
  Eigen::MatrixXd table(3, 3);
  for (int i = 0; i < 3; ++i) {
    const int T = i == 0 ? 5 : i == 1 ? 20 : 100;
    const Eigen::MatrixXd X =
        throughPoints(Eigen::VectorXd::Zero(1), Eigen::MatrixXd::Ones(1, 1), {T - 1}, 1. / T);
    table(i, 0) = T;
    table(i, 1) = motionCost(Eigen::MatrixXd::Zero(1, 2), X, 2, 1. / T);
    table(i, 2) = 12. * T * T / (T * T - 1.);
  }
  if (!table.col(1).isZero()) print("T, least cost from 0 to 1, 12 T^2 / (T^2 - 1)", table);
}

void showVia(const Eigen::MatrixXd& points, const std::vector<int>& when, double tau) {
  const Eigen::MatrixXd X = throughPoints(Eigen::VectorXd::Zero(2), points, when, tau);
  if (X.isZero()) return nothingYet("via points");
  Figure figure = axes("Least acceleration through four points", "x [m]", "y [m]");
  add(figure, "one step each", X, kBlue, Pen::beads, 0.7);
  add(figure, "via points", points, kOrange, Pen::dots, 1.7);
  plot("via", figure);
}

void showArm() {
  Simulator S(armAmong(kBall, kArmStart));
  const Eigen::MatrixXd X = aroundObstacle(S, kErrand);
  if (X == kArmStart.replicate(1, kErrand.steps)) return nothingYet("the arm");
  const int last = kErrand.steps - 1;
  const Eigen::MatrixXd direct = throughPoints(kArmStart, kErrand.goal, {last}, kErrand.tau);
  Eigen::MatrixXd both(3, 2);
  both << kErrand.detour, kErrand.goal;
  const Eigen::MatrixXd detour = throughPoints(kArmStart, both, {last / 2, last}, kErrand.tau);
  const Swing a = swingOf(S, direct), b = swingOf(S, detour), c = swingOf(S, X);

  Figure arm = axes("The arm around the ball", "y [m]", "z [m]");
  arm.equalAxes = true;
  arm.width = 760;
  arm.height = 640;
  arm.regions = {within(circle(kBall[0], kBall[0].radius, 72))};
  for (Eigen::Index step = 0; step < X.cols(); ++step)
    add(arm, step == 0 ? "links" : "", linksOf(S, X.col(step)), kPale, Pen::line, 1);
  add(arm, "hand, direct", a.hand, kBlue, Pen::dashes);
  add(arm, "hand, detour", b.hand, kGrey, Pen::dashes);
  add(arm, "hand, optimised", c.hand, kOrange, Pen::line, 2.5);
  add(arm, "half a link and the margin away", circle(kBall[0], kBall[0].radius + (0.05 + kErrand.margin), 73),
      kGrey, Pen::line, 1);
  plot("arm", arm);

  Figure near = axes("Distance of the nearest pair, also between steps", "time [s]", "distance [m]");
  add(near, "direct", a.nearest, kBlue, Pen::dashes);
  add(near, "detour", b.nearest, kGrey, Pen::dashes);
  add(near, "optimised", c.nearest, kOrange);
  Eigen::MatrixXd margin(2, 2);
  margin << 0, kErrand.steps * kErrand.tau, kErrand.margin, kErrand.margin;
  add(near, "margin", margin, {0.1f, 0.1f, 0.1f}, Pen::line, 0.7);
  plot("clearance", near);

  const Eigen::MatrixXd prefix = Eigen::VectorXd(kArmStart).replicate(1, 2);
  print("cost of the detour", motionCost(prefix, detour, 2, kErrand.tau));
  print("cost of the optimised motion", motionCost(prefix, X, 2, kErrand.tau));
  filmMotion(X, c.way);
}
